#include "atrapos/fem/PointSet.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>

#include "SurfaceFaces.hpp"
#include "Vec3.hpp"

namespace atrapos::fem {
namespace {

/// sum_n x_n (x) dN_n/dxi_d: the tangent vectors of the map from reference coordinates, one a dimension.
void tangents(const Mesh& mesh, const int* nodes, const Tabulation& t, int q, Vec3* g) {
  for (int d = 0; d < t.dim; ++d) g[d] = {0, 0, 0};
  for (int n = 0; n < t.numNodes; ++n) {
    const double* x = &mesh.coordinates[3 * nodes[n]];
    for (int d = 0; d < t.dim; ++d) {
      const double dN = t.gradients[(q * t.numNodes + n) * t.dim + d];
      for (int i = 0; i < 3; ++i) g[d][i] += dN * x[i];
    }
  }
}

void appendPosition(const Mesh& mesh, const int* nodes, const Tabulation& t, int q, PointSet& p) {
  Vec3 x{0, 0, 0};
  for (int n = 0; n < t.numNodes; ++n)
    for (int i = 0; i < 3; ++i) x[i] += t.values[q * t.numNodes + n] * mesh.coordinates[3 * nodes[n] + i];
  p.positions.insert(p.positions.end(), x.begin(), x.end());
}

PointSet volume(const Mesh& mesh, const Block& block, const Tabulation& t, bool gradients) {
  if (!isSolid(block.topology))
    throw std::runtime_error(fmt::format("block '{}': {} is no solid and has no volume points", block.name,
                                         topologyName(block.topology)));
  PointSet p;
  p.nodesPerEntity = t.numNodes;
  p.pointsPerEntity = t.numPoints;
  p.shapeComponents = gradients ? 3 : 1;
  p.nodes = block.nodes;
  p.numEntities = static_cast<int>(block.nodes.size()) / t.numNodes;
  if (gradients && p.numEntities > 0) p.shape = t.gradients;
  for (int e = 0; e < p.numEntities; ++e) {
    const int* nodes = &block.nodes[static_cast<std::size_t>(e) * t.numNodes];
    for (int q = 0; q < t.numPoints; ++q) {
      Vec3 g[3];
      tangents(mesh, nodes, t, q, g);
      const double det = dot(g[0], cross(g[1], g[2]));
      if (!(det > 0))
        throw std::runtime_error(
            fmt::format("block '{}', element {} (of the block): the Jacobian is {:.3g} at a cubature point, "
                        "must be positive; "
                        "check node order and shape",
                        block.name, e + 1, det));
      p.weights.push_back(t.weights[q] * det);
      appendPosition(mesh, nodes, t, q, p);
      if (gradients)
        // Rows of the inverse Jacobian are the contravariant vectors.
        for (const Vec3& row : {cross(g[1], g[2]), cross(g[2], g[0]), cross(g[0], g[1])})
          for (int i = 0; i < 3; ++i) p.maps.push_back(row[i] / det);
      else
        for (int n = 0; n < t.numNodes; ++n) p.shape.push_back(t.values[q * t.numNodes + n]);
    }
  }
  return p;
}

}  // namespace

int PointSet::allInputs() const {
  int sum = inputs();
  for (const Interpolation& other : more) sum += other.inputs();
  return sum;
}

double PointSet::shapeAt(std::size_t point, int node, int component) const {
  const auto entry = [&](std::size_t p, int c) {
    return shape[(p * nodesPerEntity + node) * shapeComponents + c];
  };
  if (maps.empty()) return entry(point, component);
  double sum = 0;
  const int C = shapeComponents;
  for (int d = 0; d < C; ++d)
    sum += entry(point % pointsPerEntity, d) * maps[(point * C + d) * C + component];
  return sum;
}

PointSet volumePoints(const Mesh& mesh, const Block& block, const Tabulation& cell) {
  return volume(mesh, block, cell, true);
}

PointSet volumeValuePoints(const Mesh& mesh, const Block& block, const Tabulation& cell) {
  return volume(mesh, block, cell, false);
}

namespace {

Interpolation ofField(const Field& field, const PointSet& points, const Tabulation& shape) {
  if (shape.numPoints != points.pointsPerEntity || shape.numNodes > points.nodesPerEntity)
    throw std::logic_error("a field's shape functions are not tabulated at the points of its entities");
  Interpolation of;
  of.field = field.name;
  of.components = field.numComponents();
  of.nodesPerEntity = shape.numNodes;
  for (int e = 0; e < points.numEntities; ++e) {
    const int* nodes = &points.nodes[static_cast<std::size_t>(e) * points.nodesPerEntity];
    of.nodes.insert(of.nodes.end(), nodes, nodes + shape.numNodes);
  }
  return of;
}

}  // namespace

Interpolation valuesOf(const Field& field, const PointSet& points, const Tabulation& shape) {
  Interpolation of = ofField(field, points, shape);
  of.shapeComponents = 1;
  for (int e = 0; e < points.numEntities; ++e)
    of.shape.insert(of.shape.end(), shape.values.begin(), shape.values.end());
  return of;
}

Interpolation gradientsOf(const Field& field, const PointSet& points, const Tabulation& shape) {
  if (points.maps.empty()) throw std::logic_error("gradientsOf: points without maps");
  Interpolation of = ofField(field, points, shape);
  of.shapeComponents = points.shapeComponents;
  of.shape = shape.gradients;
  of.maps = points.maps;
  return of;
}

ElementAddress addressOf(const Mesh& mesh, int element) {
  int first = 0;
  for (int b = 0; b < static_cast<int>(mesh.blocks.size()); ++b) {
    const int count =
        static_cast<int>(mesh.blocks[b].nodes.size()) / nodesPerElement(mesh.blocks[b].topology);
    if (element < first + count) return {b, element - first};
    first += count;
  }
  throw std::out_of_range(fmt::format("element {} is not in the mesh of {} elements", element + 1, first));
}

std::vector<PointSet> facePoints(const Mesh& mesh, const SideSet& set, int degree) {
  return pointsOf(mesh, set, surfaceFaces(mesh, {}, set, 0), degree);
}

PointSet nodePoints(const Mesh& mesh, const std::vector<int>& nodes) {
  PointSet p;
  p.numEntities = static_cast<int>(nodes.size());
  p.nodesPerEntity = p.pointsPerEntity = p.shapeComponents = 1;
  p.components = mesh.dimension;
  p.nodes = nodes;
  p.shape.assign(nodes.size(), 1.0);
  p.weights.assign(nodes.size(), 1.0);
  for (int n : nodes)
    p.positions.insert(p.positions.end(), &mesh.coordinates[3 * n], &mesh.coordinates[3 * n] + 3);
  return p;
}

std::vector<int> nodesOf(const Mesh& mesh, const SideSet& set) {
  std::set<int> nodes;
  for (const Side& side : set.sides) {
    const auto [b, e] = addressOf(mesh, side.element);
    const Block& block = mesh.blocks[b];
    for (int n : sideNodes(block.topology, side.side))
      nodes.insert(block.nodes[static_cast<std::size_t>(e) * nodesPerElement(block.topology) + n]);
  }
  return {nodes.begin(), nodes.end()};
}

}  // namespace atrapos::fem
