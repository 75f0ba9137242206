#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Vector.hpp>
#include <exception>
#include <vector>

#include "atrapos/path/Problem.hpp"

namespace atrapos::python {

using Numbers = pybind11::array_t<double, pybind11::array::c_style | pybind11::array::forcecast>;

/// A Problem whose equations are a Python object (atrapos.problem.Equations there):
///
///     value(u, lam) -> r [n], scale          tangent(u, lam) -> K, F [n]
///     order(U [k, n], L [k]) -> F_k [n], from orders 0 to k - 1
///
/// K has entries at the places of a matrix in compressed rows, the same at every state. One rank.
class NumpyProblem final : public path::Problem {
 public:
  /// rows: where each row begins in columns, n + 1.
  NumpyProblem(pybind11::object equations, int size, bool symmetric, std::vector<int> rows,
               std::vector<long long> columns);

  path::RCP<const path::Map> map() const override { return map_; }
  bool symmetric() const override { return symmetric_; }
  path::ResidualNorm residual(const path::State& state, path::Vector& r) override;
  path::RCP<const path::CrsMatrix> tangent(const path::State& state, path::Vector& F) override;
  void beginSeries(const path::State& state, int maxOrder) override;
  void orderRhs(int k, path::Vector& Fk) override;
  void completeOrder(int k, const path::Vector& Uk, double lambdaK) override;

  /// What Python has thrown, which path following takes for the end of a path, comes out here.
  void rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }

  path::RCP<path::Vector> vector(const Numbers& values) const;
  static Numbers numbers(const path::Vector& v);

 private:
  void put(const pybind11::object& from, path::Vector& to) const;
  /// f(), whose exception is kept.
  template <class F>
  auto kept(const F& f) {
    try {
      return f();
    } catch (...) {
      error_ = std::current_exception();
      throw;
    }
  }

  pybind11::object equations_;
  int size_;
  bool symmetric_;
  std::vector<int> rows_;
  std::vector<long long> columns_;
  path::RCP<const path::Map> map_;
  path::RCP<path::CrsMatrix> K_;
  std::exception_ptr error_;
  std::vector<double> U_, lambda_;  ///< [order][unknown], [order]
};

}  // namespace atrapos::python
