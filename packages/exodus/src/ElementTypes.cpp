#include "ElementTypes.hpp"

#include <algorithm>
#include <cctype>

namespace atrapos::exodus {

std::optional<fem::Topology> topologyOf(const std::string& elementType, int nodesPerElement) {
  using fem::Topology;
  std::string type = elementType;
  std::transform(type.begin(), type.end(), type.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
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
  }
  return std::nullopt;
}

const char* acceptedElementTypes() {
  return "HEX with 8, 20 or 27 nodes, TET with 4 or 10, WEDGE or PENTA with 6 or 15";
}

int numSides(fem::Topology topology) {
  using fem::Topology;
  switch (topology) {
    case Topology::Hex8:
    case Topology::Hex20:
    case Topology::Hex27:
      return 6;
    case Topology::Wedge6:
    case Topology::Wedge15:
      return 5;
    case Topology::Tet4:
    case Topology::Tet10:
      return 4;
  }
  return 0;
}

}  // namespace atrapos::exodus
