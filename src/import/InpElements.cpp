#include "import/InpElements.hpp"

#include <algorithm>
#include <numeric>

namespace atrapos::importer {
namespace {

using fem::Topology;

constexpr const char* kLocks = "HEX8 has 2 x 2 x 2 points and no incompatible modes: it locks in bending";
constexpr const char* kHourglass = "HEX8 has 2 x 2 x 2 points, not one: it locks in bending";
constexpr const char* kBoxPoints = "HEX20 has 2 x 2 x 2 points of integration, as C3D20R";
constexpr const char* kQuadPoints = "QUAD8 has 2 x 2 points of integration";
constexpr const char* kOnePoint = "QUAD4 has 2 x 2 points of integration, not one";
constexpr const char* kIncompatible = "QUAD4 has no incompatible modes: it locks in bending";
constexpr const char* kSurfacePoints = "SHELL8 has 2 x 2 points of integration";
constexpr const char* kOnePointOfSurface = "SHELL4 has 2 x 2 points of integration, not one";
constexpr const char* kShell3 = "SHELL3 has assumed strains of its own (MITC3+)";
constexpr const char* kShell4 = "SHELL4 has assumed strains of its own (MITC4)";
constexpr const char* kShell4R = "SHELL4 has 2 x 2 points and assumed strains (MITC4), not one point";
constexpr const char* kShell6 = "SHELL6 has assumed strains of its own (MITC6)";
constexpr const char* kShell8 = "SHELL8 has 2 x 2 points of integration, as S8R";

const std::vector<InpElementType>& types() {
  static const std::vector<InpElementType> all{
      {"C3D4", 4, Family::solid, Topology::Tet4, ""},
      {"C3D6", 6, Family::solid, Topology::Wedge6, "WEDGE6 has 3 x 2 points of integration, not two"},
      {"C3D8", 8, Family::solid, Topology::Hex8,
       "HEX8 has 2 x 2 x 2 points for all strains; Abaqus' C3D8 treats that of the volume apart"},
      {"C3D8R", 8, Family::solid, Topology::Hex8, kHourglass},
      {"C3D8I", 8, Family::solid, Topology::Hex8, kLocks},
      {"C3D10", 10, Family::solid, Topology::Tet10, ""},
      {"C3D10M", 10, Family::solid, Topology::Tet10, "TET10 is no modified tetrahedron"},
      {"C3D10T", 10, Family::solid, Topology::Tet10, "TET10 has one strain of the volume for each point"},
      {"C3D15", 15, Family::solid, Topology::Wedge15, ""},
      {"C3D20", 20, Family::solid, Topology::Hex20, kBoxPoints},
      {"C3D20R", 20, Family::solid, Topology::Hex20, ""},
      {"S3", 3, Family::shell, Topology::Shell3, kShell3},
      {"S3R", 3, Family::shell, Topology::Shell3, kShell3},
      {"S4", 4, Family::shell, Topology::Shell4, kShell4},
      {"S4R", 4, Family::shell, Topology::Shell4, kShell4R},
      {"S6", 6, Family::shell, Topology::Shell6, kShell6},
      {"STRI65", 6, Family::shell, Topology::Shell6, kShell6},
      {"S8", 8, Family::shell, Topology::Shell8, kShell8},
      {"S8R", 8, Family::shell, Topology::Shell8, ""},
      {"M3D3", 3, Family::membrane, Topology::Shell3, ""},
      {"M3D4", 4, Family::membrane, Topology::Shell4, ""},
      {"M3D4R", 4, Family::membrane, Topology::Shell4, kOnePointOfSurface},
      {"M3D6", 6, Family::membrane, Topology::Shell6, ""},
      {"M3D8", 8, Family::membrane, Topology::Shell8, kSurfacePoints},
      {"M3D8R", 8, Family::membrane, Topology::Shell8, ""},
      {"T3D2", 2, Family::bar, Topology::Bar2, ""},
      {"CPS3", 3, Family::planeStress, Topology::Tri3, ""},
      {"CPS4", 4, Family::planeStress, Topology::Quad4, ""},
      {"CPS4I", 4, Family::planeStress, Topology::Quad4, kIncompatible},
      {"CPS4R", 4, Family::planeStress, Topology::Quad4, kOnePoint},
      {"CPS6", 6, Family::planeStress, Topology::Tri6, ""},
      {"CPS8", 8, Family::planeStress, Topology::Quad8, kQuadPoints},
      {"CPS8R", 8, Family::planeStress, Topology::Quad8, ""},
      {"CPE3", 3, Family::planeStrain, Topology::Tri3, ""},
      {"CPE4", 4, Family::planeStrain, Topology::Quad4,
       "QUAD4 has 2 x 2 points for all strains; Abaqus' CPE4 treats that of the volume apart"},
      {"CPE4I", 4, Family::planeStrain, Topology::Quad4, kIncompatible},
      {"CPE4R", 4, Family::planeStrain, Topology::Quad4, kOnePoint},
      {"CPE6", 6, Family::planeStrain, Topology::Tri6, ""},
      {"CPE8", 8, Family::planeStrain, Topology::Quad8, kQuadPoints},
      {"CPE8R", 8, Family::planeStrain, Topology::Quad8, ""},
      {"CAX3", 3, Family::axisymmetric, Topology::Tri3, ""},
      {"CAX4", 4, Family::axisymmetric, Topology::Quad4,
       "QUAD4 has 2 x 2 points for all strains; Abaqus' CAX4 treats that of the volume apart"},
      {"CAX4I", 4, Family::axisymmetric, Topology::Quad4, kIncompatible},
      {"CAX4R", 4, Family::axisymmetric, Topology::Quad4, kOnePoint},
      {"CAX6", 6, Family::axisymmetric, Topology::Tri6, ""},
      {"CAX8", 8, Family::axisymmetric, Topology::Quad8, kQuadPoints},
      {"CAX8R", 8, Family::axisymmetric, Topology::Quad8, ""}};
  return all;
}

std::vector<int> inOrder(int count) {
  std::vector<int> order(static_cast<std::size_t>(count));
  std::iota(order.begin(), order.end(), 0);
  return order;
}

/// Where the edges between the two faces come last in the input file, Exodus has those of the top last.
std::vector<int> topLast(int corners) {
  const int edges = corners / 2;
  std::vector<int> order = inOrder(corners + 3 * edges);
  std::rotate(order.begin() + corners + edges, order.begin() + corners + edges + edges, order.end());
  return order;
}

}  // namespace

const InpElementType* findInpElement(const std::string& type) {
  for (const InpElementType& known : types())
    if (known.name == type) return &known;
  // Elements for nearly incompressible bodies have pressures of their own beside the same displacements.
  if (type.size() > 3 && type.find('H') == type.size() - 1)
    return findInpElement(type.substr(0, type.size() - 1));
  return nullptr;
}

std::string inpElementNames() {
  std::string names;
  for (const InpElementType& type : types()) names += (names.empty() ? "" : ", ") + type.name;
  return names;
}

const std::vector<int>& inpNodeOrder(fem::Topology topology) {
  static const std::vector<int> hex = topLast(8), wedge = topLast(6), others = inOrder(10);
  if (topology == Topology::Hex20) return hex;
  if (topology == Topology::Wedge15) return wedge;
  return others;
}

int inpSide(fem::Topology topology, int face) {
  static const std::vector<int> hex{4, 5, 0, 1, 2, 3}, tet{3, 0, 1, 2}, wedge{3, 4, 0, 1, 2},
      quad{0, 1, 2, 3}, tri{0, 1, 2}, none{}, shell{1, 0, 2, 3, 4, 5}, triShell{1, 0, 2, 3, 4};
  const auto of = [&]() -> const std::vector<int>& {
    switch (topology) {
      case Topology::Hex8:
      case Topology::Hex20:
      case Topology::Hex27:
        return hex;
      case Topology::Tet4:
      case Topology::Tet10:
        return tet;
      case Topology::Wedge6:
      case Topology::Wedge15:
        return wedge;
      case Topology::Shell3:
      case Topology::Shell6:
        return triShell;
      case Topology::Shell4:
      case Topology::Shell8:
      case Topology::Shell9:
        return shell;
      case Topology::Quad4:
      case Topology::Quad8:
      case Topology::Quad9:
        return quad;
      case Topology::Bar2:
      case Topology::Bar3:
        return none;
      case Topology::Tri3:
      case Topology::Tri6:
        break;
    }
    return tri;
  };
  const std::vector<int>& sides = of();
  return face >= 0 && face < static_cast<int>(sides.size()) ? sides[static_cast<std::size_t>(face)] : -1;
}

}  // namespace atrapos::importer
