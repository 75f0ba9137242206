#include "report/Surface.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "atrapos/fem/ReferenceCell.hpp"

namespace atrapos {
namespace {

/// How a face is drawn: triangles of its nodes, and those around it.
struct Drawn {
  int corners;
  std::vector<std::array<int, 3>> triangles;
  std::vector<int> rim;
};

const Drawn& drawn(std::size_t numNodes) {
  static const Drawn tri3{3, {{0, 1, 2}}, {0, 1, 2}};
  static const Drawn tri6{3, {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}}, {0, 3, 1, 4, 2, 5}};
  static const Drawn quad4{4, {{0, 1, 2}, {0, 2, 3}}, {0, 1, 2, 3}};
  static const Drawn quad8{
      4, {{0, 4, 7}, {4, 1, 5}, {5, 2, 6}, {6, 3, 7}, {4, 5, 6}, {4, 6, 7}}, {0, 4, 1, 5, 2, 6, 3, 7}};
  static const Drawn quad9{
      4,
      {{0, 4, 8}, {4, 1, 8}, {1, 5, 8}, {5, 2, 8}, {2, 6, 8}, {6, 3, 8}, {3, 7, 8}, {7, 0, 8}},
      {0, 4, 1, 5, 2, 6, 3, 7}};
  switch (numNodes) {
    case 3:
      return tri3;
    case 6:
      return tri6;
    case 4:
      return quad4;
    case 8:
      return quad8;
    default:
      return quad9;
  }
}

/// A face of one element by its nodes in the mesh.
struct FaceOf {
  int element;
  std::vector<int> nodes;
};

std::vector<std::vector<int>> facesOf(fem::Topology topology) {
  if (fem::isShell(topology)) return {fem::sideNodes(topology, 0)};
  if (fem::isPlane(topology)) {
    std::vector<int> all(fem::nodesPerElement(topology));
    std::iota(all.begin(), all.end(), 0);
    return {all};
  }
  std::vector<std::vector<int>> faces;
  for (int side = 0; side < fem::numSides(topology); ++side) faces.push_back(fem::sideNodes(topology, side));
  return faces;
}

std::vector<int> sortedCorners(const FaceOf& face) {
  std::vector<int> corners(face.nodes.begin(), face.nodes.begin() + drawn(face.nodes.size()).corners);
  std::sort(corners.begin(), corners.end());
  return corners;
}

/// Two solid cells that share a face hide it; shells and plane cells hide nothing, and bars have none.
std::vector<FaceOf> outerFaces(const fem::Mesh& mesh) {
  std::vector<FaceOf> surfaces, sides;
  std::map<std::vector<int>, int> count;
  int element = 0;
  for (const fem::Block& block : mesh.blocks) {
    const std::size_t numNodes = fem::nodesPerElement(block.topology);
    const auto local = facesOf(block.topology);
    const bool isSolid = fem::isSolid(block.topology);
    for (std::size_t first = 0; first < block.nodes.size(); first += numNodes, ++element)
      for (const auto& nodes : local) {
        FaceOf face{element, {}};
        for (const int node : nodes) face.nodes.push_back(block.nodes[first + node]);
        if (isSolid) ++count[sortedCorners(face)];
        (isSolid ? sides : surfaces).push_back(std::move(face));
      }
  }
  for (FaceOf& side : sides)
    if (count.at(sortedCorners(side)) == 1) surfaces.push_back(std::move(side));
  return surfaces;
}

}  // namespace

Surface surfaceOf(const fem::Mesh& mesh) {
  Surface surface;
  std::vector<int> numbers(mesh.numNodes(), -1);
  const auto number = [&](int node) {
    if (numbers[node] < 0) {
      numbers[node] = static_cast<int>(surface.nodes.size());
      surface.nodes.push_back(node);
    }
    return static_cast<std::uint32_t>(numbers[node]);
  };
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  const auto addEdge = [&](int from, int to) {
    const auto a = number(from), b = number(to);
    if (!edges.insert(std::minmax(a, b)).second) return;
    surface.edges.push_back(a);
    surface.edges.push_back(b);
  };
  for (const FaceOf& face : outerFaces(mesh)) {
    const Drawn& how = drawn(face.nodes.size());
    for (const auto& triangle : how.triangles) {
      for (const int local : triangle) surface.triangles.push_back(number(face.nodes[local]));
      surface.triangleElements.push_back(static_cast<std::uint32_t>(face.element));
    }
    for (std::size_t i = 0; i < how.rim.size(); ++i)
      addEdge(face.nodes[how.rim[i]], face.nodes[how.rim[(i + 1) % how.rim.size()]]);
  }
  for (const fem::Block& block : mesh.blocks) {
    if (!fem::isBar(block.topology)) continue;
    const std::size_t numNodes = fem::nodesPerElement(block.topology);
    for (std::size_t first = 0; first < block.nodes.size(); first += numNodes) {
      const int *nodes = &block.nodes[first], middle = nodes[numNodes - 1];  // of two nodes the end
      addEdge(nodes[0], middle);
      addEdge(middle, nodes[1]);
    }
  }
  return surface;
}

}  // namespace atrapos
