#pragma once

#include <string>

#include "PathUnderWay.hpp"

namespace atrapos::path {

/// Where the tangent is singular at the position: the path goes on a little further.
class SingularTangents {
 public:
  explicit SingularTangents(PathUnderWay& path) : path_(path) {}

  /// Moves the position along the last series, or off the state where the path starts. `attempt` counts from
  /// 1. Throws PathError with the reason of `cause` where that does not help.
  void stepOver(const PathError& cause, int attempt);

 private:
  void startAside(const PathError& cause);

  PathUnderWay& path_;
  std::string mechanism_;  ///< the null vector of a singular start that was left aside
};

}  // namespace atrapos::path
