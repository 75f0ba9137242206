#include "PartRecords.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <string>

namespace atrapos::exodus {
namespace {

using Numbers = std::vector<int64_t>;

/// Numbers from 1 of those that are inside a part and of those on its border.
struct Inside {
  Numbers inner, border;

  explicit Inside(const std::vector<char>& onBorder) {
    for (std::size_t i = 0; i < onBorder.size(); ++i)
      (onBorder[i] != 0 ? border : inner).push_back(static_cast<int64_t>(i) + 1);
  }
};

std::vector<char> borderNodes(const MeshPart& part) {
  std::vector<char> on(part.mesh.numNodes(), 0);
  for (const PartBorder& border : part.borders)
    for (const int n : border.nodes) on[n] = 1;
  return on;
}

/// Elements with a node on the border.
std::vector<char> borderElements(const MeshPart& part, const std::vector<char>& nodes) {
  std::vector<char> on;
  for (const fem::Block& block : part.mesh.blocks) {
    const int N = fem::nodesPerElement(block.topology);
    for (auto n = block.nodes.begin(); n != block.nodes.end(); n += N)
      on.push_back(std::any_of(n, n + N, [&](int node) { return nodes[node] != 0; }) ? 1 : 0);
  }
  return on;
}

template <class Items>
Numbers idsOf(const Items& items) {
  Numbers ids;
  for (const auto& item : items) ids.push_back(item.id);
  return ids;
}

Numbers copied(const std::vector<long long>& numbers) { return {numbers.begin(), numbers.end()}; }

}  // namespace

void definePart(const File& file, const MeshPart& part) {
  const std::string doing = "writing the sizes of the whole mesh";
  const fem::Mesh& mesh = part.mesh;
  std::array<char, 2> kind{'p', '\0'};  // a file for each part
  file.check(ex_put_init_info(file.id(), part.parts, 1, kind.data()), doing);
  file.check(ex_put_init_global(
                 file.id(), part.whole.nodes, part.whole.elements, static_cast<int64_t>(mesh.blocks.size()),
                 static_cast<int64_t>(mesh.nodeSets.size()), static_cast<int64_t>(mesh.sideSets.size())),
             doing);
  Numbers ids = idsOf(mesh.blocks), counts = copied(part.whole.blocks);
  if (!ids.empty()) file.check(ex_put_eb_info_global(file.id(), ids.data(), counts.data()), doing);
  ids = idsOf(mesh.nodeSets);
  counts = copied(part.whole.nodeSets);
  Numbers factors = copied(part.whole.nodeSetFactors);
  if (!ids.empty())
    file.check(ex_put_ns_param_global(file.id(), ids.data(), counts.data(), factors.data()), doing);
  ids = idsOf(mesh.sideSets);
  counts = copied(part.whole.sideSets);
  factors.assign(ids.size(), 0);
  if (!ids.empty())
    file.check(ex_put_ss_param_global(file.id(), ids.data(), counts.data(), factors.data()), doing);

  const auto onBorder = borderNodes(part);
  const Inside nodes(onBorder), elements(borderElements(part, onBorder));
  const auto size = [](const auto& list) { return static_cast<int64_t>(list.size()); };
  file.check(ex_put_loadbal_param(file.id(), size(nodes.inner), size(nodes.border), 0, size(elements.inner),
                                  size(elements.border), size(part.borders), 0, part.part),
             "defining the maps of the part");
  if (part.borders.empty()) return;
  Numbers maps, lengths;
  for (const PartBorder& border : part.borders) {
    maps.push_back(border.part + int64_t{1});  // ids from 1
    lengths.push_back(size(border.nodes));
  }
  file.check(ex_put_cmap_params(file.id(), maps.data(), lengths.data(), nullptr, nullptr, part.part),
             "defining the communication maps");
}

void writePartMaps(const File& file, const MeshPart& part) {
  const std::string doing = "writing the maps of the part";
  const auto onBorder = borderNodes(part);
  Inside nodes(onBorder), elements(borderElements(part, onBorder));
  Numbers none;
  file.check(
      ex_put_processor_node_maps(file.id(), nodes.inner.data(), nodes.border.data(), none.data(), part.part),
      doing);
  file.check(ex_put_processor_elem_maps(file.id(), elements.inner.data(), elements.border.data(), part.part),
             doing);
  for (const PartBorder& border : part.borders) {
    Numbers own, other(border.nodes.size(), border.part);
    for (const int n : border.nodes) own.push_back(n + int64_t{1});
    file.check(ex_put_node_cmap(file.id(), border.part + int64_t{1}, own.data(), other.data(), part.part),
               "writing the communication maps");
  }
}

void readPartRecords(const File& file, MeshPart& part) {
  int parts = 0, inFile = 0;
  std::array<char, MAX_STR_LENGTH + 1> kind{};
  const bool known = ex_get_init_info(file.id(), &parts, &inFile, kind.data()) >= 0;
  if (!known || kind[0] != 'p')
    throw Error(file.name() + ": is not a part of a decomposed mesh: it has no record of its parts");
  if (parts != part.parts || inFile != 1)
    throw Error(file.name() + ": holds " + std::to_string(inFile) + " of " + std::to_string(parts) +
                " parts; its name says one of " + std::to_string(part.parts));
  const std::string doing = "reading the sizes of the whole mesh";
  int64_t nodes = 0, elements = 0, blocks = 0, nodeSets = 0, sideSets = 0;
  file.check(ex_get_init_global(file.id(), &nodes, &elements, &blocks, &nodeSets, &sideSets), doing);
  const fem::Mesh& mesh = part.mesh;
  if (blocks != static_cast<int64_t>(mesh.blocks.size()) ||
      nodeSets != static_cast<int64_t>(mesh.nodeSets.size()) ||
      sideSets != static_cast<int64_t>(mesh.sideSets.size()))
    throw Error(file.name() + ": has not all blocks and sets of the whole mesh; empty ones are needed too");
  part.whole.nodes = nodes;
  part.whole.elements = elements;

  const std::string readingMaps = "reading the communication maps";
  int64_t inner = 0, border = 0, external = 0, innerElements = 0, borderElements = 0, maps = 0, faceMaps = 0;
  file.check(ex_get_loadbal_param(file.id(), &inner, &border, &external, &innerElements, &borderElements,
                                  &maps, &faceMaps, part.part),
             readingMaps);
  if (maps <= 0) return;
  Numbers ids(maps), lengths(maps), faceIds(std::max<int64_t>(faceMaps, 0)), faceLengths(faceIds.size());
  file.check(ex_get_cmap_params(file.id(), ids.data(), lengths.data(), faceIds.data(), faceLengths.data(),
                                part.part),
             readingMaps);
  // A map may be that of one other part, or of all.
  std::map<int, std::vector<int>> nodesWith;
  for (std::size_t m = 0; m < ids.size(); ++m) {
    if (lengths[m] < 0 || lengths[m] > int64_t{part.parts} * mesh.numNodes())
      throw Error(file.name() + ": communication map " + std::to_string(ids[m]) + " is too long");
    Numbers own(lengths[m]), other(lengths[m]);
    if (own.empty()) continue;
    file.check(ex_get_node_cmap(file.id(), ids[m], own.data(), other.data(), part.part), readingMaps);
    for (std::size_t i = 0; i < own.size(); ++i) {
      if (own[i] < 1 || own[i] > mesh.numNodes() || other[i] < 0 || other[i] >= part.parts)
        throw Error(file.name() + ": communication map " + std::to_string(ids[m]) + " has node " +
                    std::to_string(own[i]) + " of part " + std::to_string(other[i]) + "; there are " +
                    std::to_string(mesh.numNodes()) + " nodes and " + std::to_string(part.parts) + " parts");
      nodesWith[static_cast<int>(other[i])].push_back(static_cast<int>(own[i] - 1));
    }
  }
  for (auto& [other, list] : nodesWith) {
    std::sort(list.begin(), list.end(), [&](int a, int b) { return mesh.nodeIds[a] < mesh.nodeIds[b]; });
    list.erase(std::unique(list.begin(), list.end()), list.end());
    part.borders.push_back({other, std::move(list)});
  }
}

}  // namespace atrapos::exodus
