#include "atrapos/path/PathFollower.hpp"

#include <stdexcept>

#include "Run.hpp"
#include "Stopwatch.hpp"

namespace atrapos::path {

PathFollower::PathFollower(Problem& problem, linear::TangentSolver& solver, Options options, Stops stops)
    : problem_(problem), solver_(solver), options_(std::move(options)), stops_(std::move(stops)) {
  options_.validate();
  stops_.validate();
  if (stops_.bifurcations > 0 && !options_.criticalPoints)
    throw std::invalid_argument("path stops: a bifurcation point is none where they are not looked for");
}

void PathFollower::watch(std::vector<Monitor> monitors) {
  validate(monitors);
  monitors_ = std::move(monitors);
}

Outcome PathFollower::run(const State& start, Observer& observer) {
  Start point;
  point.state = start;
  return runFrom(point, observer);
}

Outcome PathFollower::runFrom(const Start& start, Observer& observer) {
  Outcome outcome;
  double total = 0;
  {
    Stopwatch watch(total);
    outcome = Run(problem_, solver_, options_, stops_, monitors_, observer, start).follow();
  }
  outcome.seconds.total = total;
  return outcome;
}

}  // namespace atrapos::path
