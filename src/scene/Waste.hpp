#pragma once

#include <string>
#include <vector>

#include "scene/Scene.hpp"

namespace atrapos {

/// Where a scene models more than it needs, a line each; empty: nowhere. Bodies of solids so thin that shells
/// would do, along x, y or z; solids in which nothing moves along one of these, so that a plane body would
/// do; contacts of sides that look away from their tool (sidesAway); orders that charts (docs/chart.md) show
/// to cost more than they bring.
std::vector<std::string> waste(const Scene& scene);

}  // namespace atrapos
