#pragma once

#include <iosfwd>

#include "Scene.hpp"

namespace atrapos {

/// What would be solved: effective deck values, sizes, contact gaps, memory.
void printCheck(Scene& scene, std::ostream& out);

}  // namespace atrapos
