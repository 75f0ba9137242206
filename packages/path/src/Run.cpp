#include "Run.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Tpetra_Vector.hpp>

#include "Line.hpp"
#include "PathEnd.hpp"
#include "Sharpening.hpp"
#include "StepLength.hpp"
#include "StepPoints.hpp"

namespace atrapos::path {

Run::Run(Problem& problem, linear::TangentSolver& solver, const Options& options, const Stops& stops,
         const std::vector<Monitor>& monitors, Observer& observer, const Start& start)
    : start_(start),
      monitors_(monitors),
      observer_(observer),
      calls_(problem, solver),
      path_(calls_, options, stops, start),
      stepStart_(path_),
      stability_(path_, start),
      patience_{start.padeFailures, start.padeWait},
      limitPoints_(start.limitPoints),
      bifurcations_(start.bifurcations) {
  if (!problem.remembers()) landmarks_.emplace(*problem.map(), start.landmarks);
}

Outcome Run::follow() {
  try {
    followFromStart();
  } catch (const PathError& error) {
    end(error.reason(), error.what());
  }
  finish();
  Outcome outcome = path_.outcome;
  outcome.final = path_.here.state;
  outcome.pathLength = path_.here.pathLength;
  static_cast<Work&>(outcome) = calls_.work();
  return outcome;
}

void Run::followFromStart() {
  Position& here = path_.here;
  stepStart_.equilibrate();
  if (!here.tangent && here.applied.empty()) here.due = calls_.eventsAt(here.state);
  if (!start_.stop.empty() && path_.stops.have(start_.stop)) {
    end(EndReason::stopReached, start_.stop);
  } else if (!passed().empty()) {
    end(EndReason::stopReached, passed());
  } else {
    while (step()) {
    }
  }
}

bool Run::step() {
  if (path_.outcome.steps == path_.options.maxSteps)
    return end(EndReason::stepLimit, line("the limit of ", path_.options.maxSteps, " steps is reached"));
  StepReport report;
  const auto factors = path_.fieldFactors();
  calls_.weighFields(factors);
  Series series = stepStart_.series(report);
  if (sharpenState(path_, series)) series = stepStart_.series(report);
  if (!settleWith(series)) return false;
  clean(path_, series);
  begin(report, series);
  Trial trial = endOf(series, report);
  path_.accept(std::move(trial), std::move(report),
               {std::move(series), factors, !path_.here.applied.empty()});
  if (path_.here.stop) return end(EndReason::stopReached, path_.here.stop->text);
  return true;
}

/// The tangent that the next step's series begins with tells of the pending step. False where the path ends
/// with that.
bool Run::settleWith(const Series& series) {
  const PathTangent along{series.coefficient(1), series.lambdaCoefficient(1)};
  EndTangent tangent = stability_.tangentHere(along, series.weight());
  tangent.lambda1 = along.lambda;
  // After an event the tangent is that of the changed problem and says nothing about the step before.
  if (path_.pending && !settle(path_.pending->events.empty() ? &tangent : nullptr))
    return end(EndReason::observerStopped, "ended by the observer");
  if (!passed().empty()) return end(EndReason::stopReached, passed());
  if (backAt_)
    return end(EndReason::pathClosed, line("the path is closed: step ", path_.outcome.steps,
                                           " comes to the state with which step ", *backAt_, " began"));
  stability_.begin(std::move(tangent));
  return true;
}

/// A step starts at the position.
void Run::begin(StepReport& report, const Series& series) {
  Position& here = path_.here;
  report.order = series.order();
  report.step = path_.outcome.steps + 1;
  report.lambdaStart = here.state.lambda;
  report.pathLengthStart = here.pathLength;
  report.inertia = stability_.start().inertia;
  report.radius = series.radius(path_.options.delta);
  if (series.standsStill()) return;  // no response to weigh
  path_.outcome.weight = series.weight();
  if (here.weight || !isNegligible(series)) here.weight = series.weight();
}

/// Whether the response, as it is here, would move next to nothing up to the next load factor at which the
/// path stops: laws whose forces fall off (a tool that is far away) grow by any power of ten until it does.
bool Run::isNegligible(const Series& series) const {
  const double rate = series.lambdaCoefficient(1);
  double ahead = std::numeric_limits<double>::infinity();
  for (const double stop : path_.stops.loadFactors)
    if ((stop - path_.here.state.lambda) * rate > 0)
      ahead = std::min(ahead, std::abs(stop - path_.here.state.lambda));
  if (!std::isfinite(ahead)) return false;
  Vector change(*series.coefficient(1).u, Teuchos::Copy);
  change.scale(ahead / rate);
  return calls_.problem().isNegligible(change);
}

/// The end of the step, corrected where it has to be.
Trial Run::endOf(Series& series, StepReport& report) {
  Trial trial;
  try {
    trial = acceptedTrial(path_, series, report, stability_.start().modes, patience_);
  } catch (...) {
    path_.outcome.cutBacks += report.cutBacks;
    throw;
  }
  report.residualOfSeries = trial.residual;
  // A break stays on its border, where it is told which way the path goes on.
  const bool atBreak = !trial.events.empty() && path_.isBreak(trial.events.back());
  if (!atBreak) correct(path_, series, trial, report, path_.correctAbove());
  return trial;
}

/// The pending step is final: what lies inside it is read off its series, and the observer sees it.
bool Run::settle(const EndTangent* end) {
  StepReport report = std::move(*path_.pending);
  path_.pending.reset();
  const LastStep& last = *path_.last;
  calls_.weighFields(last.factors);
  const std::vector<LimitPoint> atStart = std::move(report.limitPoints);
  report.limitPoints = limitPointsOf(path_, report, end);
  path_.here.turned = false;
  report.extrema = extremaOf(last.series, report.length, monitors_);
  if (end) {
    report.inertiaEnd = end->inertia;
    report.uncounted = end->uncounted;
    stability_.explain(report, *end, observer_);
  }
  report.limitPoints.insert(report.limitPoints.begin(), atStart.begin(), atStart.end());
  path_.outcome.worstResidual = std::max(path_.outcome.worstResidual, report.residual);
  if (landmarks_) backAt_ = landmarks_->pass(report.step, last.series, report.length);
  limitPoints_ += static_cast<int>(report.limitPoints.size());
  bifurcations_ += static_cast<int>(report.criticalPoints.size());
  report.next = next();
  const bool goOn = observer_.onStep(report, last.series);
  calls_.weighFields(path_.fieldFactors());
  return goOn;
}

/// All that the next step needs.
Start Run::next() const {
  const Position& here = path_.here;
  const Outcome& outcome = path_.outcome;
  Start next;
  next.state = here.state;
  next.tangent = here.tangent;
  next.steps = outcome.steps;
  next.pathLength = here.pathLength;
  next.weight = here.weight;
  next.fieldSizes = path_.fieldSizes.sizes();
  next.length = here.lastLength;
  next.relaxLength = here.relaxLength;
  next.events = here.applied;
  next.due = here.due;
  next.order = path_.order;
  next.padeFailures = patience_.failures;
  next.padeWait = patience_.wait;
  if (landmarks_) next.landmarks = landmarks_->trail();
  stability_.tell(next);
  next.limitPoints = limitPoints_;
  next.bifurcations = bifurcations_;
  next.stop = outcome.reason == EndReason::stopReached ? outcome.text : passed();
  return next;
}

void Run::finish() {
  if (!path_.pending) return;
  const EndReason reason = path_.outcome.reason;
  const bool ended = reason == EndReason::stopReached || reason == EndReason::stepLimit;
  if (ended && path_.options.closeEnd && (calls_.solver().inertia() || path_.pending->inertia)) {
    const EndTangent tangent = closeEnd(path_, stability_);
    settle(&tangent);
  } else {
    settle(nullptr);
  }
  if (reason == EndReason::stepLimit && !passed().empty()) end(EndReason::stopReached, passed());
}

bool Run::end(EndReason reason, std::string text) {
  path_.outcome.reason = reason;
  path_.outcome.text = std::move(text);
  return false;
}

}  // namespace atrapos::path
