#pragma once

#include "atrapos/fem/ShellGeometry.hpp"
#include "deck/Deck.hpp"

namespace atrapos {

/// Directors of all shells of a deck's mesh; empty where it has none. Blocks without a section have their
/// thickness in their attributes. Throws deck::DeckError for shells that cannot be.
fem::ShellGeometry shellsOf(const deck::Deck& deck, const fem::Mesh& mesh);

/// Throws deck::DeckError for what a deck may say and no run can do: shells (with all that acts on them),
/// pressures that follow.
void refuseUnsupported(const deck::Deck& deck, const fem::Mesh& mesh);

}  // namespace atrapos
