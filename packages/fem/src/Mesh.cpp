#include "atrapos/fem/Mesh.hpp"

#include <stdexcept>

namespace atrapos::fem {

namespace {

// A name wins over an id, so that a set named "3" can be reached even where another one has id 3.
template <class Named>
int findByNameOrId(const std::vector<Named>& items, const std::string& nameOrId) {
  if (nameOrId.empty()) return -1;
  for (std::size_t i = 0; i < items.size(); ++i)
    if (items[i].name == nameOrId) return static_cast<int>(i);
  for (std::size_t i = 0; i < items.size(); ++i)
    if (std::to_string(items[i].id) == nameOrId) return static_cast<int>(i);
  return -1;
}

}  // namespace

int Mesh::numElements() const {
  std::size_t count = 0;
  for (const Block& block : blocks) count += block.nodes.size() / nodesPerElement(block.topology);
  return static_cast<int>(count);
}

bool isShell(Topology topology) {
  return topology == Topology::Shell3 || topology == Topology::Shell4 || topology == Topology::Shell6 ||
         topology == Topology::Shell8 || topology == Topology::Shell9;
}

bool isShell(const Block& block) { return isShell(block.topology) && !block.membrane; }

bool isBar(Topology topology) { return topology == Topology::Bar2 || topology == Topology::Bar3; }

int shellCorners(Topology topology) {
  return topology == Topology::Shell3 || topology == Topology::Shell6 ? 3 : 4;
}

bool isPlane(Topology topology) {
  return topology == Topology::Quad4 || topology == Topology::Quad8 || topology == Topology::Quad9 ||
         topology == Topology::Tri3 || topology == Topology::Tri6;
}

bool isSolid(Topology topology) { return !isShell(topology) && !isPlane(topology) && !isBar(topology); }

int nodesPerElement(Topology topology) {
  switch (topology) {
    case Topology::Bar2:
      return 2;
    case Topology::Bar3:
    case Topology::Shell3:
    case Topology::Tri3:
      return 3;
    case Topology::Shell6:
    case Topology::Tri6:
      return 6;
    case Topology::Hex8:
      return 8;
    case Topology::Hex20:
      return 20;
    case Topology::Hex27:
      return 27;
    case Topology::Tet4:
    case Topology::Quad4:
      return 4;
    case Topology::Tet10:
      return 10;
    case Topology::Wedge6:
      return 6;
    case Topology::Wedge15:
      return 15;
    case Topology::Shell4:
      return 4;
    case Topology::Shell8:
    case Topology::Quad8:
      return 8;
    case Topology::Shell9:
    case Topology::Quad9:
      return 9;
  }
  throw std::invalid_argument("nodesPerElement: not a value of Topology");
}

const char* topologyName(Topology topology) {
  switch (topology) {
    case Topology::Bar2:
      return "BAR2";
    case Topology::Bar3:
      return "BAR3";
    case Topology::Hex8:
      return "HEX8";
    case Topology::Hex20:
      return "HEX20";
    case Topology::Hex27:
      return "HEX27";
    case Topology::Tet4:
      return "TET4";
    case Topology::Tet10:
      return "TET10";
    case Topology::Wedge6:
      return "WEDGE6";
    case Topology::Wedge15:
      return "WEDGE15";
    case Topology::Shell3:
      return "SHELL3";
    case Topology::Shell4:
      return "SHELL4";
    case Topology::Shell6:
      return "SHELL6";
    case Topology::Shell8:
      return "SHELL8";
    case Topology::Shell9:
      return "SHELL9";
    case Topology::Quad4:
      return "QUAD4";
    case Topology::Quad8:
      return "QUAD8";
    case Topology::Quad9:
      return "QUAD9";
    case Topology::Tri3:
      return "TRI3";
    case Topology::Tri6:
      return "TRI6";
  }
  throw std::invalid_argument("topologyName: not a value of Topology");
}

int findBlock(const Mesh& mesh, const std::string& nameOrId) { return findByNameOrId(mesh.blocks, nameOrId); }

int findNodeSet(const Mesh& mesh, const std::string& nameOrId) {
  return findByNameOrId(mesh.nodeSets, nameOrId);
}

int findSideSet(const Mesh& mesh, const std::string& nameOrId) {
  return findByNameOrId(mesh.sideSets, nameOrId);
}

}  // namespace atrapos::fem
