#pragma once

#include "atrapos/fem/ShellGeometry.hpp"
#include "atrapos/solid/ShellLoads.hpp"
#include "deck/Deck.hpp"

namespace atrapos {

/// The shells of a scene: their directors and the numbering of the unknowns, and the elements of each block
/// as the shell's terms and loads take them.
struct SceneShells {
  fem::ShellGeometry geometry;
  std::vector<solid::ShellElements> elements;  ///< [position in geometry.blocks]
  std::vector<deck::Shear> shear;              ///< the same

  bool empty() const { return elements.empty(); }
  /// Position of a block of the mesh in geometry.blocks; -1: it has no shells.
  int find(int block) const;
};

/// All shells of a deck's mesh; empty where it has none. Blocks without a section have their thickness in
/// their attributes. Throws deck::DeckError for shells that cannot be, and for cells other than SHELL8.
SceneShells sceneShells(const deck::Deck& deck, const fem::Mesh& mesh);

/// The surface's zeta: -1 bottom, 0 middle, 1 top.
double zetaOf(deck::ShellPlace place);

/// The edges in a side set of shells that belong to one block: elements counted within the block.
std::vector<solid::ShellEdge> shellEdges(const fem::Mesh& mesh, const fem::SideSet& set, int block);

}  // namespace atrapos
