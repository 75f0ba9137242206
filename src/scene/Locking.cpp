#include "scene/Locking.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "scene/Extents.hpp"

namespace atrapos {
namespace {

constexpr double kSlender = 5;       // thicker bodies shear more than they bend
constexpr double kTolerated = 0.05;  // of the stiffness in bending; finer meshes are the user's choice

/// Bent by the curvature k, cells whose edges stay straight shear by k x, x the distance from their middle:
/// the energy G k^2 l^2/12 a volume, beside E k^2 t^2/12 of bending, however many cells there are through the
/// thickness t. G/E is a half without Poisson's ratio, which the line need not know better.
double tooStiff(double length, double thickness) { return 0.5 * length * length / (thickness * thickness); }

/// Whether cells stand in rows of their own, one cell wide and thick: no corner belongs to more than two.
bool standsInRows(const fem::Mesh& mesh, const fem::Block& block) {
  constexpr int corners = 8;
  const std::size_t nodes = fem::nodesPerElement(block.topology);
  std::vector<unsigned char> cells(mesh.numNodes(), 0);
  for (std::size_t first = 0; first < block.nodes.size(); first += nodes)
    for (int corner = 0; corner < corners; ++corner)
      if (++cells[block.nodes[first + corner]] > 2) return false;
  return true;
}

}  // namespace

std::vector<std::string> lockingCells(const deck::Deck& deck, const fem::Mesh& mesh) {
  std::vector<std::string> lines;
  for (const deck::Material& material : deck.materials)
    for (const std::string& name : material.blocks) {
      const fem::Block& block = mesh.blocks[fem::findBlock(mesh, name)];
      const bool reduced = material.formulation != deck::Material::Formulation::Mixed;
      if (block.topology == fem::Topology::Hex20 && reduced && standsInRows(mesh, block))
        lines.push_back(fmt::format(
            "block '{}': a row of HEX20, one cell wide and thick, twists its section without energy "
            "and its tangent is singular; two cells across do not, nor does HEX27",
            block.name));
      const bool solid = block.topology == fem::Topology::Hex8;
      if (!solid && block.topology != fem::Topology::Quad4) continue;
      const Extents extents = extentsOf(mesh, block);
      const auto end = extents.body.begin() + mesh.dimension;
      const double thickness = *std::min_element(extents.body.begin(), end);
      double length = 0;
      for (int axis = 0; axis < mesh.dimension; ++axis)
        if (extents.body[axis] >= kSlender * thickness) length = std::max(length, extents.cell[axis]);
      const double excess = tooStiff(length, thickness);
      if (!(excess > kTolerated)) continue;
      lines.push_back(
          fmt::format("block '{}': {} locks in bending: cells {:.3g} long in a body {:.3g} thick make it "
                      "some {:.0f} % too stiff; {} does not",
                      block.name, fem::topologyName(block.topology), length, thickness, 100 * excess,
                      solid ? "HEX27" : "QUAD8"));
    }
  return lines;
}

}  // namespace atrapos
