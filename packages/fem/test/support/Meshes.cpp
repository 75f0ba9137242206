#include "support/Meshes.hpp"

#include <array>
#include <cmath>
#include <map>
#include <random>
#include <stdexcept>

namespace atrapos::fem::test {

const std::vector<Topology>& allCells() {
  static const std::vector<Topology> cells{Topology::Hex8,   Topology::Hex20, Topology::Hex27,
                                           Topology::Tet4,   Topology::Tet10, Topology::Wedge6,
                                           Topology::Wedge15};
  return cells;
}

bool isQuadratic(Topology t) { return t != Topology::Hex8 && t != Topology::Tet4 && t != Topology::Wedge6; }

Mesh box(Topology topology, std::array<int, 3> divisions, std::array<double, 3> lengths,
         std::array<double, 3> origin) {
  BoxOptions options;
  options.topology = topology;
  options.divisions = divisions;
  options.lengths = lengths;
  options.origin = origin;
  options.blockName = topologyName(topology);
  return boxMesh(options);
}

Mesh distorted(Mesh mesh, double amount, unsigned seed) {
  const auto moves = randomNumbers(mesh.coordinates.size(), amount, seed);
  for (std::size_t i = 0; i < moves.size(); ++i) mesh.coordinates[i] += moves[i];
  return mesh;
}

Mesh glued(const std::vector<Mesh>& meshes) {
  Mesh result = meshes.at(0);
  const auto key = [](const double* x) {
    std::array<long long, 3> k{};
    for (int i = 0; i < 3; ++i) k[i] = std::llround(x[i] * 1e9);
    return k;
  };
  std::map<std::array<long long, 3>, int> at;
  for (int n = 0; n < result.numNodes(); ++n) at[key(&result.coordinates[3 * n])] = n;
  for (std::size_t m = 1; m < meshes.size(); ++m) {
    std::vector<int> newNumber;
    for (int n = 0; n < meshes[m].numNodes(); ++n) {
      const double* x = &meshes[m].coordinates[3 * n];
      const auto [place, isNew] = at.emplace(key(x), result.numNodes());
      if (isNew) result.coordinates.insert(result.coordinates.end(), x, x + 3);
      newNumber.push_back(place->second);
    }
    for (Block block : meshes[m].blocks) {
      for (int& n : block.nodes) n = newNumber[n];
      block.id = static_cast<long long>(result.blocks.size()) + 1;
      result.blocks.push_back(std::move(block));
    }
  }
  return result;
}

Mesh mixedMesh() {
  Mesh mesh = glued({box(Topology::Hex8, {3, 2, 3}), box(Topology::Wedge6, {2, 2, 3}, {1, 1, 1}, {1, 0, 0}),
                     box(Topology::Hex20, {3, 1, 1}, {1, 1, 1}, {0, 2, 0}),
                     box(Topology::Wedge15, {2, 1, 1}, {1, 1, 1}, {1, 2, 0}),
                     box(Topology::Tet4, {3, 2, 1}, {1, 1, 1}, {0, 4, 0}),
                     box(Topology::Tet10, {1, 2, 1}, {1, 1, 1}, {0, 6, 0}),
                     box(Topology::Hex27, {1, 2, 1}, {1, 1, 1}, {0, 8, 0})});
  mesh = distorted(std::move(mesh), 0.02);
  for (int i = 0; i < 2; ++i) mesh.coordinates.insert(mesh.coordinates.end(), {9.0, 9.0, 9.0 + i});
  return mesh;
}

std::vector<double> randomNumbers(std::size_t count, double amplitude, unsigned seed) {
  std::mt19937 engine(seed);  // its sequence is fixed by the standard, that of the distributions is not
  std::vector<double> numbers(count);
  for (double& x : numbers) x = amplitude * (2.0 * engine() / 4294967295.0 - 1.0);
  return numbers;
}

std::vector<int> nodesOfSet(const Mesh& mesh, const std::string& name) {
  const int set = findNodeSet(mesh, name);
  if (set < 0) throw std::logic_error("no node set " + name);
  return mesh.nodeSets[set].nodes;
}

const SideSet& sideSet(const Mesh& mesh, const std::string& name) {
  const int set = findSideSet(mesh, name);
  if (set < 0) throw std::logic_error("no side set " + name);
  return mesh.sideSets[set];
}

}  // namespace atrapos::fem::test
