#pragma once

#include <vector>

#include "EndTangent.hpp"
#include "atrapos/path/Monitor.hpp"

namespace atrapos::path {

struct PathUnderWay;

/// Limit points of the load in the path's last step, whose report has its length and its start's inertia.
/// `end` is the tangent at its end; null: that is another one (an event), or not known.
std::vector<LimitPoint> limitPointsOf(const PathUnderWay& path, const StepReport& report,
                                      const EndTangent* end);

/// Limit points of the monitors on a series up to this length, ascending.
std::vector<Extremum> extremaOf(const Series& series, double length, const std::vector<Monitor>& monitors);

}  // namespace atrapos::path
