#pragma once

#include <string>

#include "atrapos/fem/Mesh.hpp"
#include "deck/Deck.hpp"
#include "scene/SceneModel.hpp"

namespace atrapos {

/// A line on a contact of sides of which half or more have the body between them and the tool where it stands
/// at the start: their points can hardly come to it and cost as much as the others. Empty where fewer have,
/// of nodes, and of shells, whose other face is as near.
std::string sidesAway(const ContactPoints& contact, const deck::Deck& deck, const fem::Mesh& mesh);

}  // namespace atrapos
