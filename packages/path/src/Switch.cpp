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
  auto F = calls.newVector(), r = calls.newVector(), trial = calls.newVector();
  auto x1 = calls.newVector(), x2 = calls.newVector();
  for (const double part : {1e-2, 1e-3}) {
    const double s = part * point.stepLength;
    State state{Teuchos::rcp(new Vector(*point.state.u, Teuchos::Copy)), point.state.lambda};
    state.u->update(s, *direction.x.u, 1);
    state.lambda += s * direction.lambda;
    double residual = calls.residual(state, *r).relative();
    ++result.factorizations;
    try {
      calls.factor(state, *F);
      calls.solve(*F, *x2);
      // The factorization of the first iteration serves all: the state moves by s^2, the tangent's smallest
      // eigenvalue is proportional to s, so each contracts by s.
      constexpr int maxIterations = 10;
      for (int i = 0; i < maxIterations && residual > tolerance; ++i) {
        calls.solve(*r, *x1);
        const double dLambda = border.c(x1) / (border.c(x2) + border.cLambda);
        trial->update(1, *state.u, -1, *x1, 0);
        trial->update(dLambda, *x2, 1);
        const double now = calls.residual({trial, state.lambda + dLambda}, *r).relative();
        if (!(now < 0.5 * residual)) break;
        residual = now;
        std::swap(state.u, trial);
        state.lambda += dLambda;
      }
    } catch (const PathError&) {
      continue;
    }
    if (!(residual <= accepted)) continue;
    // Still the branch asked for: not back on the one that it leaves.
    Augmented gap{Teuchos::rcp(new Vector(*state.u, Teuchos::Copy)), state.lambda - point.state.lambda};
    gap.u->update(-1, *point.state.u, 1);
    const Augmented t{direction.x.u, direction.lambda};
    const double cosine = dot(gap, t, weight) / std::sqrt(dot(gap, gap, weight) * dot(t, t, weight));
    constexpr double sameDirection = 0.9;
    if (!(cosine > sameDirection)) continue;
    result.state = state;
    result.inertia = calls.inertia();
    return result;
  }
  return result;
}

}  // namespace atrapos::path
