#pragma once

#include <string>
#include <vector>

#include "atrapos/linear/TangentSolver.hpp"
#include "atrapos/path/Problem.hpp"
#include "scene/Scene.hpp"

namespace atrapos {

/// What a deck's numbers come to before any path, one line each, so that a wrong unit shows: the sum of its
/// forces, how slender its bodies are, and the linear answer at the load factor where the path ends (else 1),
/// a warning where that is absurd, and where it is the same all around an axis. `solver` has analysed the
/// tangent; nothing is factored that takes more than 1e11 operations. Collective.
std::vector<std::string> describeFirstAnswer(Scene& scene, const path::State& start,
                                             linear::TangentSolver& solver);

}  // namespace atrapos
