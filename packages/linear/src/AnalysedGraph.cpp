#include "AnalysedGraph.hpp"

#include <fmt/format.h>

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "ReferenceVector.hpp"
#include "atrapos/linear/Error.hpp"

namespace atrapos::linear {
namespace {

template <class LocalGraph>
bool sameEntries(const LocalGraph& a, const LocalGraph& b) {
  const auto equal = [](const auto& u, const auto& v) {
    return u.extent(0) == v.extent(0) &&
           (u.data() == v.data() || std::equal(u.data(), u.data() + u.extent(0), v.data()));
  };
  return equal(a.row_map, b.row_map) && equal(a.entries, b.entries);
}

// Local comparison: what the ranks find is reduced by the caller.
bool sameLocalMap(const Map& a, const Map& b) { return &a == &b || a.locallySameAs(b); }

}  // namespace

AnalysedGraph::AnalysedGraph(const std::string& solver, const CrsMatrix& K)
    : solver_(solver), rowMap_(K.getRowMap()) {
  if (!K.isFillComplete()) throw SolverError(solver_ + ": analyze needs a fill-complete matrix");
  if (!K.getDomainMap()->isSameAs(*rowMap_) || !K.getRangeMap()->isSameAs(*rowMap_))
    throw SolverError(solver_ + ": analyze needs a square matrix with equal row, range and domain maps");
  const auto n = K.getGlobalNumRows();
  if (n == 0) throw SolverError(solver_ + ": the matrix is empty");
  if (n > static_cast<std::size_t>(std::numeric_limits<int>::max()))
    throw SolverError(fmt::format("{}: {} rows are more than a 32-bit index can count", solver_, n));
  columnMap_ = K.getColMap();
  entries_ = K.getCrsGraph()->getLocalGraphHost();
}

void AnalysedGraph::checkMatrix(const CrsMatrix& K) const {
  std::array<int, 3> local{}, any{};
  local[0] = !K.isFillComplete();
  if (!local[0]) {
    local[1] = !sameLocalMap(*K.getRowMap(), *rowMap_) || !sameLocalMap(*K.getColMap(), *columnMap_) ||
               !sameEntries(K.getCrsGraph()->getLocalGraphHost(), entries_);
    const auto matrix = K.getLocalMatrixHost();
    const double* values = matrix.values.data();
    local[2] =
        !std::all_of(values, values + matrix.values.extent(0), [](double v) { return std::isfinite(v); });
  }
  Teuchos::reduceAll(*rowMap_->getComm(), Teuchos::REDUCE_MAX, 3, local.data(), any.data());
  if (any[0]) throw SolverError(solver_ + ": factor needs a fill-complete matrix");
  if (any[1]) throw SolverError(solver_ + ": the matrix has another graph than the one analysed");
  if (any[2]) throw SolverError(solver_ + ": the matrix has an entry that is not finite");
}

void AnalysedGraph::checkSymmetry(const CrsMatrix& K) const {
  Vector x(rowMap_, false), y(rowMap_, false), Kx(rowMap_, false), Ky(rowMap_, false);
  fillReference(x, 1);
  fillReference(y, 2);
  K.apply(x, Kx);
  K.apply(y, Ky);
  const double difference = std::abs(x.dot(Ky) - y.dot(Kx));
  const double size = x.norm2() * Ky.norm2() + y.norm2() * Kx.norm2();
  if (difference > 1e-10 * size)
    throw SolverError(fmt::format(
        "{}: the matrix is not symmetric (x.Ky - y.Kx is {:.1e} of its size); use symmetric = false", solver_,
        difference / size));
}

void AnalysedGraph::checkVectors(const MultiVector& b, const MultiVector& x) const {
  if (!b.getMap()->isSameAs(*rowMap_) || !x.getMap()->isSameAs(*rowMap_))
    throw SolverError(solver_ + ": right-hand side and solution must live on the matrix' row map");
  if (b.getNumVectors() != x.getNumVectors())
    throw SolverError(fmt::format("{}: {} right-hand sides but {} solutions", solver_, b.getNumVectors(),
                                  x.getNumVectors()));
}

}  // namespace atrapos::linear
