#include "SurfaceFaces.hpp"

#include <fmt/format.h>

#include <map>
#include <stdexcept>

#include "Labels.hpp"

namespace atrapos::fem {
namespace {

Vec3 at(const std::vector<double>& vectors, std::size_t i) {
  return {vectors[3 * i], vectors[3 * i + 1], vectors[3 * i + 2]};
}

}  // namespace

void wrongSide(const Mesh& mesh, const SideSet& set, const Side& side, const char* needed) {
  const auto [b, e] = addressOf(mesh, side.element);
  throw std::runtime_error(fmt::format("side set '{}': side {} of {} is no {}", set.name, side.side + 1,
                                       elementLabel(mesh, b, e), needed));
}

std::vector<SurfaceFace> surfaceFaces(const Mesh& mesh, const ShellGeometry& shells, const SideSet& set,
                                      double zeta) {
  std::vector<SurfaceFace> faces;
  for (const Side& side : set.sides) {
    const auto [b, e] = addressOf(mesh, side.element);
    const Topology topology = mesh.blocks[b].topology;
    SurfaceFace own{side, sideFace(topology, side.side), {}, {}, {}};
    if (isLine(own.face))
      throw std::runtime_error(
          fmt::format("side set '{}': side {} of element {} is an edge, where a face is needed", set.name,
                      side.side + 1, mesh.elementNumber(side.element)));
    if (zeta != 0 && !isShell(mesh.blocks[b])) wrongSide(mesh, set, side, "face of a shell");
    const std::vector<int> local = sideNodes(topology, side.side);
    const std::size_t first = static_cast<std::size_t>(e) * nodesPerElement(topology);
    for (const int n : local) {
      own.nodes.push_back(mesh.blocks[b].nodes[first + n]);
      own.places.push_back(at(mesh.coordinates, own.nodes.back()));
    }
    own.factors.assign(local.size(), 1.0);
    if (zeta != 0) {
      const ShellBlock* block = shells.find(b);
      for (std::size_t n = 0; n < local.size(); ++n) {
        const std::size_t corner = first + local[n];
        add(zeta, at(block->directors, corner), own.places[n]);
        own.nodes.push_back(block->nodes[first + corner + block->nodesPerElement]);
        own.factors.push_back(zeta * block->directorScale[corner]);
      }
    }
    faces.push_back(std::move(own));
  }
  return faces;
}

void appendFace(const Mesh& mesh, const SideSet& set, const Tabulation& t, const SurfaceFace& face,
                PointSet& p) {
  p.nodesPerEntity = static_cast<int>(face.nodes.size());
  p.pointsPerEntity = t.numPoints;
  p.shapeComponents = 1;
  ++p.numEntities;
  p.nodes.insert(p.nodes.end(), face.nodes.begin(), face.nodes.end());
  for (int q = 0; q < t.numPoints; ++q) {
    Vec3 position{}, g[2]{};
    for (int n = 0; n < t.numNodes; ++n) {
      add(t.values[q * t.numNodes + n], face.places[n], position);
      for (int d = 0; d < 2; ++d) add(t.gradients[(q * t.numNodes + n) * 2 + d], face.places[n], g[d]);
    }
    const Vec3 normal = cross(g[0], g[1]);
    const double area = norm(normal);
    if (!(area > 0))
      throw std::runtime_error(fmt::format("side set '{}': side {} of element {} has no area", set.name,
                                           face.side.side + 1, mesh.elementNumber(face.side.element)));
    p.weights.push_back(t.weights[q] * area);
    p.positions.insert(p.positions.end(), position.begin(), position.end());
    for (int i = 0; i < 3; ++i) p.normals.push_back(normal[i] / area);
    for (std::size_t n = 0; n < face.nodes.size(); ++n)
      p.shape.push_back(face.factors[n] * t.values[q * t.numNodes + n % t.numNodes]);
  }
}

std::vector<PointSet> pointsOf(const Mesh& mesh, const SideSet& set, const std::vector<SurfaceFace>& faces,
                               int degree) {
  std::map<Face, PointSet> byShape;
  std::map<Face, Tabulation> tables;
  for (const SurfaceFace& face : faces) {
    if (!tables.count(face.face)) tables[face.face] = tabulateFace(face.face, degree);
    appendFace(mesh, set, tables.at(face.face), face, byShape[face.face]);
  }
  std::vector<PointSet> result;
  for (auto& entry : byShape) result.push_back(std::move(entry.second));
  return result;
}

}  // namespace atrapos::fem
