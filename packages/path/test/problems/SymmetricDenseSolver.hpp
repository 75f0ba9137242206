#pragma once

#include <Teuchos_LAPACK.hpp>

#include "DenseSolver.hpp"

/// The dense solver for symmetric tangents, with their inertia by all eigenvalues.
class SymmetricDenseSolver : public DenseSolver {
 public:
  void factor(const Teuchos::RCP<const CrsMatrix>& K) override {
    const int n = static_cast<int>(K->getNodeNumRows());
    std::vector<double> A(n * n, 0.0), eigenvalues(n), work(3 * n);
    for (int i = 0; i < n; ++i) {
      Teuchos::ArrayView<const int> columns;
      Teuchos::ArrayView<const double> values;
      K->getLocalRowView(i, columns, values);
      for (int j = 0; j < columns.size(); ++j) A[columns[j] * n + i] = values[j];
    }
    int info = 0;
    Teuchos::LAPACK<int, double>().SYEV('N', 'L', n, A.data(), n, eigenvalues.data(), work.data(), 3 * n,
                                        &info);
    inertia_.emplace();
    for (const double e : eigenvalues) inertia_->negative += e < 0;
    DenseSolver::factor(K);
  }
  std::optional<atrapos::linear::Inertia> inertia() const override { return inertia_; }

 private:
  std::optional<atrapos::linear::Inertia> inertia_;
};
