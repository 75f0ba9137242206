#pragma once

#include <string>
#include <vector>

#include "atrapos/fem/Mesh.hpp"
#include "deck/Deck.hpp"

namespace atrapos {

/// A box around what tools act on; tools without an end are drawn a little farther than it reaches.
struct Box {
  deck::Vector3 low{}, high{};
};

/// The surface of a tool where it stands before it moves, in quadrilaterals between points that lie on it:
/// its place in `mesh` is a block of its name.
void appendToolShape(const deck::Tool& tool, const Box& box, fem::Mesh& mesh);

/// Where the motion takes a place at this load factor.
deck::Vector3 moved(const deck::ToolMotion& motion, double loadFactor, const deck::Vector3& place);

/// Removes the files of tools that a run wrote into the folder. Throws FileError.
void removeToolShapes(const std::string& folder);

/// For every result file in the folder a file of the surfaces of the deck's tools beside it (tools.exo,
/// tools_branch1.exo, ...), with a displacement for each of its states, so that viewers show them moving
/// together; none where the deck has no tools. Files of that name are removed before. Throws exodus::Error,
/// FileError.
void writeToolShapes(const std::string& folder, const deck::Deck& deck);

}  // namespace atrapos
