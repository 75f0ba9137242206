#include "atrapos/solid/EdgePressure.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <optional>
#include <stdexcept>

#include "atrapos/fem/LawTerm.hpp"
#include "atrapos/fem/PointSet.hpp"
#include "atrapos/fem/ReferenceCell.hpp"

namespace atrapos::solid {
namespace {

using Kind = PlaneSection::Kind;

// r r_xi N has degree 2 + 1 + 2 on edges of three nodes.
constexpr int kEdgeDegree = 5;

std::vector<int> nodesOfEdge(const fem::Mesh& mesh, const fem::Side& side, const fem::SideSet& set) {
  const auto [b, e] = fem::addressOf(mesh, side.element);
  const fem::Block& block = mesh.blocks[b];
  if (!fem::isPlane(block.topology))
    throw std::invalid_argument(fmt::format("side set '{}': side {} of element {} is no edge of a plane cell",
                                            set.name, side.side + 1, side.element + 1));
  std::vector<int> nodes;
  for (const int n : fem::sideNodes(block.topology, side.side))
    nodes.push_back(block.nodes[static_cast<std::size_t>(e) * fem::nodesPerElement(block.topology) + n]);
  return nodes;
}

struct Edges {
  fem::PointSet points;
  std::vector<double> data;  ///< of EdgePressure
};

void append(const fem::Mesh& mesh, const fem::Tabulation& t, const std::vector<int>& nodes, double depth,
            Edges& edges) {
  fem::PointSet& p = edges.points;
  ++p.numEntities;
  p.components = 2;
  p.nodesPerEntity = t.numNodes;
  p.pointsPerEntity = t.numPoints;
  p.shapeComponents = 2;
  p.nodes.insert(p.nodes.end(), nodes.begin(), nodes.end());
  for (int q = 0; q < t.numPoints; ++q) {
    p.weights.push_back(t.weights[q] * depth);
    double data[3] = {0, 0, 0};
    for (int n = 0; n < t.numNodes; ++n) {
      const double N = t.values[q * t.numNodes + n], slope = t.gradients[q * t.numNodes + n];
      p.shape.insert(p.shape.end(), {N, slope});
      const double* x = &mesh.coordinates[3 * static_cast<std::size_t>(nodes[n])];
      data[0] += N * x[0];
      data[1] += slope * x[0];
      data[2] += slope * x[1];
    }
    edges.data.insert(edges.data.end(), data, data + 3);
  }
}

std::unique_ptr<fem::PointLaw> edgeLaw(LoadAmount pressure, bool ring) {
  if (ring) return fem::pointLaw(EdgePressure<true>{pressure});
  return fem::pointLaw(EdgePressure<false>{pressure});
}

}  // namespace

bool hasPotential(const fem::Mesh& mesh, const fem::SideSet& set, const fem::DofMap& dofs,
                  const fem::Supports& supports) {
  std::map<int, int> ends;  // how many edges end at a node, less those that begin there
  for (const fem::Side& side : set.sides) {
    const std::vector<int> nodes = nodesOfEdge(mesh, side, set);
    --ends[nodes[0]];
    ++ends[nodes[1]];
  }
  std::optional<double> origin;
  for (const auto& [node, sum] : ends) {
    const int x = dofs.firstDof(node), y = x + 1;
    if (sum == 0 || supports.fixed(y)) continue;
    if (!supports.fixed(x) || supports.perLoadFactor(x) != 0) return false;
    const double held = mesh.coordinates[3 * static_cast<std::size_t>(node)] + supports.value(x);
    // Two places that differ by rounding are one: what is not symmetric then is rounding too.
    if (origin && std::abs(held - *origin) > 1e-12 * (std::abs(held) + std::abs(*origin))) return false;
    if (!origin) origin = held;
  }
  return true;
}

std::vector<std::unique_ptr<fem::Term>> followerPressure(const fem::Mesh& mesh, const fem::SideSet& set,
                                                         const PlaneSection& section, LoadAmount pressure,
                                                         bool hasPotential) {
  if (section.kind == Kind::stress)
    throw std::invalid_argument(
        "a pressure that follows acts on the thickness of the deformed edge, which plane stress leaves open; "
        "expected kind: strain or axisymmetric, or a pressure that does not follow");
  const bool ring = section.kind == Kind::axisymmetric;
  const double depth = ring ? 2 * std::acos(-1.0) : section.thickness;
  std::map<fem::Face, Edges> byShape;
  std::map<fem::Face, fem::Tabulation> tables;
  for (const fem::Side& side : set.sides) {
    const std::vector<int> nodes = nodesOfEdge(mesh, side, set);
    const fem::Face face = nodes.size() == 2 ? fem::Face::Line2 : fem::Face::Line3;
    if (!tables.count(face)) tables[face] = fem::tabulateFace(face, kEdgeDegree);
    append(mesh, tables.at(face), nodes, depth, byShape[face]);
  }
  std::vector<std::unique_ptr<fem::Term>> terms;
  for (const auto& [face, edges] : byShape)
    terms.push_back(hasPotential ? fem::symmetricSumTerm(edgeLaw(pressure, ring), edges.points, edges.data)
                                 : fem::lawTerm(edgeLaw(pressure, ring), edges.points, edges.data));
  return terms;
}

}  // namespace atrapos::solid
