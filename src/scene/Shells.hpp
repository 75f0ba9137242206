#pragma once

#include "atrapos/fem/ShellGeometry.hpp"
#include "atrapos/fem/ShellJoints.hpp"
#include "atrapos/fem/ShellOrientation.hpp"
#include "atrapos/solid/ShellLoads.hpp"
#include "deck/Deck.hpp"

namespace atrapos {

/// The shells of a scene: their directors and the numbering of the unknowns, and the elements of each block
/// as the shell's terms and loads take them.
struct SceneShells {
  fem::ShellGeometry geometry;
  std::vector<solid::ShellElements> elements;  ///< [position in geometry.blocks]
  std::vector<deck::Shear> shear;              ///< the same
  std::vector<solid::ShellCubature> cubature;  ///< the same
  fem::ShellJoints joints;                     ///< as joinShells has made them
  std::vector<fem::ShellPart> parts;           ///< as orientShells has turned them

  bool empty() const { return elements.empty(); }
  /// Position of a block of the mesh in geometry.blocks; -1: it has no shells.
  int find(int block) const;
};

/// All shells of a deck's mesh; empty where it has none. Blocks without a section have their thickness in
/// their attributes. Turns shells over in the mesh where the normals of neighbours do not agree. Throws
/// deck::DeckError for shells that cannot be, and for SHELL9.
SceneShells sceneShells(const deck::Deck& deck, fem::Mesh& mesh);

/// Couples shared edges (fem::coupleSharedEdges) and makes the folds and branches of the shells rigid joints,
/// those excepted that the deck has as hinges; after the supports and couplings of the model. Throws
/// deck::DeckError.
fem::ShellJoints joinShells(const deck::Deck& deck, const fem::Mesh& mesh, const SceneShells& shells,
                            fem::FeModel& model);

/// Lines on what the program has made of shells that was not said in so many words.
std::vector<std::string> describe(const fem::Mesh& mesh, const SceneShells& shells);

/// The surface's zeta: -1 bottom, 0 middle, 1 top.
double zetaOf(deck::ShellPlace place);

/// The edges in a side set of shells that belong to one block: elements counted within the block.
std::vector<solid::ShellEdge> shellEdges(const fem::Mesh& mesh, const fem::SideSet& set, int block);

}  // namespace atrapos
