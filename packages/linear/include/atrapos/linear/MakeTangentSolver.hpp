#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "atrapos/linear/KrylovOptions.hpp"
#include "atrapos/linear/TangentSolver.hpp"

namespace atrapos::linear {

struct TangentSolverOptions {
  /// "mumps"; "belos", iterations as `krylov` says; "auto", mumps where its factor fits into `memory`, else
  /// belos; or "amesos2:<name>" with a solver of the Trilinos at hand ("amesos2:klu2").
  std::string type = "mumps";

  /// K is symmetric, not necessarily definite. MUMPS then factors L D L^T (half the work, inertia known), and
  /// a factor() of an unsymmetric K throws. Tacho needs it.
  bool symmetric = true;

  /// MUMPS only: a pivot row is null where its norm, after scaling K's entries to about 1, is below this.
  double nullPivotTolerance = 1e-14;

  /// MUMPS, in both precisions: threads of the BLAS in factorizations whose dense blocks are large enough to
  /// gain by them (docs/install.md); solves, and small factorizations, have those that setBlasThreads said.
  int factorThreads = 1;

  KrylovOptions krylov;  ///< "belos"; "auto" picks the preconditioner by itself

  /// "auto": bytes that the solver may take, all ranks together; 0: any.
  double memory = 0;

  /// "auto": gets one line, at the analysis, that says what was picked and why; called on all ranks.
  std::function<void(const std::string&)> tell;
};

/// Names that TangentSolverOptions::type accepts in this build.
std::vector<std::string> availableTangentSolvers();

/// A solver of the given type. Unknown type: SolverError that lists what is available.
std::unique_ptr<TangentSolver> makeTangentSolver(const TangentSolverOptions& options = {});

}  // namespace atrapos::linear
