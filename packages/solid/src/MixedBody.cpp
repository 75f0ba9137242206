#include "atrapos/solid/MixedBody.hpp"

#include <cmath>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>

namespace atrapos::solid {
namespace {

using fem::Topology;

/// The cell of degree 1 at the corners; none where there is no pair of spaces.
std::optional<Topology> cornerCell(Topology cell) {
  switch (cell) {
    case Topology::Quad8:
    case Topology::Quad9:
      return Topology::Quad4;
    case Topology::Tri6:
      return Topology::Tri3;
    case Topology::Hex20:
    case Topology::Hex27:
      return Topology::Hex8;
    case Topology::Tet10:
      return Topology::Tet4;
    case Topology::Wedge15:
      return Topology::Wedge6;
    default:
      return std::nullopt;
  }
}

Topology requiredCornerCell(const fem::Block& block) {
  if (const auto cell = cornerCell(block.topology)) return *cell;
  throw std::invalid_argument("block '" + block.name + "': " + fem::topologyName(block.topology) +
                              " has no pressures beside its displacements");
}

}  // namespace

bool hasPressures(Topology cell) { return cornerCell(cell).has_value(); }

fem::Field pressureField(const fem::Block& block) {
  return {"pressure of block " + std::to_string(block.id), {""}, fem::Role::multiplier};
}

std::vector<int> pressureNodes(const fem::Block& block) {
  const std::size_t corners = fem::nodesPerElement(requiredCornerCell(block)),
                    all = fem::nodesPerElement(block.topology);
  std::set<int> nodes;
  for (std::size_t i = 0; i < block.nodes.size(); ++i)
    if (i % all < corners) nodes.insert(block.nodes[i]);
  return {nodes.begin(), nodes.end()};
}

fem::Tabulation mixedTabulation(Topology cell) {
  // Reduced points would leave Quad8 and Hex20 their modes without energy, which surfaces under compression
  // find.
  const bool reduced = cell == Topology::Quad8 || cell == Topology::Hex20;
  return reduced ? fem::tabulate(cell, 5) : fem::tabulate(cell);
}

fem::Interpolation pressureValues(const fem::Field& field, const fem::PointSet& points,
                                  const fem::Block& block, const fem::Tabulation& cell) {
  return fem::valuesOf(field, points, fem::tabulateAt(requiredCornerCell(block), cell.points));
}

fem::PointSet withPressures(fem::PointSet points, const fem::Block& block, const fem::Tabulation& cell) {
  points.more.push_back(pressureValues(pressureField(block), points, block, cell));
  return points;
}

std::vector<double> pressuresAtNodes(const fem::Block& block, const std::function<double(int)>& atCorner) {
  const fem::Topology corners = requiredCornerCell(block);
  const int all = fem::nodesPerElement(block.topology), few = fem::nodesPerElement(corners);
  const fem::Tabulation t = fem::tabulateAt(corners, fem::referenceNodes(block.topology));
  std::vector<double> values(block.nodes.size(), 0.0);
  for (std::size_t e = 0; e < block.nodes.size() / all; ++e)
    for (int n = 0; n < all; ++n)
      for (int c = 0; c < few; ++c)
        values[e * all + n] += t.values[n * few + c] * atCorner(block.nodes[e * all + c]);
  return values;
}

double pressureScale(const fem::Mesh& mesh, const fem::Block& block, double shearModulus) {
  const std::size_t each = fem::nodesPerElement(block.topology), cells = block.nodes.size() / each;
  double length = 0;
  for (std::size_t e = 0; e < cells; ++e) {
    const double *a = &mesh.coordinates[3 * static_cast<std::size_t>(block.nodes[e * each])],
                 *b = &mesh.coordinates[3 * static_cast<std::size_t>(block.nodes[e * each + 1])];
    length += std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
  }
  return length > 0 ? shearModulus * static_cast<double>(cells) / length : shearModulus;
}

}  // namespace atrapos::solid
