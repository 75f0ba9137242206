#include "NumpyProblem.hpp"

#include <Teuchos_DefaultMpiComm.hpp>
#include <Tpetra_Map.hpp>
#include <algorithm>
#include <stdexcept>

namespace py = pybind11;

namespace atrapos::python {

NumpyProblem::NumpyProblem(py::object equations, int size, bool symmetric, std::vector<int> rows,
                           std::vector<long long> columns)
    : equations_(std::move(equations)),
      size_(size),
      symmetric_(symmetric),
      rows_(std::move(rows)),
      columns_(std::move(columns)) {
  map_ = Teuchos::rcp(new path::Map(size, 0, Teuchos::rcp(new Teuchos::MpiComm<int>(MPI_COMM_SELF))));
  int widest = 0;
  for (int i = 0; i < size; ++i) widest = std::max(widest, rows_[i + 1] - rows_[i]);
  K_ = Teuchos::rcp(new path::CrsMatrix(map_, widest));
  const std::vector<double> zeros(widest, 0.0);
  for (int i = 0; i < size; ++i)
    K_->insertGlobalValues(i, rows_[i + 1] - rows_[i], zeros.data(), &columns_[rows_[i]]);
  K_->fillComplete();
}

path::RCP<path::Vector> NumpyProblem::vector(const Numbers& values) const {
  if (values.ndim() != 1 || values.size() != size_)
    throw std::invalid_argument("a vector of " + std::to_string(size_) + " numbers is expected");
  auto v = Teuchos::rcp(new path::Vector(map_));
  for (int i = 0; i < size_; ++i) v->replaceLocalValue(i, values.data()[i]);
  return v;
}

Numbers NumpyProblem::numbers(const path::Vector& v) {
  const auto data = v.getData();
  return Numbers(data.size(), data.get());
}

void NumpyProblem::put(const py::object& from, path::Vector& to) const {
  const auto values = from.cast<Numbers>();
  if (values.size() != size_)
    throw std::invalid_argument("the residual has " + std::to_string(values.size()) + " entries for " +
                                std::to_string(size_) + " unknowns");
  for (int i = 0; i < size_; ++i) to.replaceLocalValue(i, values.data()[i]);
}

path::ResidualNorm NumpyProblem::residual(const path::State& state, path::Vector& r) {
  return kept([&]() -> path::ResidualNorm {
    const py::tuple told = equations_.attr("value")(numbers(*state.u), state.lambda);
    put(told[0], r);
    return {r.norm2(), told[1].cast<double>()};
  });
}

path::RCP<const path::CrsMatrix> NumpyProblem::tangent(const path::State& state, path::Vector& F) {
  const Numbers K = kept([&] {
    const py::tuple told = equations_.attr("tangent")(numbers(*state.u), state.lambda);
    const auto values = told[0].cast<Numbers>();
    if (values.size() != static_cast<py::ssize_t>(columns_.size()))
      throw std::invalid_argument("the tangent has not the entries that it was to have");
    put(told[1], F);
    return values;
  });
  K_->resumeFill();
  for (int i = 0; i < size_; ++i)
    K_->replaceGlobalValues(i, rows_[i + 1] - rows_[i], K.data() + rows_[i], &columns_[rows_[i]]);
  K_->fillComplete();
  return K_;
}

void NumpyProblem::beginSeries(const path::State& state, int) {
  const auto data = state.u->getData();
  U_.assign(data.begin(), data.end());
  lambda_ = {state.lambda};
}

void NumpyProblem::orderRhs(int, path::Vector& Fk) {
  const Numbers U({static_cast<py::ssize_t>(lambda_.size()), static_cast<py::ssize_t>(size_)}, U_.data());
  kept([&] { put(equations_.attr("order")(U, Numbers(lambda_.size(), lambda_.data())), Fk); });
}

void NumpyProblem::completeOrder(int, const path::Vector& Uk, double lambdaK) {
  const auto data = Uk.getData();
  U_.insert(U_.end(), data.begin(), data.end());
  lambda_.push_back(lambdaK);
}

}  // namespace atrapos::python
