#pragma once

#include <string>

#include "atrapos/fem/Mesh.hpp"
#include "deck/Deck.hpp"
#include "scene/DeckMesh.hpp"

namespace atrapos {

/// The mesh that the deck's mesh/generate describes. Throws deck::DeckError where it has none or it is wrong.
fem::Mesh generateMesh(const deck::Deck& deck);

/// One line where a mesh is not what the deck's mesh/generate makes, which may have changed since; empty
/// where it is, where nothing is generated and of meshes so large that it takes long to tell.
std::string otherThanGenerated(const deck::Deck& deck, const fem::Mesh& mesh);

/// "1 234 nodes, 80 HEX20 in block 'strip', ..." for the user.
std::string describeMesh(const fem::Mesh& mesh);

}  // namespace atrapos
