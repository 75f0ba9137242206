#pragma once

#include <memory>
#include <string>
#include <vector>

#include "atrapos/linear/TangentSolver.hpp"

namespace atrapos::linear {

struct TangentSolverOptions {
  /// "mumps", or "amesos2:<name>" with a solver of the Trilinos at hand ("amesos2:klu2").
  std::string type = "mumps";

  /// K is symmetric, not necessarily definite. MUMPS then factors L D L^T (half the work, inertia known), and
  /// a factor() of an unsymmetric K throws. Tacho needs it.
  bool symmetric = true;

  /// MUMPS only: a pivot row is null where its norm, after scaling K's entries to about 1, is below this.
  double nullPivotTolerance = 1e-14;
};

/// Names that TangentSolverOptions::type accepts in this build.
std::vector<std::string> availableTangentSolvers();

/// A solver of the given type. Unknown type: SolverError that lists what is available.
std::unique_ptr<TangentSolver> makeTangentSolver(const TangentSolverOptions& options = {});

}  // namespace atrapos::linear
