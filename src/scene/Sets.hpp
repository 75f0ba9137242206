#pragma once

#include <string>
#include <vector>

#include "atrapos/fem/Mesh.hpp"

namespace atrapos {

/// The nodes that a deck's `set` means: those of the node set with this name or id, else of the side set.
/// The mesh has one of them (deck::checkAgainstMesh).
std::vector<int> nodesOf(const fem::Mesh& mesh, const std::string& set);

/// The side set with this name or id; the mesh has it.
const fem::SideSet& sidesOf(const fem::Mesh& mesh, const std::string& set);

}  // namespace atrapos
