#pragma once

#include <memory>
#include <vector>

#include "atrapos/linear/TangentSolver.hpp"

namespace atrapos::linear {

struct Amesos2Options {
  std::string solver = "klu2";  ///< Amesos2's name for it
  bool symmetric = true;        ///< K is symmetric: K^-T = K^-1
};

/// Any direct solver of the Trilinos at hand, through Amesos2. KLU2 is there always and serves as reference.
///
/// Amesos2 tells neither inertia nor rank, and its solvers notice exact zero pivots only. Therefore factor()
/// solves one system with known solution, and takes K for singular where that is lost (cond(K) about 1e14).
///
/// Limits of Trilinos 13.2: its Tacho adapter offers Cholesky only (K symmetric positive definite), never
/// initialises Tacho's sparse path and would crash from 1024 unknowns on or on several ranks; here that
/// throws.
class Amesos2Solver final : public TangentSolver {
 public:
  /// Unknown solver name: SolverError with the names that are available.
  explicit Amesos2Solver(const Amesos2Options& options = {});
  ~Amesos2Solver() override;

  void analyze(const RCP<const CrsMatrix>& K) override;
  void factor(const RCP<const CrsMatrix>& K) override;
  void solve(const MultiVector& b, MultiVector& x) const override;

  /// For a symmetric K this is solve(); else the first call after factor() factors K^T as well.
  void solveTransposed(const MultiVector& b, MultiVector& x) const override;

  std::optional<Inertia> inertia() const override { return std::nullopt; }
  std::string name() const override;
  const Counters& counters() const override { return counters_; }

  /// Names that Amesos2 has in this build.
  static std::vector<std::string> available();

 private:
  struct Impl;
  void solveWith(const MultiVector& b, MultiVector& x, bool transposed) const;
  void solveUnchecked(const MultiVector& b, MultiVector& x, bool transposed) const;
  void checkConditioning(const CrsMatrix& K);

  Amesos2Options options_;
  std::unique_ptr<Impl> impl_;
  mutable Counters counters_;
};

}  // namespace atrapos::linear
