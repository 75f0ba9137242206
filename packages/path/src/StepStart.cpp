#include "StepStart.hpp"

#include <algorithm>
#include <cmath>

#include <Tpetra_Vector.hpp>

#include "Augmented.hpp"
#include "EventChoice.hpp"
#include "EventSenses.hpp"
#include "Line.hpp"
#include "Newton.hpp"
#include "Rounded.hpp"
#include "SeriesHere.hpp"

namespace atrapos::path {

namespace {

/// Part of the usual tolerance to which a state is solved whose residual turns the path.
constexpr double kSharper = 1e-4;

}  // namespace

void StepStart::equilibrate() {
  Calls& calls = path_.calls;
  Position& here = path_.here;
  here.state = calls.settled(here.state);
  State state = here.state.copy();
  here.residual = calls.residual(state, *here.r).relative();
  if (!std::isfinite(here.residual))
    throw PathError(EndReason::notFinite, "the residual at the start is not finite");
  const double allowed = !here.tangent          ? path_.correctAbove()
                         : here.applied.empty() ? path_.bound()
                                                : path_.boundAtEvents();
  if (here.residual <= allowed) return;
  constexpr int maxHalvings = 10;
  const auto result = newton(calls, state, *here.r, holdLoad(), path_.correctAbove(),
                             path_.options.maxStartIterations, maxHalvings);
  path_.outcome.startIterations = result.iterations;
  if (!result.converged)
    throw PathError(EndReason::startNotInEquilibrium,
                    line("no equilibrium found at the start, lambda = ", state.lambda, ": ", result.trouble,
                         " (relative residual ", result.residual, ')'));
  here.residual = result.residual;
  here.state = calls.settled(state);
}

Series StepStart::series(StepReport& report) {
  Position& here = path_.here;
  // Not empty here: events were applied at this very state before the path was interrupted.
  const bool restarted = !here.applied.empty();
  Series series = !here.due.empty() ? EventChoice(path_, report).series()
                  : restarted       ? seriesAfterRestart(path_)
                                    : smoothSeries(report);
  for (auto due = overdue(path_, series); !due.empty(); due = overdue(path_, series)) {
    ++path_.outcome.eventTrials;
    ++report.restarts;
    here.due = due;
    series = EventChoice(path_, report, EventChoice::Due::fallFromHere).series();
  }
  return series;
}

Series StepStart::smoothSeries(StepReport& report) {
  Position& here = path_.here;
  for (int attempt = 1;;) {
    SeriesRequest request;
    // Beside next to no forces that far less counts for motion than what a residual may be.
    constexpr double nothing = 1e-9;
    const bool relaxes = path_.options.relaxResidual && here.residual > nothing * path_.bound();
    here.relaxOver = relaxes ? here.relaxLength : 0;
    if (here.relaxOver > 0) {
      request.residual = here.r.get();
      request.relaxOver = here.relaxOver;
    }
    try {
      Series series = seriesHere(path_, request, {});
      if (directionAgrees(series)) return series;
    } catch (const PathError& error) {
      if (error.reason() != EndReason::singularTangent) throw;
      stepOverSingularity(error, attempt);
      ++attempt;
      ++report.restarts;
      continue;
    }
    if (!retreat() && !beginAgain())
      throw PathError(EndReason::directionLost,
                      line("at lambda = ", here.state.lambda,
                           ": the path's direction at the end of a step is not that of its series, and "
                           "shorter steps do not help"));
  }
}

/// The tangent is singular at the position: go on a little along the last series and start there.
void StepStart::stepOverSingularity(const PathError& cause, int attempt) {
  Position& here = path_.here;
  const auto giveUp = [&](const std::string& why) {
    throw PathError(cause.reason(), line("at lambda = ", here.state.lambda, ": ", cause.what(), "; ", why));
  };
  if (!path_.last) {
    singularStart_.leave(cause);
    return;
  }
  LastStep& last = *path_.last;
  constexpr int maxAttempts = 3;
  if (attempt > maxAttempts) giveUp("stepping over it along the previous series did not help");
  // Small against the step, so that the residual, which grows like a^(K+1), hardly changes.
  const double shift = std::min(1e-3 * std::pow(4.0, attempt - 1) * here.lastLength,
                                0.5 * (path_.stops.pathLength - here.pathLength));
  Trial trial;
  trial.a = last.at + shift;
  evaluate(path_, last.series, trial);
  if (!(trial.residual <= path_.bound())) giveUp("the previous series does not reach past it");
  ++path_.outcome.restarts;
  last.at = trial.a;
  here.moveTo(trial.state, trial.r, trial.residual);
  here.pathLength += shift;
  here.tangent = last.series.tangent(trial.a);
}

/// The direction at a step's end, once by the derivative of the series that led there and once by the tangent
/// found there, is the same to the accuracy of that derivative, unless the two lie on different branches.
bool StepStart::directionAgrees(const Series& series) const {
  if (path_.order < 3) return true;  // a straight or parabolic step may turn by any angle
  if (!path_.last) return true;      // a direction given at the start says the sense only
  if (!path_.here.weight) return true;  // next to nothing has moved: its direction is none
  // Of the unknowns alone: which internal variables take part may differ from series to series.
  const PathTangent& previous = *path_.here.tangent;
  const Augmented before{previous.x.u, previous.lambda};
  const Augmented now{series.coefficient(1).u, series.lambdaCoefficient(1)};
  const auto inner = [&](const Augmented& x, const Augmented& y) {
    return dot(path_.calls.problem(), x, y, series.weight());
  };
  return inner(now, before) > path_.options.minCosine * std::sqrt(inner(before, before) * inner(now, now));
}

/// The step of this report is made again, and what it took counted with that.
void StepStart::uncount(const StepReport& report) {
  Outcome& outcome = path_.outcome;
  --outcome.steps;
  outcome.corrections -= report.corrections;
  outcome.cutBacks -= report.cutBacks;
}

/// The pending step ends half as far along its series. False where it was shortened often enough.
bool StepStart::retreat() {
  constexpr int maxRetreats = 4;
  if (!path_.pending || path_.pending->retreats == maxRetreats) return false;
  StepReport report = *path_.pending;
  Trial trial;
  trial.a = rounded(0.5 * report.length);
  if (trial.a < path_.options.minStep) return false;
  evaluate(path_, path_.last->series, trial);
  ++report.retreats;
  ++path_.outcome.retreats;
  uncount(report);
  // Two branches are near, and the residual is what turns the path from one to the other.
  correct(path_, path_.last->series, trial, report, kSharper * path_.correctAbove());
  path_.accept(std::move(trial), std::move(report), std::move(*path_.last));
  return true;
}

/// Where shorter steps do not help it is the state they begin at that is off: beside steep laws even a
/// residual within the bound turns a series away. The pending step goes, and the path is again at its start,
/// which is solved as far as it goes. False where that has been tried at this step, or changes next to
/// nothing.
bool StepStart::beginAgain() {
  Calls& calls = path_.calls;
  const Problem& problem = calls.problem();
  // Behind events their functions are zero, which only the step that begins there knows.
  if (!path_.pending || path_.pending->step == begunAgain_ || path_.last->behindEvents) return false;
  const StepReport report = *path_.pending;
  const Series& series = path_.last->series;
  const PathTangent tangent = series.tangent(0);
  State start = series.state(0).copy();
  auto r = calls.newVector();
  const double before = calls.residual(start, *r).relative();
  constexpr double useful = 0.1;
  constexpr int maxIterations = 5, maxHalvings = 4;
  const NewtonResult result = newton(calls, start, *r, holdPathParameter(problem, series.weight(), tangent),
                                     kSharper * path_.correctAbove(), maxIterations, maxHalvings);
  if (!(result.residual < useful * before)) return false;
  begunAgain_ = report.step;
  uncount(report);
  path_.outcome.corrections += result.iterations;
  Position& here = path_.here;
  here.moveTo(calls.settled(start), r, result.residual);
  here.pathLength = report.pathLengthStart;
  here.tangent = tangent;
  here.stop.reset();
  path_.pending.reset();
  path_.last.reset();
  return true;
}

}  // namespace atrapos::path
