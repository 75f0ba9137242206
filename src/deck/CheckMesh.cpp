#include <fmt/format.h>

#include <map>

#include "atrapos/fem/Mesh.hpp"
#include "deck/Deck.hpp"
#include "deck/DeckValue.hpp"

namespace atrapos::deck {
namespace {

template <class Entry>
std::vector<std::string> labels(const std::vector<Entry>& entries) {
  std::vector<std::string> labels;
  for (const auto& entry : entries) {
    labels.push_back(entry.name.empty() ? std::to_string(entry.id) : entry.name);
  }
  return labels;
}

class MeshCheck {
 public:
  MeshCheck(const Deck& deck, const fem::Mesh& mesh) : deck_(deck), mesh_(mesh) {}

  void nodes(const std::string& path, const std::string& set) const {
    const int nodeSet = fem::findNodeSet(mesh_, set);
    const int sideSet = fem::findSideSet(mesh_, set);
    if (nodeSet < 0 && sideSet < 0) {
      const auto nodeSets = labels(mesh_.nodeSets), sideSets = labels(mesh_.sideSets);
      auto all = nodeSets;
      all.insert(all.end(), sideSets.begin(), sideSets.end());
      fail(path,
           fmt::format("the mesh has no node set or side set '{}'{}; it has the {} and the {}", set,
                       suggestion(set, all), listed("node sets", nodeSets), listed("side sets", sideSets)));
    }
    const bool empty = nodeSet >= 0 ? mesh_.nodeSets[static_cast<std::size_t>(nodeSet)].nodes.empty()
                                    : mesh_.sideSets[static_cast<std::size_t>(sideSet)].sides.empty();
    if (empty) {
      fail(path, fmt::format("the {} set '{}' is empty", nodeSet >= 0 ? "node" : "side", set));
    }
  }

  void sides(const std::string& path, const std::string& set) const {
    const int found = fem::findSideSet(mesh_, set);
    if (found < 0) {
      const auto sideSets = labels(mesh_.sideSets);
      fail(path, fmt::format("the mesh has no side set '{}'{}; it has the {}", set, suggestion(set, sideSets),
                             listed("side sets", sideSets)));
    }
    if (mesh_.sideSets[static_cast<std::size_t>(found)].sides.empty()) {
      fail(path, fmt::format("the side set '{}' is empty", set));
    }
  }

  int block(const std::string& path, const std::string& name) const {
    const int found = fem::findBlock(mesh_, name);
    if (found < 0) {
      const auto blocks = labels(mesh_.blocks);
      fail(path, fmt::format("the mesh has no block '{}'{}; it has the {}", name, suggestion(name, blocks),
                             listed("blocks", blocks)));
    }
    return found;
  }

  void materials() const {
    std::map<int, std::string> materialOf;
    for (const auto& material : deck_.materials) {
      const std::string path = "materials/" + material.name + "/blocks";
      for (const auto& name : material.blocks) {
        const auto [previous, isNew] = materialOf.emplace(block(path, name), material.name);
        if (!isNew) {
          fail(path, fmt::format("block '{}' already has the material '{}'", name, previous->second));
        }
      }
    }
    const auto blocks = labels(mesh_.blocks);
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      if (materialOf.count(static_cast<int>(i)) == 0) {
        fail("materials", fmt::format("the mesh's block '{}' has no material", blocks[i]));
      }
    }
  }

  void load(const Load& load) const {
    const std::string path = "loads/" + load.name;
    if (const auto* nodal = std::get_if<NodalLoad>(&load.load)) {
      nodes(path + "/set", nodal->set);
    } else if (const auto* surface = std::get_if<SurfaceLoad>(&load.load)) {
      sides(path + "/set", surface->set);
    } else {
      for (const auto& name : std::get<VolumeLoad>(load.load).blocks) {
        block(path + "/blocks", name);
      }
    }
  }

 private:
  [[noreturn]] void fail(const std::string& path, const std::string& what) const {
    throw DeckError(fmt::format("{}: {}: {}", deck_.file, path, what));
  }

  static std::string listed(const std::string& kind, const std::vector<std::string>& names) {
    return kind + " " + (names.empty() ? "(none)" : joined(names));
  }

  const Deck& deck_;
  const fem::Mesh& mesh_;
};

}  // namespace

void checkAgainstMesh(const Deck& deck, const fem::Mesh& mesh) {
  const MeshCheck check(deck, mesh);
  check.materials();
  for (const auto& support : deck.supports) {
    check.nodes("supports/" + support.name + "/set", support.set);
  }
  for (const auto& load : deck.loads) {
    check.load(load);
  }
  for (const auto& contact : deck.contacts) {
    const std::string path = "contact/" + contact.name + "/set";
    if (contact.points == Contact::Points::Nodes) {
      check.nodes(path, contact.set);
    } else {
      check.sides(path, contact.set);
    }
  }
  for (const auto& monitor : deck.output.monitors) {
    if (const auto* displacement = std::get_if<DisplacementMonitor>(&monitor.quantity)) {
      check.nodes("output/monitors/" + monitor.name + "/set", displacement->set);
    }
  }
}

}  // namespace atrapos::deck
