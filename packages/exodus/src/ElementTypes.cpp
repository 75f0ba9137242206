#include "ElementTypes.hpp"

#include <algorithm>
#include <cctype>

namespace atrapos::exodus {

namespace {

std::string upperCase(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

}  // namespace

std::optional<fem::Topology> topologyOf(const std::string& elementType, int nodesPerElement, int dimensions) {
  using fem::Topology;
  const std::string type = upperCase(elementType);
  const auto begins = [&](const char* prefix) { return type.rfind(prefix, 0) == 0; };
  if (begins("HEX")) {
    if (nodesPerElement == 8) return Topology::Hex8;
    if (nodesPerElement == 20) return Topology::Hex20;
    if (nodesPerElement == 27) return Topology::Hex27;
  } else if (begins("TET")) {
    if (nodesPerElement == 4) return Topology::Tet4;
    if (nodesPerElement == 10) return Topology::Tet10;
  } else if (begins("WEDGE") || begins("PENTA")) {
    if (nodesPerElement == 6) return Topology::Wedge6;
    if (nodesPerElement == 15) return Topology::Wedge15;
  } else if (dimensions == 2 && begins("QUAD")) {
    if (nodesPerElement == 4) return Topology::Quad4;
    if (nodesPerElement == 8) return Topology::Quad8;
    if (nodesPerElement == 9) return Topology::Quad9;
  } else if (dimensions == 2 && begins("TRI")) {
    if (nodesPerElement == 3) return Topology::Tri3;
    if (nodesPerElement == 6) return Topology::Tri6;
  } else if (dimensions == 3 && (begins("BAR") || begins("TRUSS"))) {
    if (nodesPerElement == 2) return Topology::Bar2;
    if (nodesPerElement == 3) return Topology::Bar3;
  } else if (dimensions == 3 && (nodesPerElement == 3 || nodesPerElement == 6) &&
             (begins("TRI") || begins("SHELL"))) {
    return nodesPerElement == 3 ? Topology::Shell3 : Topology::Shell6;
  } else if (dimensions == 3 && (begins("SHELL") || begins("QUAD"))) {
    if (nodesPerElement == 4) return Topology::Shell4;
    if (nodesPerElement == 8) return Topology::Shell8;
    if (nodesPerElement == 9) return Topology::Shell9;
  }
  return std::nullopt;
}

const char* elementType(fem::Topology topology) {
  if (topology == fem::Topology::Shell3) return "TRISHELL3";
  return topology == fem::Topology::Shell6 ? "TRISHELL6" : fem::topologyName(topology);
}

bool isLower(const std::string& elementType) {
  const std::string type = upperCase(elementType);
  for (const char* prefix :
       {"BAR", "BEAM", "TRUSS", "EDGE", "LINE", "SPHERE", "CIRCLE", "POINT", "NODE", "VERTEX"})
    if (type.rfind(prefix, 0) == 0) return true;
  return false;
}

int firstSide(const std::string& elementType, int dimensions) {
  return dimensions == 3 && upperCase(elementType).rfind("QUAD", 0) == 0 ? 2 : 0;
}

const char* acceptedElementTypes(int dimensions) {
  if (dimensions == 2) return "QUAD with 4, 8 or 9 nodes, TRI with 3 or 6";
  return "HEX with 8, 20 or 27 nodes, TET with 4 or 10, WEDGE or PENTA with 6 or 15, SHELL or QUAD "
         "with 4, 8 or 9, TRISHELL, TRI or SHELL with 3 or 6, BAR or TRUSS with 2 or 3";
}

int numSides(fem::Topology topology) {
  using fem::Topology;
  switch (topology) {
    case Topology::Hex8:
    case Topology::Hex20:
    case Topology::Hex27:
    case Topology::Shell4:
    case Topology::Shell8:
    case Topology::Shell9:
      return 6;
    case Topology::Wedge6:
    case Topology::Wedge15:
    case Topology::Shell3:
    case Topology::Shell6:
      return 5;
    case Topology::Tet4:
    case Topology::Tet10:
    case Topology::Quad4:
    case Topology::Quad8:
    case Topology::Quad9:
      return 4;
    case Topology::Tri3:
    case Topology::Tri6:
      return 3;
    case Topology::Bar2:
    case Topology::Bar3:
      return 0;
  }
  return 0;
}

}  // namespace atrapos::exodus
