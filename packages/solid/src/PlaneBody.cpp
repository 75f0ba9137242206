#include "atrapos/solid/PlaneBody.hpp"

#include <array>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

#include "atrapos/fem/ReducedLaw.hpp"
#include "atrapos/fem/ReferenceCell.hpp"

namespace atrapos::solid {
namespace {

using Kind = PlaneSection::Kind;
using fem::Tabulation;

/// A point of a cell or edge: its place, and the tangents of the map from reference coordinates.
struct PlanePlace {
  double x[2] = {0, 0};
  double along[2][2] = {{0, 0}, {0, 0}};  ///< [direction][component]
};

PlanePlace placeAt(const fem::Mesh& mesh, const int* nodes, const Tabulation& t, int q) {
  PlanePlace place;
  for (int n = 0; n < t.numNodes; ++n)
    for (int i = 0; i < 2; ++i) {
      const double x = mesh.coordinates[3 * static_cast<std::size_t>(nodes[n]) + i];
      place.x[i] += t.values[q * t.numNodes + n] * x;
      for (int d = 0; d < t.dim; ++d) place.along[d][i] += t.gradients[(q * t.numNodes + n) * t.dim + d] * x;
    }
  return place;
}

/// What an area or length in the plane is multiplied by.
double depth(const PlaneSection& section, double x) {
  return section.kind == Kind::axisymmetric ? 2 * std::acos(-1.0) * x : section.thickness;
}

[[noreturn]] void fail(const fem::Block& block, int element, const std::string& what) {
  throw std::runtime_error("block '" + block.name + "', element " + std::to_string(element + 1) +
                           " (of the block): " + what);
}

fem::PointSet points(const fem::Mesh& mesh, const fem::Block& block, const Tabulation& t,
                     const PlaneSection& section, bool gradients) {
  if (!fem::isPlane(block.topology))
    throw std::runtime_error("block '" + block.name + "': " + fem::topologyName(block.topology) +
                             " is no plane cell");
  const bool ring = section.kind == Kind::axisymmetric;
  fem::PointSet p;
  p.components = 2;
  p.nodesPerEntity = t.numNodes;
  p.pointsPerEntity = t.numPoints;
  p.shapeComponents = !gradients ? 1 : ring ? 3 : 2;
  p.nodes = block.nodes;
  p.numEntities = static_cast<int>(block.nodes.size()) / t.numNodes;
  if (gradients && !ring && p.numEntities > 0) p.shape = t.gradients;
  for (int e = 0; e < p.numEntities; ++e)
    for (int q = 0; q < t.numPoints; ++q) {
      const PlanePlace place = placeAt(mesh, &block.nodes[static_cast<std::size_t>(e) * t.numNodes], t, q);
      const auto& g = place.along;
      const double det = g[0][0] * g[1][1] - g[0][1] * g[1][0];
      if (!(det > 0))
        fail(block, e,
             "the Jacobian is not positive at a cubature point; check node order (counter-clockwise) "
             "and shape");
      if (ring && !(place.x[0] > 0)) fail(block, e, "the radius x is not positive; the axis is x = 0");
      p.weights.push_back(t.weights[q] * det * depth(section, place.x[0]));
      p.positions.insert(p.positions.end(), {place.x[0], place.x[1], 0.0});
      // Rows of the inverse Jacobian, dxi_d/dX_i.
      const double map[2][2] = {{g[1][1] / det, -g[1][0] / det}, {-g[0][1] / det, g[0][0] / det}};
      if (gradients && !ring) {
        for (const auto& row : map) p.maps.insert(p.maps.end(), row, row + 2);
        continue;
      }
      for (int n = 0; n < t.numNodes; ++n) {
        const double value = t.values[q * t.numNodes + n];
        const double* dN = &t.gradients[(q * t.numNodes + n) * 2];
        for (int i = 0; gradients && i < 2; ++i) p.shape.push_back(dN[0] * map[0][i] + dN[1] * map[1][i]);
        p.shape.push_back(gradients ? value / place.x[0] : value);
      }
    }
  return p;
}

}  // namespace

fem::PointSet planePoints(const fem::Mesh& mesh, const fem::Block& block, const Tabulation& cell,
                          const PlaneSection& section) {
  return points(mesh, block, cell, section, true);
}

fem::PointSet planeValuePoints(const fem::Mesh& mesh, const fem::Block& block, const Tabulation& cell,
                               const PlaneSection& section) {
  return points(mesh, block, cell, section, false);
}

std::vector<fem::PointSet> planeEdgePoints(const fem::Mesh& mesh, const fem::SideSet& set,
                                           const PlaneSection& section, int degree) {
  std::map<fem::Face, fem::PointSet> byShape;
  std::map<fem::Face, Tabulation> tables;
  for (const fem::Side& side : set.sides) {
    const auto [b, e] = fem::addressOf(mesh, side.element);
    const fem::Block& block = mesh.blocks[b];
    const std::string which = "side set '" + set.name + "': side " + std::to_string(side.side + 1) +
                              " of element " + std::to_string(side.element + 1);
    if (!fem::isPlane(block.topology)) throw std::runtime_error(which + " is no edge of a plane cell");
    const fem::Face face = fem::sideFace(block.topology, side.side);
    if (!tables.count(face)) tables[face] = fem::tabulateFace(face, degree);
    const Tabulation& t = tables.at(face);
    fem::PointSet& p = byShape[face];
    p.components = 2;
    p.nodesPerEntity = t.numNodes;
    p.pointsPerEntity = t.numPoints;
    p.shapeComponents = 1;
    ++p.numEntities;
    std::vector<int> nodes;
    for (const int n : fem::sideNodes(block.topology, side.side))
      nodes.push_back(block.nodes[static_cast<std::size_t>(e) * fem::nodesPerElement(block.topology) + n]);
    p.nodes.insert(p.nodes.end(), nodes.begin(), nodes.end());
    for (int q = 0; q < t.numPoints; ++q) {
      const PlanePlace place = placeAt(mesh, nodes.data(), t, q);
      const double* along = place.along[0];
      const double length = std::hypot(along[0], along[1]);
      if (!(length > 0)) throw std::runtime_error(which + " has no length");
      p.weights.push_back(t.weights[q] * length * depth(section, place.x[0]));
      p.positions.insert(p.positions.end(), {place.x[0], place.x[1], 0.0});
      // Edges run counter-clockwise: outside is to the right.
      p.normals.insert(p.normals.end(), {along[1] / length, -along[0] / length, 0.0});
      for (int n = 0; n < t.numNodes; ++n) p.shape.push_back(t.values[q * t.numNodes + n]);
    }
  }
  std::vector<fem::PointSet> result;
  for (auto& entry : byShape) result.push_back(std::move(entry.second));
  return result;
}

std::vector<fem::LineSet> planeEdgeLines(const fem::Mesh& mesh, const fem::SideSet& set,
                                         const PlaneSection& section, int degree) {
  const bool ring = section.kind == Kind::axisymmetric;
  std::vector<fem::LineSet> result;
  for (const fem::PointSet& edges : planeEdgePoints(mesh, set, section, degree)) {
    fem::LineSet lines;
    const int N = edges.nodesPerEntity;
    lines.degree = N - 1;
    lines.components = 2;
    lines.nodesPerLine = N;
    lines.nodes = edges.nodes;
    // Of the shape functions, [node][k]: ends at -1 and 1, then the middle.
    const std::vector<double> shape = N == 2 ? std::vector<double>{0.5, -0.5, 0.5, 0.5}
                                             : std::vector<double>{0, -0.5, 0.5, 0, 0.5, 0.5, 1, 0, -1};
    std::map<int, int> ends;
    for (int e = 0; e < edges.numEntities; ++e)
      for (int end = 0; end < 2; ++end) ends.emplace(edges.nodes[e * N + end], 0);
    for (auto& [node, number] : ends) {
      number = lines.numEnds();
      lines.endNodes.push_back(node);
    }
    for (int e = 0; e < edges.numEntities; ++e) {
      const int* nodes = &edges.nodes[e * N];
      lines.shape.insert(lines.shape.end(), shape.begin(), shape.end());
      for (int k = 0; k < N; ++k) {
        double X[3] = {0, 0, 0};
        for (int n = 0; n < N; ++n)
          for (int i = 0; i < 2; ++i)
            X[i] += shape[n * N + k] * mesh.coordinates[3 * static_cast<std::size_t>(nodes[n]) + i];
        lines.coefficients.insert(lines.coefficients.end(), X, X + 3);
        const double depth = ring ? 2 * std::acos(-1.0) * X[0] : k == 0 ? section.thickness : 0;
        lines.across.insert(lines.across.end(), {0, 0, depth});
      }
      lines.ends.insert(lines.ends.end(), {ends.at(nodes[0]), ends.at(nodes[1])});
      lines.middleNodes.push_back(nodes[N - 1]);
    }
    const Tabulation t = fem::tabulateFace(lines.degree == 1 ? fem::Face::Line2 : fem::Face::Line3, degree);
    lines.shown = t.points;
    lines.weights = edges.weights;
    result.push_back(std::move(lines));
  }
  return result;
}

std::unique_ptr<fem::PointLaw> planeLaw(std::unique_ptr<fem::PointLaw> material, Kind kind, int across) {
  // H by rows: xx, xy, xz, yx, yy, yz, zx, zy, zz.
  fem::Reduction r{{0, 1, -1, 2, 3, -1, -1, -1, -1}, {0, 1, 3, 4}, 4, kind == Kind::stress ? 8 : -1};
  if (kind == Kind::axisymmetric) r = {{0, 1, -1, 3, 4, -1, -1, -1, 2}, {0, 1, 8, 3, 4, -1}, 6, -1};
  for (int more = 9; more < material->shape().inputs; ++more) {
    if (more == across) {
      r.inputs.push_back(-1);
      continue;
    }
    r.inputs.push_back(r.numInputs++);
    if (more < material->shape().outputs) r.outputs.push_back(more);  // not of the load factor
  }
  return fem::reducedLaw(std::move(material), std::move(r));
}

}  // namespace atrapos::solid
