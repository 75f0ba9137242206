#include "import/InpMesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <set>
#include <tuple>
#include <utility>

#include "deck/Characters.hpp"
#include "import/Import.hpp"

namespace atrapos::importer {
namespace {

/// What elements of a block have in common.
using BlockKey = std::tuple<int, int, fem::Topology, Family, std::uint64_t>;  // section, set, cell, ..., cuts

std::string sectionName(const InpModel& model, int section, int set) {
  if (section >= 0) return model.sections[static_cast<std::size_t>(section)].set;
  return set >= 0 ? model.elementSets.all()[static_cast<std::size_t>(set)].first : "elements";
}

/// Plane elements alone, of one kind, or none.
void requireOneFamily(const InpModel& model) {
  const InpElementType* first = model.elements.front().type;
  const auto plane = [](const InpElementType& type) {
    return fem::isPlane(type.topology) ? type.family : Family::solid;
  };
  for (std::size_t e = 0; e < model.elements.size(); ++e)
    if (const InpElementType* type = model.elements[e].type; plane(*type) != plane(*first))
      throw Error(fmt::format(
          "{}: elements {} and {} are {} and {}; expected plane stress, plane strain, axisymmetric "
          "elements or those in space alone",
          *model.file, model.elementIds.front(), model.elementIds[e], first->name, type->name));
}

}  // namespace

InpMesh::InpMesh(InpModel& model, const std::vector<std::vector<int>>& cuts, const std::vector<int>& more) {
  if (model.elements.empty())
    throw Error(fmt::format("{}: has no element that this program knows; known are {}", *model.file,
                            inpElementNames()));
  requireOneFamily(model);
  mesh.title = deck::beginOf(deck::plainLine(model.title), 80);  // what Exodus holds
  mesh.dimension = fem::isPlane(model.elements.front().type->topology) ? 2 : 3;
  takeNodes(model, more);
  takeElements(model, cuts);
  takeSets(model);
}

void InpMesh::takeNodes(InpModel& model, const std::vector<int>& more) {
  nodeAt.assign(model.nodeIds.size(), -1);
  for (const int node : more) nodeAt[static_cast<std::size_t>(node)] = 0;
  for (const int node : model.connectivity) nodeAt[static_cast<std::size_t>(node)] = 0;
  std::size_t dropped = 0;
  for (std::size_t n = 0; n < nodeAt.size(); ++n) {
    if (nodeAt[n] < 0) {
      ++dropped;
      continue;
    }
    nodeAt[n] = mesh.numNodes();
    const double* const x = &model.coordinates[3 * n];
    if (mesh.dimension == 2 && x[2] != 0)
      throw Error(fmt::format("{}: node {} of a plane element has z = {}; expected 0", *model.file,
                              model.nodeIds[n], x[2]));
    mesh.coordinates.insert(mesh.coordinates.end(), x, x + 3);
    mesh.nodeIds.push_back(model.nodeIds[n]);
  }
  if (dropped > 0)
    model.remark(fmt::format("{}: {} node{} left out that no element of the mesh has", *model.file, dropped,
                             dropped > 1 ? "s" : ""));
}

void InpMesh::takeElements(InpModel& model, const std::vector<std::vector<int>>& cuts) {
  std::vector<std::uint64_t> within(model.elements.size());  // which cuts
  for (std::size_t c = 0; c < cuts.size(); ++c)
    for (const int e : cuts[c]) within[static_cast<std::size_t>(e)] |= std::uint64_t{1} << c;
  std::map<BlockKey, std::size_t> blockOf;
  std::vector<std::vector<int>> members;
  blockAt.resize(model.elements.size());
  for (std::size_t e = 0; e < model.elements.size(); ++e) {
    const InpElement& element = model.elements[e];
    const int set = element.section >= 0 ? -1 : element.set;
    const auto [at, isNew] = blockOf.emplace(
        BlockKey{element.section, set, element.type->topology, element.type->family, within[e]},
        members.size());
    if (isNew) {
      fem::Block& block = mesh.blocks.emplace_back();
      const std::string name = sectionName(model, element.section, set);
      block.name = blockNames_.take(blockNames_.isTaken(plainName(name))
                                        ? name + "_" + fem::topologyName(element.type->topology)
                                        : name);
      block.id = static_cast<long long>(mesh.blocks.size());
      block.topology = element.type->topology;
      members.emplace_back();
    }
    blockAt[e] = static_cast<int>(at->second);
    members[at->second].push_back(static_cast<int>(e));
  }
  elementAt.resize(model.elements.size());
  for (std::size_t b = 0; b < members.size(); ++b) {
    fem::Block& block = mesh.blocks[b];
    const auto& order = inpNodeOrder(block.topology);
    const InpElement& first = model.elements[static_cast<std::size_t>(members[b].front())];
    const double thickness =
        first.section >= 0 ? model.sections[static_cast<std::size_t>(first.section)].thickness : 0;
    if (first.type->family == Family::shell && thickness > 0) {
      block.attributeNames = {"THICKNESS"};
      block.attributes.assign(members[b].size(), thickness);
    }
    for (const int e : members[b]) {
      elementAt[static_cast<std::size_t>(e)] = static_cast<int>(mesh.elementIds.size());
      mesh.elementIds.push_back(model.elementIds[static_cast<std::size_t>(e)]);
      const std::size_t start = model.elements[static_cast<std::size_t>(e)].firstNode;
      const int count = fem::nodesPerElement(block.topology);
      for (int n = 0; n < count; ++n) {
        const int node =
            model.connectivity[start + static_cast<std::size_t>(order[static_cast<std::size_t>(n)])];
        block.nodes.push_back(nodeAt[static_cast<std::size_t>(node)]);
      }
    }
  }
}

void InpMesh::takeSets(InpModel& model) {
  const auto tellEmpty = [&](const char* kind, const std::string& name) {
    model.remark(
        fmt::format("{}: {} '{}': left out, the mesh has nothing of it", *model.file, kind, plainName(name)));
  };
  for (const auto& [name, nodes] : model.nodeSets.all()) {
    const auto kept = nodesOf(nodes);
    if (kept.empty())
      tellEmpty("node set", name);
    else
      nodeSets_.emplace(kept, addNodeSet(kept, name));
  }
  for (const auto& [name, faces] : model.surfaces.all()) {
    const auto sides = sidesOf(faces);
    if (sides.empty())
      tellEmpty("surface", name);
    else
      sideSets_.emplace(sides, addSideSet(sides, name));
  }
  const auto& all = model.elementSets.all();
  for (std::size_t s = 0; s < all.size(); ++s) {
    const auto& elements = all[s].second;
    std::size_t size = 0;
    std::set<int> within;
    for (const int e : elements) within.insert(blockAt[static_cast<std::size_t>(e)]);
    for (const int b : within) {
      const fem::Block& block = mesh.blocks[static_cast<std::size_t>(b)];
      size += block.nodes.size() / static_cast<std::size_t>(fem::nodesPerElement(block.topology));
    }
    if (size != elements.size() || !blockNames_.isTaken(plainName(all[s].first)))
      model.remark(
          model.elementSetPlaces[s],
          fmt::format("element set '{}': left out, blocks are those of sections", plainName(all[s].first)));
  }
}

std::vector<int> InpMesh::nodesOf(const std::vector<int>& nodes) const {
  std::vector<int> kept;
  for (const int node : nodes)
    if (const int at = nodeAt[static_cast<std::size_t>(node)]; at >= 0) kept.push_back(at);
  return kept;
}

std::vector<std::pair<int, int>> InpMesh::sidesOf(const std::vector<InpFace>& faces) const {
  std::vector<std::pair<int, int>> sides;
  for (const InpFace& face : faces)
    sides.emplace_back(elementAt[static_cast<std::size_t>(face.element)], face.side);
  std::sort(sides.begin(), sides.end());
  return sides;
}

std::string InpMesh::addNodeSet(const std::vector<int>& nodes, const std::string& wanted) {
  const auto id = static_cast<long long>(mesh.nodeSets.size()) + 1;
  mesh.nodeSets.push_back({nodeSetNames_.take(wanted), id, nodes});
  return mesh.nodeSets.back().name;
}

std::string InpMesh::addSideSet(const std::vector<std::pair<int, int>>& sides, const std::string& wanted) {
  fem::SideSet set{sideSetNames_.take(wanted), static_cast<long long>(mesh.sideSets.size()) + 1, {}};
  for (const auto& [element, side] : sides) set.sides.push_back({element, side});
  mesh.sideSets.push_back(std::move(set));
  return mesh.sideSets.back().name;
}

std::string InpMesh::nodeSet(const std::vector<int>& nodes, const std::string& wanted) {
  const auto kept = nodesOf(nodes);
  if (kept.empty()) return {};
  if (const auto at = nodeSets_.find(kept); at != nodeSets_.end()) return at->second;
  return nodeSets_[kept] = addNodeSet(kept, wanted);
}

std::string InpMesh::sideSet(const std::vector<InpFace>& faces, const std::string& wanted) {
  const auto sides = sidesOf(faces);
  if (const auto at = sideSets_.find(sides); at != sideSets_.end()) return at->second;
  return sideSets_[sides] = addSideSet(sides, wanted);
}

std::vector<std::string> InpMesh::blocks(const std::vector<int>& elements) const {
  std::set<int> within;
  for (const int e : elements) within.insert(blockAt[static_cast<std::size_t>(e)]);
  std::vector<std::string> names;
  for (const int b : within) names.push_back(mesh.blocks[static_cast<std::size_t>(b)].name);
  return names;
}

}  // namespace atrapos::importer
