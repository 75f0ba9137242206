#pragma once

#include <memory>
#include <vector>

#include "atrapos/fem/Mesh.hpp"
#include "atrapos/fem/Term.hpp"
#include "atrapos/solid/ShellLoadLaws.hpp"

namespace atrapos::solid {

/// A pressure on the deformed faces of solids in a side set, -amount times the outward normal: a term for
/// each shape of face, with the cubature that integrates N_a x_xi x x_eta exactly on quadrilaterals of any
/// node count. The resultant over a closed surface vanishes in every state.
///
/// Throws std::invalid_argument naming the side set and element where a side is one of a shell.
std::vector<std::unique_ptr<fem::Term>> followerPressure(const fem::Mesh& mesh, const fem::SideSet& set,
                                                         LoadAmount pressure);

}  // namespace atrapos::solid
