#pragma once

#include "SingularStart.hpp"

namespace atrapos::path {

/// How a step begins: the series at the position.
class StepStart {
 public:
  explicit StepStart(PathUnderWay& path) : path_(path), singularStart_(path) {}

  /// The position where the path starts becomes one of its states. Throws PathError: notFinite,
  /// startNotInEquilibrium.
  void equilibrate();

  /// The series of the next step. What it takes to have one moves the position: events, a singular tangent,
  /// another direction than that of the step behind, which is then shorter. Throws PathError.
  Series series(StepReport& report);

 private:
  Series smoothSeries(StepReport& report);
  void stepOverSingularity(const PathError& cause, int attempt);
  bool directionAgrees(const Series& series) const;
  void uncount(const StepReport& report);
  bool retreat();
  bool beginAgain();

  PathUnderWay& path_;
  SingularStart singularStart_;
  int begunAgain_ = -1;  ///< the last step whose start was solved anew
};

}  // namespace atrapos::path
