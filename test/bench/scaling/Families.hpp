#pragma once

#include <string>
#include <vector>

namespace atrapos::bench {

/// Names of the families of decks: `shell`, a clamped square plate of SHELL8 under pressure above a plane;
/// `solid`, a block of HEX20, clamped on one side and pulled down at the other, above a cylinder.
const std::vector<std::string>& families();

/// The deck of a family with about so many unknowns, a few steps along its path. Meshes are made with
/// generateMesh. Throws std::invalid_argument on an unknown family or fewer than 1000 unknowns.
std::string familyDeck(const std::string& family, double unknowns, int steps);

}  // namespace atrapos::bench
