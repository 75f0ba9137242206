#pragma once

#include <map>

#include "atrapos/solid/ThinBody.hpp"
#include "deck/Deck.hpp"

namespace atrapos {

/// Marks the blocks that a deck has as membranes; names that the mesh does not have are passed over.
void markMembranes(const deck::Deck& deck, fem::Mesh& mesh);

/// The sections of membranes and bars by their block.
std::map<int, solid::ThinSection> thinSections(const deck::Deck& deck, const fem::Mesh& mesh);

}  // namespace atrapos
