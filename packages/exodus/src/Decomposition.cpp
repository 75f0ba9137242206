#include "atrapos/exodus/Decomposition.hpp"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <string>

namespace atrapos::exodus {
namespace {

/// [block] its first element; behind the last one the number of elements.
std::vector<int> firstElements(const fem::Mesh& mesh) {
  std::vector<int> first{0};
  for (const fem::Block& block : mesh.blocks)
    first.push_back(first.back() +
                    static_cast<int>(block.nodes.size()) / fem::nodesPerElement(block.topology));
  return first;
}

void requireUnique(std::vector<long long> ids, const std::string& kind) {
  std::sort(ids.begin(), ids.end());
  const auto twice = std::adjacent_find(ids.begin(), ids.end());
  if (twice != ids.end())
    throw std::invalid_argument("the mesh cannot be cut: two " + kind + "s have the id " +
                                std::to_string(*twice));
}

long long idOf(const std::vector<long long>& ids, int i) { return ids.empty() ? i + 1LL : ids[i]; }

/// Numbers of a part's own for some of the whole's; -1: not in the part.
std::vector<int> localNumbers(const std::vector<int>& own, int count) {
  std::vector<int> local(static_cast<std::size_t>(count), -1);
  for (std::size_t i = 0; i < own.size(); ++i) local[own[i]] = static_cast<int>(i);
  return local;
}

}  // namespace

Decomposition::Decomposition(const fem::Mesh& mesh, const std::vector<int>& partOfElement, int parts)
    : mesh_(mesh), nodes_(std::max(parts, 0)), elements_(std::max(parts, 0)) {
  const auto first = firstElements(mesh);
  if (parts < 1 || partOfElement.size() != static_cast<std::size_t>(first.back()) ||
      std::any_of(partOfElement.begin(), partOfElement.end(), [&](int p) { return p < 0 || p >= parts; }))
    throw std::invalid_argument("Decomposition: needs the part of every element, within the number of parts");
  requireUnique(mesh.nodeIds, "node");
  requireUnique(mesh.elementIds, "element");
  for (std::size_t e = 0; e < partOfElement.size(); ++e)
    elements_[partOfElement[e]].push_back(static_cast<int>(e));

  std::vector<int> lastPart(static_cast<std::size_t>(mesh.numNodes()), -1), count(lastPart.size(), 0);
  for (int p = 0; p < parts; ++p) {
    std::size_t b = 0;
    for (const int e : elements_[p]) {
      while (e >= first[b + 1]) ++b;
      const fem::Block& block = mesh.blocks[b];
      const int N = fem::nodesPerElement(block.topology);
      const int* own = &block.nodes[static_cast<std::size_t>(e - first[b]) * N];
      for (int n = 0; n < N; ++n) {
        if (lastPart[own[n]] == p) continue;
        lastPart[own[n]] = p;
        ++count[own[n]];
        nodes_[p].push_back(own[n]);
      }
    }
  }
  for (std::size_t n = 0; n < count.size(); ++n)
    if (count[n] == 0) nodes_[0].push_back(static_cast<int>(n));
  for (auto& list : nodes_) std::sort(list.begin(), list.end());

  sharersStart_.push_back(0);
  for (const int c : count) sharersStart_.push_back(sharersStart_.back() + (c > 1 ? c : 0));
  sharers_.resize(sharersStart_.back());
  std::vector<int> filled(sharersStart_.begin(), sharersStart_.end() - 1);
  for (int p = 0; p < parts; ++p)
    for (const int n : nodes_[p])
      if (count[n] > 1) sharers_[filled[n]++] = p;

  whole_.nodes = mesh.numNodes();
  whole_.elements = mesh.numElements();
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) whole_.blocks.push_back(first[b + 1] - first[b]);
  for (const fem::NodeSet& set : mesh.nodeSets) {
    whole_.nodeSets.push_back(static_cast<long long>(set.nodes.size()));
    whole_.nodeSetFactors.push_back(static_cast<long long>(set.factors.size()));
  }
  for (const fem::SideSet& set : mesh.sideSets)
    whole_.sideSets.push_back(static_cast<long long>(set.sides.size()));
}

MeshPart Decomposition::part(int p) const {
  const std::vector<int>&nodes = nodes_[p], &elements = elements_[p];
  const auto localNode = localNumbers(nodes, mesh_.numNodes());
  const auto first = firstElements(mesh_);
  const auto localElement = localNumbers(elements, first.back());
  MeshPart part;
  part.part = p;
  part.parts = parts();
  part.whole = whole_;
  fem::Mesh& own = part.mesh;
  own.title = mesh_.title;
  own.dimension = mesh_.dimension;
  for (const int n : nodes) {
    const double* x = &mesh_.coordinates[3 * static_cast<std::size_t>(n)];
    own.coordinates.insert(own.coordinates.end(), x, x + 3);
    own.nodeIds.push_back(idOf(mesh_.nodeIds, n));
  }
  for (const int e : elements) own.elementIds.push_back(idOf(mesh_.elementIds, e));

  auto next = elements.begin();
  for (std::size_t b = 0; b < mesh_.blocks.size(); ++b) {
    const fem::Block& block = mesh_.blocks[b];
    fem::Block& mine = own.blocks.emplace_back();
    mine.name = block.name;
    mine.id = block.id;
    mine.topology = block.topology;
    mine.attributeNames = block.attributeNames;
    const std::size_t N = fem::nodesPerElement(block.topology), A = block.attributeNames.size();
    for (; next != elements.end() && *next < first[b + 1]; ++next) {
      const std::size_t e = *next - first[b];
      for (std::size_t n = 0; n < N; ++n) mine.nodes.push_back(localNode[block.nodes[e * N + n]]);
      for (std::size_t a = 0; a < A; ++a) mine.attributes.push_back(block.attributes[e * A + a]);
    }
  }
  for (const fem::NodeSet& set : mesh_.nodeSets) {
    fem::NodeSet& mine = own.nodeSets.emplace_back();
    mine.name = set.name;
    mine.id = set.id;
    for (std::size_t i = 0; i < set.nodes.size(); ++i) {
      if (localNode[set.nodes[i]] < 0) continue;
      mine.nodes.push_back(localNode[set.nodes[i]]);
      if (!set.factors.empty()) mine.factors.push_back(set.factors[i]);
    }
  }
  for (const fem::SideSet& set : mesh_.sideSets) {
    fem::SideSet& mine = own.sideSets.emplace_back();
    mine.name = set.name;
    mine.id = set.id;
    for (const fem::Side& side : set.sides)
      if (localElement[side.element] >= 0) mine.sides.push_back({localElement[side.element], side.side});
  }

  std::vector<std::vector<int>> with(parts());
  for (std::size_t l = 0; l < nodes.size(); ++l)
    for (int s = sharersStart_[nodes[l]]; s < sharersStart_[nodes[l] + 1]; ++s)
      if (sharers_[s] != p) with[sharers_[s]].push_back(static_cast<int>(l));
  for (int other = 0; other < parts(); ++other) {
    if (with[other].empty()) continue;
    std::sort(with[other].begin(), with[other].end(),
              [&](int a, int b) { return own.nodeIds[a] < own.nodeIds[b]; });
    part.borders.push_back({other, std::move(with[other])});
  }
  return part;
}

}  // namespace atrapos::exodus
