#include "atrapos/fem/StructuredPlane.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "atrapos/fem/StructuredShell.hpp"

namespace atrapos::fem {
namespace {

/// The shell whose nodes are those that the plane cells have.
Topology shellOf(Topology plane) {
  switch (plane) {
    case Topology::Quad4:
    case Topology::Tri3:
      return Topology::Shell4;
    case Topology::Quad8:
      return Topology::Shell8;
    case Topology::Quad9:
    case Topology::Tri6:
      return Topology::Shell9;
    default:
      throw std::invalid_argument(std::string("plane mesh: ") + topologyName(plane) + " is no plane cell");
  }
}

bool isTriangle(Topology topology) { return topology == Topology::Tri3 || topology == Topology::Tri6; }

/// Nodes of the two triangles of a quadrilateral, of SHELL9 the centre on the diagonal.
constexpr int kTriangles[2][6] = {{0, 1, 2, 4, 5, 8}, {0, 2, 3, 8, 6, 7}};
/// Where its edges are: triangle, and its side.
constexpr int kEdges[4][2] = {{0, 0}, {0, 1}, {1, 1}, {1, 2}};

/// A shell's mesh in the plane z = 0 as one of plane cells.
Mesh planeMesh(Mesh mesh, Topology topology, const std::string& title) {
  mesh.title = title;
  mesh.dimension = 2;
  Block& block = mesh.blocks.front();
  const bool split = isTriangle(topology);
  const int N = nodesPerElement(block.topology), own = nodesPerElement(topology);
  block.topology = topology;
  if (split) {
    std::vector<int> nodes;
    for (std::size_t e = 0; e < block.nodes.size(); e += N)
      for (const auto& triangle : kTriangles)
        for (int n = 0; n < own; ++n) nodes.push_back(block.nodes[e + triangle[n]]);
    block.nodes = std::move(nodes);
  }
  // The faces of shells go, and the sides begin with the edges.
  auto& sets = mesh.sideSets;
  sets.erase(std::remove_if(sets.begin(), sets.end(),
                            [](const SideSet& s) { return !s.sides.empty() && s.sides.front().side < 2; }),
             sets.end());
  for (SideSet& set : sets)
    for (Side& side : set.sides) {
      side.side -= 2;
      if (split) side = {2 * side.element + kEdges[side.side][0], kEdges[side.side][1]};
    }
  return mesh;
}

}  // namespace

Mesh rectangleMesh(const RectangleOptions& o) {
  ShellPlateOptions plate;
  plate.length = o.lengths[0];
  plate.width = o.lengths[1];
  plate.origin = {o.origin[0], o.origin[1], 0};
  plate.grading = o.grading;
  plate.fine = o.fine;
  plate.divisions = o.divisions;
  plate.topology = shellOf(o.topology);
  plate.blockName = o.blockName;
  return planeMesh(shellPlateMesh(plate), o.topology, "rectangle");
}

Mesh quadrilateralMesh(const QuadrilateralOptions& o) {
  const auto& c = o.corners;
  for (int k = 0; k < 4; ++k) {
    const double *a = &c[2 * k], *b = &c[2 * ((k + 1) % 4)], *d = &c[2 * ((k + 3) % 4)];
    if (!((b[0] - a[0]) * (d[1] - a[1]) > (b[1] - a[1]) * (d[0] - a[0])))
      throw std::invalid_argument(
          "quadrilateral: corners must be those of a convex one, counter-clockwise; it is not at corner " +
          std::to_string(k + 1));
  }
  RectangleOptions unit;
  unit.divisions = o.divisions;
  unit.topology = o.topology;
  unit.blockName = o.blockName;
  Mesh mesh = rectangleMesh(unit);
  mesh.title = "quadrilateral";
  for (int n = 0; n < mesh.numNodes(); ++n) {
    double* x = &mesh.coordinates[3 * static_cast<std::size_t>(n)];
    const double s = x[0], t = x[1], weights[4] = {(1 - s) * (1 - t), s * (1 - t), s * t, (1 - s) * t};
    for (int i = 0; i < 2; ++i) {
      x[i] = 0;
      for (int k = 0; k < 4; ++k) x[i] += weights[k] * c[2 * k + i];
    }
  }
  return mesh;
}

Mesh annulusMesh(const AnnulusOptions& o) {
  ShellAnnulusOptions annulus;
  annulus.innerRadius = o.innerRadius;
  annulus.outerRadius = o.outerRadius;
  annulus.angleMin = o.angleMin;
  annulus.angleMax = o.angleMax;
  annulus.slit = false;
  annulus.divisions = o.divisions;
  annulus.topology = shellOf(o.topology);
  annulus.blockName = o.blockName;
  return planeMesh(shellAnnulusMesh(annulus), o.topology, "annulus");
}

}  // namespace atrapos::fem
