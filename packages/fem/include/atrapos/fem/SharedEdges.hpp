#pragma once

#include <vector>

#include "atrapos/fem/FeModel.hpp"
#include "atrapos/fem/Mesh.hpp"
#include "atrapos/fem/ShellGeometry.hpp"

/// Edges where shells with middle nodes (SHELL8, SHELL6, SHELL9) meet shells without (SHELL4, SHELL3): what
/// is at the middle node follows the ends (docs/theory/shell_geometry.md, Shared edges).
namespace atrapos::fem {

/// Whether a shell's edges have nodes in the middle.
bool hasMiddles(Topology topology);

/// An edge of a shell with middle nodes that a shell without has too.
struct SharedEdge {
  int block = 0;    ///< position in Mesh::blocks
  int element = 0;  ///< in the block
  int edge = 0;     ///< from corner `edge` to the next
};

/// In the order of blocks, elements and edges.
std::vector<SharedEdge> sharedEdges(const Mesh& mesh);

/// Nodes in the middle of a shell's edge that are a corner of another shell, ascending: both have the same
/// displacement there and not between the nodes, so that constant stress does not pass.
std::vector<int> middlesAtCorners(const Mesh& mesh);

/// Makes displacements and directors at the middles of shared edges (ShellGeometry::followers) follow those
/// at the ends: in the surface as along a straight edge; normal to it by as much as the directors turn, so
/// that both sides bend alike. An edge has three multipliers, less those of components that supports or
/// couplings hold at the middle node: these must hold the ends too, else throws std::invalid_argument naming
/// the node. Call it after supports and couplings, and before joinShells. youngsModulus > 0 only scales the
/// multipliers.
void coupleSharedEdges(FeModel& model, const Mesh& mesh, const ShellGeometry& shells, double youngsModulus);

}  // namespace atrapos::fem
