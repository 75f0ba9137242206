#pragma once

#include <vector>

#include "atrapos/fem/FeModel.hpp"
#include "atrapos/fem/Mesh.hpp"
#include "atrapos/fem/ShellGeometry.hpp"

namespace atrapos::fem {

/// Nodes of a mesh where shells with directors of their own meet: folds and branches.
struct ShellJoints {
  std::vector<int> rigid;   ///< the directors turn together; ascending
  std::vector<int> hinged;  ///< they share the displacement alone; ascending
};

/// Makes the nodes with several directors rigid joints (docs/theory/shell_joints.md), those in `hinges`
/// excepted: directions keep their angles to each other at any rotation, so that moments pass, and every
/// director's length stays free. m directors get 2 m - 3 multipliers (Role::multiplier), without those of
/// conditions that the model's supports and couplings fulfil already: call it after them. Where a director
/// follows nodes elsewhere (a rigid body, the side of a solid) these make the joint.
///
/// youngsModulus > 0 only scales the multipliers. Throws std::invalid_argument where all directors of a node
/// are parallel: a shell that is folded onto itself, whose joint would be none.
ShellJoints joinShells(FeModel& model, const Mesh& mesh, const ShellGeometry& shells, double youngsModulus,
                       const std::vector<int>& hinges = {});

}  // namespace atrapos::fem
