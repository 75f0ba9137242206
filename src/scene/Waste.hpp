#pragma once

#include <string>
#include <vector>

#include "atrapos/fem/Mesh.hpp"
#include "deck/Deck.hpp"

namespace atrapos {

/// Where a scene models more than it needs, a line each; empty: nowhere. Bodies of solids so thin that shells
/// would do, along x, y or z; solids in which nothing moves along one of these, so that a plane body would
/// do; orders that charts (docs/chart.md) show to cost more than they bring.
std::vector<std::string> waste(const deck::Deck& deck, const fem::Mesh& mesh);

}  // namespace atrapos
