#pragma once

#include <optional>
#include <string>
#include <vector>

#include "Landmarks.hpp"
#include "PadePatience.hpp"
#include "PathUnderWay.hpp"
#include "StepStability.hpp"
#include "StepStart.hpp"
#include "atrapos/path/Monitor.hpp"

namespace atrapos::path {

/// One path, step by step.
///
/// A step that has been accepted stays pending until the tangent at its end is known, which the next step's
/// factorization brings: the direction there is checked, eigenvalues that changed sign are explained, then
/// the observer sees it.
class Run {
 public:
  Run(Problem& problem, linear::TangentSolver& solver, const Options& options, const Stops& stops,
      const std::vector<Monitor>& monitors, Observer& observer, const Start& start);

  /// To the path's end; once.
  Outcome follow();

 private:
  void followFromStart();
  bool step();
  bool settleWith(const Series& series);
  void begin(StepReport& report, const Series& series);
  bool isNegligible(const Series& series) const;
  Trial endOf(Series& series, StepReport& report);
  bool settle(const EndTangent* end);
  void finish();
  Start next() const;
  std::string passed() const { return path_.stops.passed(limitPoints_, bifurcations_); }
  bool end(EndReason reason, std::string text);

  const Start& start_;
  const std::vector<Monitor>& monitors_;
  Observer& observer_;
  Calls calls_;
  PathUnderWay path_;
  StepStart stepStart_;
  StepStability stability_;
  PadePatience patience_;
  /// None where internal variables tell states with the same unknowns apart.
  std::optional<Landmarks> landmarks_;
  std::optional<int> backAt_;  ///< the step at whose start the path is again
  int limitPoints_ = 0;        ///< passed, up to the last step that the observer has seen
  int bifurcations_ = 0;       ///< the same
};

}  // namespace atrapos::path
