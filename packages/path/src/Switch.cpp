#include "Switch.hpp"

#include <cmath>

#include <Tpetra_Vector.hpp>

#include "Augmented.hpp"
#include "Newton.hpp"

namespace atrapos::path {

Switched switchBranch(Problem& problem, linear::TangentSolver& solver, const Options& options,
                      const CriticalPoint& point, const PathTangent& direction, double weight) {
  Calls calls(problem, solver);
  Switched result;
  const Border border = holdPathParameter(problem, weight, direction);
  // Next to the point the tangent is almost singular, so the state is wrong by more than its residual says.
  const double tolerance = 1e-4 * options.residualBound;
  const double accepted = options.correctAbove * options.residualBound;
  for (const double part : {1e-2, 1e-3}) {
    const double s = part * point.stepLength;
    State state{Teuchos::rcp(new Vector(*point.state.u, Teuchos::Copy)), point.state.lambda};
    state.u->update(s, *direction.x.u, 1);
    state.lambda += s * direction.lambda;
    auto r = calls.newVector();
    constexpr int maxIterations = 4;
    const int before = calls.work().factorizations;
    const auto newtonResult = newton(calls, state, *r, border, tolerance, maxIterations, /*maxHalvings*/ 0);
    result.factorizations += calls.work().factorizations - before;
    if (!(newtonResult.residual <= accepted)) continue;
    // Still the branch asked for: not back on the one that it leaves.
    Augmented gap{Teuchos::rcp(new Vector(*state.u, Teuchos::Copy)), state.lambda - point.state.lambda};
    gap.u->update(-1, *point.state.u, 1);
    const Augmented t{direction.x.u, direction.lambda};
    const double cosine = dot(gap, t, weight) / std::sqrt(dot(gap, gap, weight) * dot(t, t, weight));
    constexpr double sameDirection = 0.9;
    if (!(cosine > sameDirection)) continue;
    result.state = state;
    result.inertia = newtonResult.iterations > 0 ? solver.inertia() : std::nullopt;
    return result;
  }
  return result;
}

}  // namespace atrapos::path
