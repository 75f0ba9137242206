#pragma once

#include <memory>
#include <vector>

#include "atrapos/fem/Term.hpp"
#include "scene/Shells.hpp"

/// Loads of the deck whose nodal forces depend on the displacements: terms of the problem. Those are
/// pressures that follow, forces that follow an edge, and moments on edges, also dead ones.
namespace atrapos::followers {

bool isFollower(const deck::Load& load);

/// The terms of such a load, for each block of shells, and each shape of face of solids, that it
/// acts on. Throws std::invalid_argument, one line, for moments about the director.
std::vector<std::unique_ptr<fem::Term>> terms(const deck::Load& load, const fem::Mesh& mesh,
                                              const SceneShells& shells);

}  // namespace atrapos::followers
