#include "atrapos/fem/TrussMesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <stdexcept>
#include <utility>

namespace atrapos::fem {
namespace {

template <class... Args>
[[noreturn]] void fail(fmt::format_string<Args...> text, Args&&... args) {
  throw std::invalid_argument(fmt::format(text, std::forward<Args>(args)...));
}

}  // namespace

Mesh trussMesh(const TrussOptions& options) {
  const int count = static_cast<int>(options.nodes.size());
  const auto within = [&](int node) { return node >= 1 && node <= count; };
  Mesh mesh;
  for (const auto& x : options.nodes) mesh.coordinates.insert(mesh.coordinates.end(), x.begin(), x.end());
  Block block;
  block.name = options.blockName;
  block.id = 1;
  block.topology = Topology::Bar2;
  std::set<std::pair<int, int>> seen;
  std::vector<char> used(options.nodes.size(), 0);
  for (const auto& [a, b] : options.bars) {
    if (!within(a) || !within(b)) fail("bar [{}, {}]: there are nodes 1 to {}", a, b, count);
    if (options.nodes[a - 1] == options.nodes[b - 1]) fail("bar [{}, {}] has no length", a, b);
    if (!seen.insert(std::minmax(a, b)).second) fail("bar [{}, {}] is given twice", a, b);
    for (const int node : {a, b}) {
      block.nodes.push_back(node - 1);
      used[node - 1] = 1;
    }
  }
  if (const auto alone = std::find(used.begin(), used.end(), 0); alone != used.end())
    fail("node {} is at the end of no bar", alone - used.begin() + 1);
  mesh.blocks.push_back(std::move(block));
  long long id = 0;
  for (const TrussOptions::Set& set : options.sets) {
    NodeSet own{set.name, ++id, {}};
    for (const int node : set.nodes) {
      if (!within(node)) fail("set '{}' has node {}: there are nodes 1 to {}", set.name, node, count);
      own.nodes.push_back(node - 1);
    }
    std::sort(own.nodes.begin(), own.nodes.end());
    if (std::adjacent_find(own.nodes.begin(), own.nodes.end()) != own.nodes.end())
      fail("set '{}' has a node twice", set.name);
    mesh.nodeSets.push_back(std::move(own));
  }
  return mesh;
}

}  // namespace atrapos::fem
