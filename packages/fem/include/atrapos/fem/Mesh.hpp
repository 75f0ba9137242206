#pragma once

#include <string>
#include <vector>

namespace atrapos::fem {

/// Cell shapes with their node count; node and side order are those of Exodus II (= Shards).
///
/// Shells are quadrilaterals and triangles in space, given by their middle surface. Their sides are: 1 the
/// top face, whose outward normal is that of the node order (counter-clockwise seen from the tip of the
/// normal); 2 the bottom face; 3 to 6 (3 to 5) the edges from corner 1 to 2, 2 to 3, 3 to 4, 4 to 1 (3 to 1).
///
/// Plane cells (quadrilaterals and triangles) are the cross-sections of plane bodies, in the plane of x and
/// y; their sides are their edges, counter-clockwise.
///
/// Bars are lines in space, without sides.
enum class Topology {
  Hex8,
  Hex20,
  Hex27,
  Tet4,
  Tet10,
  Wedge6,
  Wedge15,
  Shell3,
  Shell4,
  Shell6,
  Shell8,
  Shell9,
  Quad4,
  Quad8,
  Quad9,
  Tri3,
  Tri6,
  Bar2,
  Bar3
};

/// Whether a cell is a surface in space that stands for a body with a thickness.
bool isShell(Topology topology);

/// Whether a cell is a line in space that stands for a body with a cross-section.
bool isBar(Topology topology);

/// Whether a cell is the cross-section of a plane body.
bool isPlane(Topology topology);

/// Whether a cell is the body itself, in space.
bool isSolid(Topology topology);

/// Cells of one topology.
struct Block {
  std::string name;
  long long id = 0;
  Topology topology = Topology::Hex8;
  std::vector<int> nodes;  ///< [element][node], 0-based, Exodus node order
  std::vector<std::string> attributeNames;
  std::vector<double> attributes;  ///< [element][attribute]
  /// Of surfaces in space that do not bend: their nodes have displacements alone, and no directors.
  bool membrane = false;
};

/// Whether the cells of a block are shells, which bend.
bool isShell(const Block& block);

struct NodeSet {
  std::string name;
  long long id = 0;
  std::vector<int> nodes;  ///< 0-based
  /// Exodus' distribution factors, [position in nodes]; empty: none.
  std::vector<double> factors{};
};

/// One face of one cell.
struct Side {
  int element = 0;  ///< 0-based, counted over all blocks in the mesh's order
  int side = 0;     ///< 0-based, Exodus side order
};

struct SideSet {
  std::string name;
  long long id = 0;
  std::vector<Side> sides;
};

/// A mesh in memory, in space, or with plane cells alone and z = 0. Lengths are in the user's unit.
struct Mesh {
  std::string title;
  std::vector<double> coordinates;  ///< [node][x y z]
  std::vector<Block> blocks;
  std::vector<NodeSet> nodeSets;
  std::vector<SideSet> sideSets;
  std::vector<long long> nodeIds;     ///< the file's own numbers; empty = 1, 2, ...
  std::vector<long long> elementIds;  ///< over all blocks; empty = 1, 2, ...

  int numNodes() const { return static_cast<int>(coordinates.size() / 3); }
  /// 3; 2 where all cells are plane ones.
  int dimension = 3;

  int numElements() const;

  /// What the file calls a node or an element, for messages; also of one that is not there.
  long long nodeNumber(int node) const { return number(nodeIds, node); }
  long long elementNumber(int element) const { return number(elementIds, element); }

 private:
  static long long number(const std::vector<long long>& ids, int i) {
    return i >= 0 && static_cast<std::size_t>(i) < ids.size() ? ids[static_cast<std::size_t>(i)] : i + 1LL;
  }
};

/// Corners of a shell: 3 or 4.
int shellCorners(Topology topology);

/// Number of nodes of a cell.
int nodesPerElement(Topology topology);

/// The name of a cell type, Exodus' but for SHELL3 and SHELL6 (TRISHELL3, TRISHELL6): SHELL3, HEX8, HEX20,
/// HEX27, TET4, TET10, WEDGE6, WEDGE15, SHELL4, SHELL6, SHELL8, SHELL9, QUAD4, QUAD8, QUAD9, TRI3, TRI6,
/// BAR2, BAR3.
const char* topologyName(Topology topology);

/// Position of the block, node set or side set with this name or (decimal) id; -1 where there is none.
int findBlock(const Mesh& mesh, const std::string& nameOrId);
int findNodeSet(const Mesh& mesh, const std::string& nameOrId);
int findSideSet(const Mesh& mesh, const std::string& nameOrId);

}  // namespace atrapos::fem
