#include "Switch.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Tpetra_Vector.hpp>

#include "Augmented.hpp"
#include "Newton.hpp"
#include "Stability.hpp"

namespace atrapos::path {

namespace {

/// How far from a pitchfork a residual of this size tells the load on the branch along which lambda turns.
///
/// At a distance s along the null vector phi the balance along phi reads s (B/lambda') dlambda = r, with B =
/// phi . D^2R(t, direction) along the path t that the branch leaves, lambda' its load part: nearer than that
/// the load on the branch is rounding, and the tangent singular to it.
double leastDistance(Calls& calls, const CriticalPoint& point, const PathTangent& direction,
                     double tolerance) {
  constexpr double turns = 1e-4;
  if (point.kind != CriticalKind::pitchfork || std::abs(direction.lambda) > turns) return 0;
  const auto other = std::find_if(point.tangents.begin(), point.tangents.end(),
                                  [](const PathTangent& t) { return std::abs(t.lambda) > turns; });
  if (other == point.tangents.end()) return 0;
  auto r = calls.newVector();
  const double force = tolerance * calls.residual(point.state, *r).scale;
  const double B = SecondOrder(calls, point.state, point.nullVectors.front())({other->x.u, other->lambda},
                                                                              {direction.x.u, 0});
  constexpr double told = 1e-6;  // of the load factor
  // Further than that a straight line is no prediction.
  constexpr double furthest = 1e2;
  const double unit = std::max(1.0, std::abs(point.state.lambda));
  return std::min(force * std::abs(other->lambda) / (std::abs(B) * told * unit), furthest * point.stepLength);
}

}  // namespace

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
  const double usual = 1e-2 * point.stepLength;
  const double least = leastDistance(calls, point, direction, tolerance);
  const double first = std::max(usual, least);
  std::vector<double> distances{first, first > usual ? usual : 0.1 * usual};
  // A path that is straight up to the point makes long steps, whatever the scale of its branches.
  if (const double closest = std::max(1e-2 * usual, least); closest < 0.1 * usual)
    distances.push_back(closest);
  for (const double s : distances) {
    State state = point.state.copy();
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
        const double now = calls.residual(state.at(trial, state.lambda + dLambda), *r).relative();
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
    result.state = calls.settled(state);
    result.inertia = calls.inertia();
    if (!problem.symmetric() && options.watchedModes > 0)
      if (const auto unstable = countUnstable(calls, options.watchedModes + 1))
        result.inertia = linear::Inertia{unstable->all, 0};
    return result;
  }
  return result;
}

}  // namespace atrapos::path
