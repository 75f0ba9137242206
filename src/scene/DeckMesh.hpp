#pragma once

#include <utility>
#include <vector>

#include "atrapos/fem/Mesh.hpp"
#include "deck/Deck.hpp"

namespace atrapos {

/// The mesh of a deck.
struct DeckMesh {
  DeckMesh(fem::Mesh whole) : mesh(std::move(whole)) {}
  DeckMesh(fem::Mesh whole, std::vector<int> decomposition)
      : mesh(std::move(whole)), ranks(std::move(decomposition)) {}

  fem::Mesh mesh;
  std::vector<int> ranks;  ///< [element] rank in whose part file it came; empty: no parts, or one rank
};

/// Reads the deck's mesh, where it asks for it or has no whole file from part files: then each rank reads its
/// own and all send theirs to the others (collective); a single rank reads all of them. A missing file is
/// told how to make it. Throws deck::DeckError.
DeckMesh readDeckMesh(const deck::Deck& deck);

}  // namespace atrapos
