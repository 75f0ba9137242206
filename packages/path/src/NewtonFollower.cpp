#include "atrapos/path/NewtonFollower.hpp"

#include <cmath>
#include <sstream>
#include <stdexcept>

#include "NewtonRun.hpp"
#include "Stopwatch.hpp"

namespace atrapos::path {

namespace {
void require(bool good, const char* name, double value, const char* accepted) {
  if (good) return;
  std::ostringstream text;
  text << "newton options: " << name << " = " << value << ", must be " << accepted;
  throw std::invalid_argument(text.str());
}
}  // namespace

void NewtonOptions::validate() const {
  const auto positive = [](double x) { return std::isfinite(x) && x > 0; };
  require(positive(residualBound), "residualBound", residualBound, "positive and finite");
  require(accuracy > 0, "accuracy", accuracy, "positive");
  if (desiredIterations)
    require(positive(*desiredIterations), "desiredIterations", *desiredIterations, "positive and finite");
  require(minIterations >= 1, "minIterations", minIterations, ">= 1");
  require(maxIterations >= minIterations, "maxIterations", maxIterations, "at least minIterations");
  require(refactorAbove > 0 && refactorAbove < 1, "refactorAbove", refactorAbove, "in (0, 1)");
  require(minCosine > 0 && minCosine < 1, "minCosine", minCosine, "in (0, 1)");
  require(direction == 1 || direction == -1, "direction", direction, "+1 or -1");
  if (weight) require(positive(*weight), "weight", *weight, "positive and finite");
  require(positive(firstStep), "firstStep", firstStep, "positive and finite");
  require(maxGrowth > 1, "maxGrowth", maxGrowth, "more than 1");
  require(positive(maxStep), "maxStep", maxStep, "positive and finite");
  require(positive(minStep) && minStep < maxStep, "minStep", minStep, "positive and less than maxStep");
  require(maxSteps >= 0, "maxSteps", maxSteps, ">= 0");
  require(maxStartIterations >= 0, "maxStartIterations", maxStartIterations, ">= 0");
}

NewtonFollower::NewtonFollower(Problem& problem, linear::TangentSolver& solver, NewtonOptions options,
                               Stops stops)
    : problem_(problem), solver_(solver), options_(std::move(options)), stops_(std::move(stops)) {
  options_.validate();
  stops_.validate();
  if (stops_.bifurcations > 0)
    throw std::invalid_argument(
        "path stops: Newton steps do not look for bifurcation points: use PathFollower");
  if (problem_.eventCount() > 0)
    throw std::invalid_argument(
        "Newton steps do not follow a Problem that changes by events: use PathFollower, or a regularised "
        "law");
}

Outcome NewtonFollower::run(const State& start, Observer& observer) {
  Start point;
  point.state = start;
  return runFrom(point, observer);
}

Outcome NewtonFollower::runFrom(const Start& start, Observer& observer) {
  Outcome outcome;
  double total = 0;
  {
    Stopwatch watch(total);
    NewtonRun run(problem_, solver_, options_, stops_, observer, outcome);
    run.follow(start);
    static_cast<Work&>(outcome) = run.work();
  }
  outcome.seconds.total = total;
  return outcome;
}

}  // namespace atrapos::path
