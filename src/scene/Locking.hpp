#pragma once

#include <string>
#include <vector>

#include "atrapos/fem/Mesh.hpp"
#include "deck/Deck.hpp"

namespace atrapos {

/// Blocks of HEX8 or QUAD4 that would bend too stiffly: a body at least five times as long as it is thick, of
/// cells so long that what these cells add in bending is more than a twentieth. A line for each, "block
/// 'body': ..."; empty: nothing. Thickness is the smallest extent along x, y, z: of bodies that are curved or
/// askew nothing is said. And blocks of HEX20 in a row, which the reduced cubature leaves deformations
/// without energy (docs/theory/elements.md).
std::vector<std::string> lockingCells(const deck::Deck& deck, const fem::Mesh& mesh);

}  // namespace atrapos
