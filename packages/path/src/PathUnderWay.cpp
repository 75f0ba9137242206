#include "PathUnderWay.hpp"

#include <algorithm>

#include <Tpetra_Vector.hpp>

namespace atrapos::path {

PathUnderWay::PathUnderWay(Calls& calls_, const Options& options_, const Stops& stops_, const Start& start)
    : calls(calls_),
      options(options_),
      stops(stops_),
      order(start.order > 0 ? start.order : options_.order),
      fieldSizes(start.fieldSizes) {
  here.state = start.state.copy();
  here.r = calls.newVector();
  here.pathLength = start.pathLength;
  here.weight = start.weight ? start.weight : options.weight;
  here.tangent = start.tangent;
  here.lastLength = start.length;
  here.relaxLength = start.relaxLength;
  here.due = start.due;
  here.applied = start.events;
  outcome.steps = start.steps;
  outcome.weight = start.weight.value_or(0);
  calls.weighFields(fieldFactors());
}

void PathUnderWay::accept(Trial trial, StepReport report, LastStep step) {
  trial.state = calls.settled(trial.state);
  fieldSizes.moved(calls.fieldChanges(here.state, trial.state), trial.state.lambda - here.state.lambda);
  report.length = trial.a;
  report.residual = trial.residual;
  report.lambdaEnd = trial.state.lambda;
  report.end = trial.state;
  report.pathLengthEnd = report.pathLengthStart + trial.a;

  ++outcome.steps;
  outcome.corrections += report.corrections;
  outcome.cutBacks += report.cutBacks;
  last = std::move(step);
  last->at = trial.a;
  here.moveTo(trial.state, trial.r, trial.residual);
  here.pathLength = report.pathLengthEnd;
  here.tangent = last->series.tangent(trial.a);
  // Behind events a step is short for what begins there, and says little about the next.
  constexpr double longer = 8;
  here.relaxLength = (last->behindEvents ? longer : 1) * trial.a;
  here.lastLength = trial.a;
  here.stop = trial.stop;
  here.due = trial.events;
  here.applied.clear();
  orders.add(last->series);
  if (options.autoOrder) order = orders.best(calls, options.delta, order);
  pending = std::move(report);
}

void PathUnderWay::improveEnd(State state, RCP<Vector> r, double residual) {
  here.moveTo(calls.settled(state), std::move(r), residual);
  pending->end = here.state;
  pending->lambdaEnd = state.lambda;
  pending->residual = residual;
}

void PathUnderWay::countCorrections(int iterations) {
  outcome.corrections += iterations;
  if (pending) pending->corrections += iterations;
}

double PathUnderWay::correctAbove() const {
  constexpr double loosest = 1e-4;
  return std::min(options.correctAbove * options.residualBound, loosest);
}

double PathUnderWay::longestLength() const {
  constexpr double leastRate = 1e-9;
  const double rate = here.tangent ? std::max(leastRate, std::abs(here.tangent->lambda)) : 1.0;
  const double longest = options.maxStep.value_or(std::max(defaultMaxStep, 10 / rate));
  if (!(here.relaxOver > 0 && here.residual > 0)) return longest;
  return std::min(longest, here.relaxOver * (1 + 0.5 * bound() / here.residual));
}

}  // namespace atrapos::path
