#include "atrapos/fem/ShellFaces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <stdexcept>

#include "Labels.hpp"
#include "SurfaceFaces.hpp"
#include "Vec3.hpp"
#include "atrapos/fem/ReferenceCell.hpp"

namespace atrapos::fem {
namespace {

// N_a has degree 2 and the Jacobian of a parabolic edge is not a polynomial: as for the faces of solids.
constexpr int kEdgeDegree = 4;

Vec3 at(const std::vector<double>& vectors, std::size_t i) {
  return {vectors[3 * i], vectors[3 * i + 1], vectors[3 * i + 2]};
}

}  // namespace

std::vector<PointSet> shellFacePoints(const Mesh& mesh, const ShellGeometry& shells, const SideSet& set,
                                      double zeta, int degree) {
  for (const Side& side : set.sides)
    if (!isShell(mesh.blocks[addressOf(mesh, side.element).block]) || side.side > 1)
      wrongSide(mesh, set, side, "face of a shell");
  return pointsOf(mesh, set, surfaceFaces(mesh, shells, set, zeta), degree);
}

PointSet shellNodePoints(const Mesh& mesh, const ShellGeometry& shells, const std::vector<int>& nodes,
                         double zeta) {
  PointSet p;
  p.numEntities = static_cast<int>(nodes.size());
  p.nodesPerEntity = 2;
  p.pointsPerEntity = p.shapeComponents = 1;
  p.weights.assign(nodes.size(), 1.0);
  for (int n : nodes) {
    const int first = shells.firstDirector[n], count = shells.firstDirector[n + 1] - first;
    if (count != 1)
      throw std::runtime_error(fmt::format(
          "{}: {}, so it has no point at zeta = {}", nodeLabel(mesh, n),
          count == 0 ? "no shell is there" : fmt::format("a fold with {} directors", count), zeta));
    p.nodes.insert(p.nodes.end(), {n, shells.numMeshNodes + first});
    p.shape.insert(p.shape.end(), {1.0, zeta});
    Vec3 x = at(mesh.coordinates, n);
    add(zeta, at(shells.directors, first), x);
    p.positions.insert(p.positions.end(), x.begin(), x.end());
  }
  return p;
}

std::vector<PointSet> shellEdgePoints(const Mesh& mesh, const SideSet& set, int degree) {
  std::map<Face, PointSet> byShape;
  std::map<Face, Tabulation> tables;
  for (const Side& side : set.sides) {
    const auto [b, e] = addressOf(mesh, side.element);
    const Block& block = mesh.blocks[b];
    if (!isShell(block.topology) || side.side < 2) wrongSide(mesh, set, side, "edge of a shell");
    const Face face = sideFace(block.topology, side.side);
    if (!tables.count(face)) tables[face] = tabulateFace(face, degree);
    const Tabulation& t = tables.at(face);
    const std::vector<int> local = sideNodes(block.topology, side.side);
    const std::size_t first = static_cast<std::size_t>(e) * nodesPerElement(block.topology);
    PointSet& p = byShape[face];
    p.nodesPerEntity = t.numNodes;
    p.pointsPerEntity = t.numPoints;
    p.shapeComponents = 1;
    ++p.numEntities;
    for (int n : local) p.nodes.push_back(block.nodes[first + n]);
    // The same points within the element, where the surface has a normal.
    const std::vector<double> reference = referenceNodes(block.topology);
    std::vector<double> inElement(2 * static_cast<std::size_t>(t.numPoints), 0.0);
    for (int q = 0; q < t.numPoints; ++q)
      for (int n = 0; n < t.numNodes; ++n)
        for (int i = 0; i < 2; ++i)
          inElement[2 * q + i] += t.values[q * t.numNodes + n] * reference[2 * local[n] + i];
    const Tabulation surface = tabulateAt(block.topology, inElement);
    for (int q = 0; q < t.numPoints; ++q) {
      Vec3 position{}, along{}, g[2]{};
      for (int n = 0; n < t.numNodes; ++n) {
        const Vec3 x = at(mesh.coordinates, block.nodes[first + local[n]]);
        add(t.values[q * t.numNodes + n], x, position);
        add(t.gradients[q * t.numNodes + n], x, along);
        p.shape.push_back(t.values[q * t.numNodes + n]);
      }
      for (int n = 0; n < surface.numNodes; ++n)
        for (int d = 0; d < 2; ++d)
          add(surface.gradients[(q * surface.numNodes + n) * 2 + d],
              at(mesh.coordinates, block.nodes[first + n]), g[d]);
      const Vec3 outward = cross(along, cross(g[0], g[1]));
      p.weights.push_back(t.weights[q] * norm(along));
      p.positions.insert(p.positions.end(), position.begin(), position.end());
      for (int i = 0; i < 3; ++i) p.normals.push_back(outward[i] / norm(outward));
    }
  }
  std::vector<PointSet> result;
  for (auto& entry : byShape) result.push_back(std::move(entry.second));
  return result;
}

void addEdgeForce(const Mesh& mesh, const SideSet& set, const std::array<double, 3>& perLength,
                  std::vector<double>& force) {
  for (const PointSet& p : shellEdgePoints(mesh, set, kEdgeDegree))
    for (int point = 0; point < p.numPoints(); ++point)
      for (int n = 0; n < p.nodesPerEntity; ++n) {
        const int node = p.nodes[static_cast<std::size_t>(point / p.pointsPerEntity) * p.nodesPerEntity + n];
        const double share =
            p.weights[point] * p.shape[static_cast<std::size_t>(point) * p.nodesPerEntity + n];
        for (int i = 0; i < 3; ++i) force[3 * static_cast<std::size_t>(node) + i] += share * perLength[i];
      }
}

double edgeLength(const Mesh& mesh, const SideSet& set) {
  double length = 0;
  for (const PointSet& p : shellEdgePoints(mesh, set, kEdgeDegree))
    for (double w : p.weights) length += w;
  return length;
}

}  // namespace atrapos::fem
