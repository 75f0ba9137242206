#pragma once

#include <array>
#include <vector>

#include "atrapos/fem/Mesh.hpp"
#include "atrapos/fem/ShellThickness.hpp"

/// From a mesh of shell surfaces to bodies with a thickness,
///     X(xi, eta, zeta) = R(xi, eta) + zeta D(xi, eta),   zeta in [-1, 1],   D = (t/2) N
/// (Lejeune et al. 2013, section 3.2), and the numbering of their unknowns: v at the mesh's nodes and w at
/// the director nodes, x = X + v + zeta w. Derivations: docs/theory/shell_geometry.md.
namespace atrapos::fem {

/// The direction of the director at a node, in place of the averaged normal of the faces there.
struct PrescribedDirector {
  int node = 0;                              ///< of the mesh
  std::array<double, 3> direction{0, 0, 1};  ///< towards the top face; not zero, any length
};

struct ShellGeometryOptions {
  /// Degrees, in (0, 180). Faces at a node whose normals differ by at most this angle, directly or by way of
  /// others there, share one director: the mean of their unit normals (where triangles are by the angles of
  /// their corners), as long as the mitre of the fold asks.
  /// Where more than two elements meet at an edge the angle is 45 degrees at most.
  /// Other faces have directors of their own and share the displacement of the node only: a hinge, until
  /// joinShells makes it a rigid joint (ShellJoints.hpp).
  double foldAngle = 20;
  std::vector<PrescribedDirector> directors;
};

/// The shells of one block, as entities for an element loop. N: nodes of the surface cell.
struct ShellBlock {
  int block = 0;            ///< position in Mesh::blocks
  int nodesPerElement = 0;  ///< N
  std::vector<int> nodes;   ///< [element][2 N]: N nodes of the mesh (v), then their N director nodes (w)
  std::vector<double> midsurface;  ///< [element][N][3] R
  std::vector<double> directors;   ///< [element][N][3] the element's own D
  /// [element][N] the element's own D and w over those of the director node: 1, except where elements of
  /// different thickness share a director; the shape function of w is zeta times scale times N_a.
  std::vector<double> directorScale;

  int numElements() const { return static_cast<int>(nodes.size()) / (2 * nodesPerElement); }
};

/// The middle of an edge that a shell without middle nodes shares: what is there follows the ends
/// (SharedEdges.hpp). The element's director is halfway between those at the ends, and so is its change:
/// w = (s_a w_a + s_b w_b)/2.
struct EdgeFollower {
  int node = 0, director = 0;  ///< of the middle, its director this element's own
  std::array<int, 2> ends{}, endDirectors{};
  std::array<double, 2> endScales{1, 1};  ///< s: ShellBlock::directorScale of the element at the ends
};

struct ShellGeometry {
  int numMeshNodes = 0;
  std::vector<ShellBlock> blocks;
  std::vector<EdgeFollower> followers;  ///< until coupleSharedEdges they are free
  std::vector<int> firstDirector;       ///< [mesh node], one more at the end; none where no shell is
  std::vector<int> meshNode;            ///< [director] where it stands; ascending
  std::vector<double> directors;        ///< [director][3] D

  int numDirectors() const { return static_cast<int>(meshNode.size()); }
  /// Nodes of 3 dofs each, for FeModel::numNodes: those of the mesh, then the director nodes.
  int numNodes() const { return numMeshNodes + numDirectors(); }
  /// The director nodes that stand at a node of the mesh; empty where no shell is.
  std::vector<int> directorNodes(int meshNode) const;
  /// The shells of a block of the mesh; null where there are none.
  const ShellBlock* find(int block) const;
};

/// Directors and numbering of all shells of a mesh. Every block of shells needs exactly one section.
///
/// Throws std::invalid_argument, in one line, that names
/// - the block without section or thickness, or a section's block that holds no shells or has two sections;
/// - the element whose middle surface or body has a zero Jacobian or one of varying sign; a body has it where
///   the thickness exceeds twice the radius of curvature;
/// - two elements with a common edge that have opposite normals (orientShells mends them where it can);
/// - the node whose faces have no common director, or whose prescribed one points to a face's bottom.
ShellGeometry shellGeometry(const Mesh& mesh, const std::vector<ShellSection>& sections,
                            const ShellGeometryOptions& options = {});

}  // namespace atrapos::fem
