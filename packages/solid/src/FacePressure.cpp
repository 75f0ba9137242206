#include "atrapos/solid/FacePressure.hpp"

#include <fmt/format.h>

#include <map>
#include <stdexcept>

#include "atrapos/fem/LawTerm.hpp"
#include "atrapos/fem/PointSet.hpp"
#include "atrapos/fem/ReferenceCell.hpp"

namespace atrapos::solid {
namespace {

// N_a x_xi x x_eta has degree 2 + 2 + 1 in one coordinate on HEX27's faces; on triangles of TET10 the sum of
// both is 2 + 1 + 1.
constexpr int kFaceDegree = 5;

struct Faces {
  fem::PointSet points;
  std::vector<double> data;  ///< undeformed x_xi, x_eta
};

void append(const fem::Mesh& mesh, const fem::Tabulation& t, const std::vector<int>& nodes, Faces& faces) {
  fem::PointSet& p = faces.points;
  ++p.numEntities;
  p.nodesPerEntity = t.numNodes;
  p.pointsPerEntity = t.numPoints;
  p.shapeComponents = 3;
  p.nodes.insert(p.nodes.end(), nodes.begin(), nodes.end());
  for (int q = 0; q < t.numPoints; ++q) {
    p.weights.push_back(t.weights[q]);
    double tangents[6] = {};
    for (int n = 0; n < t.numNodes; ++n) {
      const double* dN = &t.gradients[(q * t.numNodes + n) * 2];
      p.shape.insert(p.shape.end(), {t.values[q * t.numNodes + n], dN[0], dN[1]});
      for (int d = 0; d < 2; ++d)
        for (int i = 0; i < 3; ++i)
          tangents[3 * d + i] += dN[d] * mesh.coordinates[3 * static_cast<std::size_t>(nodes[n]) + i];
    }
    faces.data.insert(faces.data.end(), tangents, tangents + 6);
  }
}

}  // namespace

std::vector<std::unique_ptr<fem::Term>> followerPressure(const fem::Mesh& mesh, const fem::SideSet& set,
                                                         LoadAmount pressure) {
  std::map<fem::Face, Faces> byShape;
  std::map<fem::Face, fem::Tabulation> tables;
  for (const fem::Side& side : set.sides) {
    const auto [b, e] = fem::addressOf(mesh, side.element);
    const fem::Block& block = mesh.blocks[b];
    if (fem::isShell(block))
      throw std::invalid_argument(
          fmt::format("side set '{}': element {} is a shell, whose pressures are those of its surfaces",
                      set.name, side.element + 1));
    const fem::Face face = fem::sideFace(block.topology, side.side);
    if (!tables.count(face)) tables[face] = fem::tabulateFace(face, kFaceDegree);
    std::vector<int> nodes;
    for (int n : fem::sideNodes(block.topology, side.side))
      nodes.push_back(block.nodes[static_cast<std::size_t>(e) * fem::nodesPerElement(block.topology) + n]);
    append(mesh, tables.at(face), nodes, byShape[face]);
  }
  std::vector<std::unique_ptr<fem::Term>> terms;
  for (const auto& [face, faces] : byShape)
    terms.push_back(fem::lawTerm(fem::pointLaw(FollowerPressure{pressure}), faces.points, faces.data));
  return terms;
}

}  // namespace atrapos::solid
