#pragma once

#include <string>

#include "atrapos/fem/Mesh.hpp"
#include "deck/Deck.hpp"
#include "scene/DeckMesh.hpp"

namespace atrapos {

/// The mesh that the deck's mesh/generate describes. Throws deck::DeckError where it has none or it is wrong.
fem::Mesh generateMesh(const deck::Deck& deck);

/// "1 234 nodes, 80 HEX20 in block 'strip', ..." for the user.
std::string describeMesh(const fem::Mesh& mesh);

}  // namespace atrapos
