#pragma once

#include <iosfwd>

#include "commands/ModelCase.hpp"
#include "scene/Scene.hpp"

namespace atrapos {

/// What would be solved: effective deck values, sizes, contact gaps, memory of all ranks. Collective.
void printCheck(const deck::Deck& deck, Scene& scene, std::ostream& out);

/// The same for a model problem.
void printCheck(const ModelCase& model, std::ostream& out);

}  // namespace atrapos
