#include "BehindEvents.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <Tpetra_Vector.hpp>

#include "Augmented.hpp"
#include "Line.hpp"
#include "Newton.hpp"
#include "PathUnderWay.hpp"
#include "atrapos/linear/Dot.hpp"

namespace atrapos::path {

namespace {

/// Whether a stop lies between two states.
bool passesStop(const Stops& stops, const State& from, const State& to) {
  const auto between = [](double value, double a, double b) {
    return (value - a) * (value - b) <= 0 && a != b;
  };
  for (const double lambda : stops.loadFactors)
    if (between(lambda, from.lambda, to.lambda)) return true;
  for (const StopFunctional& f : stops.functionals)
    if (between(f.value, linear::dot(*f.weights, *from.u), linear::dot(*f.weights, *to.u))) return true;
  return false;
}

/// A break at which forces jump a little, or a contact that closes where a gap does: Newton corrections lead
/// on to the path beyond. Where forces that rise turn the state back over the border, its path begins a
/// little ahead. Nothing is changed where they jump by more than Options::jumpBound, the corrections do not
/// converge or would miss a stop.
void passJump(PathUnderWay& path) {
  Position& here = path.here;
  if (!(here.residual <= path.options.jumpBound)) return;
  constexpr int maxIterations = 10, maxHalvings = 0;
  const bool along = here.tangent && here.weight;
  const Border border =
      along ? holdPathParameter(path.calls.problem(), *here.weight, *here.tangent) : holdLoad();
  for (const double ahead : {0.0, 1e-4, 1e-3}) {
    if (ahead > 0 && !along) break;
    State state = here.state.copy();
    if (ahead > 0) {
      state.u->update(ahead * here.lastLength, *here.tangent->x.u, 1);
      state.lambda += ahead * here.lastLength * here.tangent->lambda;
    }
    auto r = copy(*here.r);
    const auto result =
        newton(path.calls, state, *r, border, path.correctAbove(), maxIterations, maxHalvings);
    path.countCorrections(result.iterations);
    if (!result.converged) continue;
    if (passesStop(path.stops, here.state, state)) return;
    here.jump = here.residual;
    here.moveTo(path.calls.settled(state), r, result.residual);
    return;
  }
}

/// Relative residuals up to this are rounding, where there are next to no forces.
constexpr double kRoundingOfLittle = 1e-3;

/// What begins or ends at an event has a size there: the state that solves the changed Problem with the event
/// function zero, a little further along the path. Newton iterations with that function as their border and
/// factorizations of their own, the first of which may be made before there is anything of that size. The
/// forces of what has just begun may be so small that rounding is more than the bound of them, or jump as
/// others begin beside it: the best state is taken then. False, and nothing changed, where the event needs
/// none of it, they do not converge or would miss a stop.
bool correctWithEvent(PathUnderWay& path, int event) {
  Calls& calls = path.calls;
  Position& here = path.here;
  auto byU = calls.newVector(), F = calls.newVector(), Uhat = calls.newVector(), x = calls.newVector();
  auto r = calls.newVector();
  State state = here.state.copy();
  std::optional<State> best;
  RCP<Vector> ofBest;
  double residual = calls.residual(state, *r).relative(), least = kRoundingOfLittle;
  constexpr int maxIterations = 20, factored = 2, mostRises = 3;
  const double enough = 1e-3 * path.bound();
  bool factor = true, little = false;
  for (int i = 0, rises = 0; i < maxIterations && rises < mostRises && !little; ++i) {
    double value = 0, byLambda = 0;
    if (!calls.eventGradient(event, state, value, *byU, byLambda)) return false;
    if (factor) {
      calls.factor(state, *F);
      calls.solve(*F, *Uhat);
      path.countCorrections(1);
    }
    calls.solve(*r, *x);
    // dU = -x + dlambda Uhat with value + byU . dU + byLambda dlambda = 0.
    const double dLambda = (linear::dot(*byU, *x) - value) / (linear::dot(*byU, *Uhat) + byLambda);
    x->update(dLambda, *Uhat, -1);
    state.u->update(1, *x, 1);
    state.lambda += dLambda;
    const double before = residual;
    residual = calls.residual(state, *r).relative();
    if (!std::isfinite(residual)) break;
    if (i + 1 < factored) continue;
    if (residual <= least) {
      least = residual;
      best = state.copy();
      ofBest = copy(*r);
    }
    const bool rose = i >= factored && residual > 0.5 * before;
    if (rose && factor) ++rises;
    little = residual <= enough || (rose && residual <= path.bound());
    // What has begun is stiff against the body, and stiffer from iteration to iteration.
    factor = residual > 0.1 * before;
  }
  if (!best || passesStop(path.stops, here.state, *best)) return false;
  here.moveTo(calls.settled(*best), ofBest, least);
  return true;
}

/// Of two states, in the metric of the path, which has its weight here.
double distance(const PathUnderWay& path, const State& from, const State& to) {
  const auto change = copy(*to.u);
  change->update(-1, *from.u, 1);
  const Augmented moved{change, to.lambda - from.lambda};
  return std::sqrt(dot(path.calls.problem(), moved, moved, *path.here.weight));
}

PathError isNoSolution(const Position& here) {
  return {EndReason::problemFailed,
          line("at lambda = ", here.state.lambda,
               ": the state does not solve the problem as an event has changed it (relative residual ",
               here.residual, ')')};
}

/// The state does not quite solve the Problem that an event has changed: what its series left out of the
/// event function, and rounding, are a residual there, which no shorter step would take away. Newton
/// iterations in the plane normal to the new direction, or at fixed load where they would miss a stop, with
/// one factorization; the series then has its own. Where the residual is large only a state that is `near`
/// here counts, by the share of the last step.
void correctSideways(PathUnderWay& path, std::optional<double> near = {}) {
  Calls& calls = path.calls;
  Position& here = path.here;
  auto F = calls.newVector(), Uhat = calls.newVector();
  calls.factor(here.state, *F);
  calls.solve(*F, *Uhat);
  path.countCorrections(1);
  std::vector<Border> borders = {holdLoad()};
  if (here.weight)
    borders.insert(borders.begin(), holdPathParameter(calls.problem(), *here.weight, {{Uhat, {}}, 1}));
  constexpr int maxIterations = 10;
  double best = here.residual;
  for (const Border& border : borders) {
    State state = here.state.copy();
    auto r = calls.newVector();
    const double residual =
        newtonAtHand(calls, state, *r, Uhat, border, path.correctAbove(), maxIterations).residual;
    best = std::min(best, residual);
    if (residual > path.bound() || passesStop(path.stops, here.state, state)) continue;
    if (near && !(distance(path, here.state, state) <= *near * here.lastLength)) continue;
    here.moveTo(calls.settled(state), r, residual);
    return;
  }
  if (near) throw isNoSolution(here);
  throw PathError(
      EndReason::stepTooSmall,
      line("at lambda = ", here.state.lambda, ": behind an event the relative residual ", here.residual,
           " is over the bound ", path.bound(), ", and Newton corrections lead to ", best,
           best > path.bound() ? " only: ask for a larger bound" : " but past a stop"));
}

}  // namespace

bool hasSize(const PathUnderWay& path, int event) {
  const auto byU = path.calls.newVector();
  double value = 0, byLambda = 0;
  return !path.isBreak(event) && path.options.maxCorrections > 0 &&
         path.calls.eventGradient(event, path.here.state, value, *byU, byLambda);
}

void solveBehindEvents(PathUnderWay& path, const std::vector<int>& chosen) {
  Calls& calls = path.calls;
  Position& here = path.here;
  const bool mayCorrect = path.options.maxCorrections > 0;
  here.relaxOver = 0;
  here.jump = 0;
  here.residual = calls.residual(here.state, *here.r).relative();
  if (here.residual > path.bound() && !chosen.empty() && calls.hasPieces()) passJump(path);
  if (mayCorrect)
    for (const int i : chosen)
      if (!path.isBreak(i) && correctWithEvent(path, i)) return;
  for (const int i : chosen)
    if (!(here.residual <= path.boundAtEvents()) && path.isBreak(i))
      throw PathError(EndReason::problemFailed,
                      line("at lambda = ", here.state.lambda, ": ", calls.breakText(i)));
  // What the orders left out of an event function, the gap of a contact that closes, is a residual that
  // corrections take away; one that is large may be another state, or next to none beside stiff contacts.
  constexpr double large = 1e-2, near = 1e-3;
  if (!mayCorrect) {
    if (!(here.residual <= path.boundAtEvents())) throw isNoSolution(here);
    return;
  }
  if (here.residual <= path.bound()) return;
  if (here.residual <= std::max(path.boundAtEvents(), large)) return correctSideways(path);
  if (!std::isfinite(here.residual) || !here.weight) throw isNoSolution(here);
  correctSideways(path, near);
}

}  // namespace atrapos::path
