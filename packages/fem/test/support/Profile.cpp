#include "support/Profile.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "atrapos/fem/StructuredShell.hpp"
#include "support/Meshes.hpp"

namespace atrapos::fem::test {
namespace {

constexpr double kSamePlace = 1e-9;  // of meshes of sizes 1 to 1000: far above rounding, far below elements

Mesh plateOf(const Wall& wall, double length, int along, Topology cell) {
  ShellPlateOptions o;
  o.topology = cell;
  o.width = length;
  o.divisions = {wall.divisions, along};
  Mesh mesh = shellPlateMesh(o);
  for (int n = 0; n < mesh.numNodes(); ++n) {
    double* x = &mesh.coordinates[3 * static_cast<std::size_t>(n)];
    const double s = x[0], z = x[1];
    for (int i = 0; i < 2; ++i) x[i] = (1 - s) * wall.from[i] + s * wall.to[i];
    x[2] = z;
  }
  return mesh;
}

}  // namespace

Mesh profileMesh(const std::vector<Wall>& walls, double length, int divisionsAlong, Topology cell) {
  std::vector<Mesh> plates;
  for (std::size_t w = 0; w < walls.size(); ++w) {
    plates.push_back(plateOf(walls[w], length, divisionsAlong, cell));
    plates.back().blocks[0].name = "wall" + std::to_string(w + 1);
    plates.back().blocks[0].id = static_cast<long long>(w) + 1;
  }
  Mesh mesh = glued(plates);
  mesh.nodeSets.clear();
  mesh.sideSets.clear();
  NodeSet foot{"foot", 1, {}}, head{"head", 2, {}};
  for (int n = 0; n < mesh.numNodes(); ++n) {
    const double z = mesh.coordinates[3 * static_cast<std::size_t>(n) + 2];
    if (z < kSamePlace) foot.nodes.push_back(n);
    if (z > length - kSamePlace) head.nodes.push_back(n);
  }
  mesh.nodeSets = {foot, head};
  return mesh;
}

std::vector<int> nodesAbove(const Mesh& mesh, const std::array<double, 2>& point) {
  std::vector<int> nodes;
  const auto x = [&](int n) { return &mesh.coordinates[3 * static_cast<std::size_t>(n)]; };
  for (int n = 0; n < mesh.numNodes(); ++n)
    if (std::hypot(x(n)[0] - point[0], x(n)[1] - point[1]) < kSamePlace) nodes.push_back(n);
  std::sort(nodes.begin(), nodes.end(), [&](int a, int b) { return x(a)[2] < x(b)[2]; });
  return nodes;
}

}  // namespace atrapos::fem::test
