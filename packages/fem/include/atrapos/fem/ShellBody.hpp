#pragma once

#include <vector>

#include "atrapos/fem/Mesh.hpp"
#include "atrapos/fem/ShellGeometry.hpp"

namespace atrapos::fem {

/// The bodies of shells as a mesh of solids, for pictures and for comparison with solids: SHELL3 becomes
/// WEDGE6, SHELL4 HEX8, SHELL6 WEDGE15, SHELL8 HEX20 and SHELL9 HEX27, each with exactly the shape X = R +
/// zeta D of the shell. Blocks, sets and ids are those of the mesh, and so are its nodes, which stand on the
/// middle surface; the sides of sets become those of the solids. Elements of different thickness at a common
/// director have its mean thickness there.
struct ShellBody {
  Mesh mesh;
  int numMeshNodes = 0;  ///< of the shells; then come bottom and top of each director

  /// Displacements of the body's nodes, [3 node + component], from those of the shells' nodes and directors:
  /// v on the middle surface, v -+ w at bottom and top.
  std::vector<double> displacements(const ShellGeometry& shells, const std::vector<double>& u) const;

  /// Nodal forces on the body with the same work as those on v and w: f_v on the middle surface, -+ f_w/2 at
  /// bottom and top.
  std::vector<double> forces(const ShellGeometry& shells, const std::vector<double>& f) const;
};

/// Throws std::invalid_argument where the geometry is not that of the mesh.
ShellBody shellBody(const Mesh& mesh, const ShellGeometry& shells);

}  // namespace atrapos::fem
