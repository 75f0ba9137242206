#pragma once

#include <optional>

#include "atrapos/path/Calls.hpp"
#include "atrapos/path/Options.hpp"

namespace atrapos::path {

/// A state on the branch that leaves a bifurcation point along `direction` (unit in w <U, U> + lambda^2).
struct Switched {
  std::optional<State> state;  ///< none: no equilibrium found in that direction
  std::optional<linear::Inertia> inertia;
  int factorizations = 0;
};

/// x_c + s t with s a hundredth of the step in which the point was found, corrected in the plane normal to t
/// (docs/theory/path.md), or further away where the load would be rounding there; once more with a shorter s
/// where that fails.
Switched switchBranch(Problem& problem, linear::TangentSolver& solver, const Options& options,
                      const CriticalPoint& point, const PathTangent& direction, double weight);

}  // namespace atrapos::path
