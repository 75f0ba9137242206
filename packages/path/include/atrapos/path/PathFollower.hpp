#pragma once

#include "atrapos/path/Monitor.hpp"
#include "atrapos/path/Options.hpp"
#include "atrapos/path/Problem.hpp"
#include "atrapos/path/Report.hpp"
#include "atrapos/path/Stops.hpp"

namespace atrapos::path {

/// Follows the solution path of a Problem, one Taylor series per step.
///
/// A step: series at the state (one factorization), range from eq. (36), shortened to the first stop, true
/// residual at the end, cut back along the same series while that is over the bound, Newton correction where
/// little room is left under the bound. Prints nothing; an Observer sees every step.
///
/// Problem and solver must outlive the follower. All calls are collective on the Problem's communicator.
class PathFollower {
 public:
  /// Throws std::invalid_argument, one line, on options or stops that make no sense.
  PathFollower(Problem& problem, linear::TangentSolver& solver, Options options, Stops stops = {});

  /// Follows the path from `start` (not changed) until something ends it. Failures of the Problem, the solver
  /// or the numbers end the path with a reason; steps reported before stay valid. Exceptions thrown by the
  /// observer pass through.
  Outcome run(const State& start, Observer& observer);

  /// The same from a point with a direction: a branch, or StepReport::next of an interrupted path.
  Outcome runFrom(const Start& start, Observer& observer);

  /// From here on the limit points of these functionals are reported too (StepReport::extrema). Throws
  /// std::invalid_argument, one line, on one without weights.
  void watch(std::vector<Monitor> monitors);

  const Options& options() const { return options_; }

 private:
  Problem& problem_;
  linear::TangentSolver& solver_;
  Options options_;
  Stops stops_;
  std::vector<Monitor> monitors_;
};

}  // namespace atrapos::path
