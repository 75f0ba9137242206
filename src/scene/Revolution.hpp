#pragma once

#include <optional>
#include <vector>

#include "atrapos/fem/DofMap.hpp"
#include "atrapos/fem/Mesh.hpp"

namespace atrapos {

/// The axis of coordinates, 0 to 2, around which a mesh in space is turned, node by node through the same
/// angles, and moves alike all around within 1 % of its largest displacement, which is the mesh's error; u:
/// [dof]. Empty: none.
std::optional<int> axisOfRevolution(const fem::Mesh& mesh, const fem::DofMap& dofs,
                                    const std::vector<double>& u);

}  // namespace atrapos
