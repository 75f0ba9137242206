#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "atrapos/path/Report.hpp"
#include "atrapos/path/Stops.hpp"

namespace atrapos::path {

/// Where a path is, and what the next step has to know of how it came there.
struct Position {
  State state;
  RCP<Vector> r;         ///< R there
  double residual = 0;   ///< its relative norm
  double relaxOver = 0;  ///< length over which the series that starts here takes R to zero; 0: it keeps R
  double pathLength = 0;
  std::optional<double> weight;        ///< w of the path parameter; empty: the first step chooses it
  std::optional<PathTangent> tangent;  ///< of what led here; none where a path starts
  double lastLength = 0;               ///< of the last accepted step; 0 before the first
  double relaxLength = 0;              ///< over which the next series may take R to zero; 0 before the first
  std::optional<StopHit> stop;         ///< that the path has reached
  std::vector<int> due;                ///< event functions that fell to zero here and are not applied yet
  std::vector<int> applied;            ///< applied here: their functions start at zero
  bool turned = false;  ///< lambda goes the other way after the events, which the pending step is to say
  double jump = 0;      ///< the residual that corrections beyond a break have taken away here
  int standing = 0;     ///< events in a row without a step of sensible length

  void moveTo(State newState, RCP<Vector> newR, double newResidual) {
    state = std::move(newState);
    r = std::move(newR);
    residual = newResidual;
  }

  /// What is left at a of the residual that the series starts with.
  double startPart(double a) const {
    return relaxOver > 0 ? std::abs(1 - a / relaxOver) * residual : residual;
  }
};

}  // namespace atrapos::path
