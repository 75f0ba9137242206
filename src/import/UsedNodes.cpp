#include "import/UsedNodes.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace atrapos::importer {
namespace {

fem::NodeSet renumbered(const fem::NodeSet& set, const std::vector<int>& newNode) {
  fem::NodeSet kept{set.name, set.id, {}, {}};
  for (std::size_t i = 0; i < set.nodes.size(); ++i) {
    const int node = newNode[static_cast<std::size_t>(set.nodes[i])];
    if (node < 0) continue;
    kept.nodes.push_back(node);
    if (!set.factors.empty()) kept.factors.push_back(set.factors[i]);
  }
  return kept;
}

}  // namespace

int dropUnusedNodes(fem::Mesh& mesh) {
  const auto count = static_cast<std::size_t>(mesh.numNodes());
  std::vector<int> newNode(count, -1);
  for (const fem::Block& block : mesh.blocks)
    for (const int node : block.nodes) newNode[static_cast<std::size_t>(node)] = 0;
  int used = 0;
  for (int& node : newNode)
    if (node == 0) node = used++;
  if (used == mesh.numNodes()) return 0;
  fem::Mesh old = mesh;
  mesh.coordinates.clear();
  mesh.nodeIds.clear();
  for (std::size_t n = 0; n < count; ++n) {
    if (newNode[n] < 0) continue;
    mesh.coordinates.insert(mesh.coordinates.end(), &old.coordinates[3 * n], &old.coordinates[3 * n] + 3);
    mesh.nodeIds.push_back(old.nodeIds.empty() ? static_cast<long long>(n) + 1 : old.nodeIds[n]);
  }
  for (fem::Block& block : mesh.blocks)
    for (int& node : block.nodes) node = newNode[static_cast<std::size_t>(node)];
  mesh.nodeSets.clear();
  for (const fem::NodeSet& set : old.nodeSets) {
    fem::NodeSet kept = renumbered(set, newNode);
    if (!kept.nodes.empty() || set.nodes.empty()) mesh.nodeSets.push_back(std::move(kept));
  }
  return static_cast<int>(count) - used;
}

}  // namespace atrapos::importer
