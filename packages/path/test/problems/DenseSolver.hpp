#pragma once

#include <cmath>
#include <numeric>
#include <vector>

#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_MultiVector.hpp>

#include "atrapos/linear/Error.hpp"
#include "atrapos/linear/TangentSolver.hpp"

/// Dense LU with row pivoting on one rank: small, exact about singularity, counts what is asked of it.
class DenseSolver : public atrapos::linear::TangentSolver {
 public:
  using CrsMatrix = atrapos::linear::CrsMatrix;
  using MultiVector = atrapos::linear::MultiVector;

  /// The factorizations (from 1) that report a singular tangent whatever the matrix.
  std::vector<long long> pretendSingularAt;

  void analyze(const Teuchos::RCP<const CrsMatrix>& K) override {
    ++counters_.analyses;
    n_ = static_cast<int>(K->getNodeNumRows());
  }

  void factor(const Teuchos::RCP<const CrsMatrix>& K) override {
    ++counters_.factorizations;
    for (const auto which : pretendSingularAt)
      if (which == counters_.factorizations)
        throw atrapos::linear::SingularTangentError("singular by request", 1);
    lu_.assign(n_ * n_, 0.0);
    double largest = 0;
    for (int i = 0; i < n_; ++i) {
      Teuchos::ArrayView<const int> columns;
      Teuchos::ArrayView<const double> values;
      K->getLocalRowView(i, columns, values);
      for (int j = 0; j < columns.size(); ++j) {
        lu_[i * n_ + columns[j]] = values[j];
        largest = std::max(largest, std::abs(values[j]));
      }
    }
    rows_.resize(n_);
    std::iota(rows_.begin(), rows_.end(), 0);
    for (int k = 0; k < n_; ++k) {
      int p = k;
      for (int i = k + 1; i < n_; ++i)
        if (std::abs(at(i, k)) > std::abs(at(p, k))) p = i;
      std::swap(rows_[k], rows_[p]);
      // 1e-15 of the largest entry is rounding noise of the elimination.
      if (std::abs(at(k, k)) <= 1e-15 * largest)
        throw atrapos::linear::SingularTangentError("the tangent is singular (zero pivot)", 1);
      for (int i = k + 1; i < n_; ++i) {
        const double m = at(i, k) /= at(k, k);
        for (int j = k + 1; j < n_; ++j) at(i, j) -= m * at(k, j);
      }
    }
  }

  void solve(const MultiVector& b, MultiVector& x) const override {
    for (std::size_t c = 0; c < b.getNumVectors(); ++c) {
      ++counters_.solves;
      const auto rhs = b.getData(c);
      std::vector<double> y(n_);
      for (int i = 0; i < n_; ++i) {
        y[i] = rhs[rows_[i]];
        for (int j = 0; j < i; ++j) y[i] -= at(i, j) * y[j];
      }
      for (int i = n_; i-- > 0;) {
        for (int j = i + 1; j < n_; ++j) y[i] -= at(i, j) * y[j];
        y[i] /= at(i, i);
      }
      auto out = x.getDataNonConst(c);
      for (int i = 0; i < n_; ++i) out[i] = y[i];
    }
  }

  void solveTransposed(const MultiVector&, MultiVector&) const override {
    throw atrapos::linear::SolverError("the test solver has no transposed solve");
  }
  std::optional<atrapos::linear::Inertia> inertia() const override { return std::nullopt; }
  std::string name() const override { return "dense LU"; }
  const Counters& counters() const override { return counters_; }

 private:
  double& at(int i, int j) { return lu_[rows_[i] * n_ + j]; }
  double at(int i, int j) const { return lu_[rows_[i] * n_ + j]; }

  int n_ = 0;
  std::vector<double> lu_;
  std::vector<int> rows_;
  mutable Counters counters_;
};
