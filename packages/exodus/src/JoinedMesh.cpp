#include "atrapos/exodus/JoinedMesh.hpp"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include "atrapos/exodus/Error.hpp"

namespace atrapos::exodus {
namespace {

/// A node or element of a part, sorted by its id, then by part.
struct Entry {
  long long id;
  int part, local;
  bool operator<(const Entry& other) const {
    return std::tie(id, part, local) < std::tie(other.id, other.part, other.local);
  }
};

class Joiner {
 public:
  Joiner(const std::vector<MeshPart>& parts, const std::string& file) : parts_(parts), file_(file) {}

  JoinedMesh operator()() {
    checkAlike();
    joined_.mesh.title = parts_.front().mesh.title;
    joinNodes();
    joinBlocks();
    joinNodeSets();
    joinSideSets();
    checkBorders();
    dropTrivial(joined_.mesh.nodeIds);
    dropTrivial(joined_.mesh.elementIds);
    auto& blocks = joined_.mesh.blocks;
    blocks.erase(std::remove_if(blocks.begin(), blocks.end(),
                                [](const fem::Block& block) { return block.nodes.empty(); }),
                 blocks.end());
    return std::move(joined_);
  }

 private:
  void require(bool condition, const std::string& message) const {
    if (!condition) throw Error(file_ + ": " + message);
  }

  static std::string partText(int part) { return "part " + std::to_string(part); }

  /// Blocks or sets, which all parts must have in the same order.
  template <class Items>
  void checkIds(const Items& first, const Items& own, int part, const std::string& kind) const {
    const bool same =
        first.size() == own.size() && std::equal(first.begin(), first.end(), own.begin(),
                                                 [](const auto& a, const auto& b) { return a.id == b.id; });
    require(same, partText(part) + " has not the same " + kind + " as part 0");
  }

  void checkAlike() const {
    require(!parts_.empty(), "no parts to join");
    const MeshPart& first = parts_.front();
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      const MeshPart& p = parts_[i];
      require(p.part == static_cast<int>(i) && p.parts == static_cast<int>(parts_.size()),
              "part " + std::to_string(p.part) + " of " + std::to_string(p.parts) + " stands where part " +
                  std::to_string(i) + " of " + std::to_string(parts_.size()) + " is needed");
      checkIds(first.mesh.blocks, p.mesh.blocks, p.part, "blocks");
      checkIds(first.mesh.nodeSets, p.mesh.nodeSets, p.part, "node sets");
      checkIds(first.mesh.sideSets, p.mesh.sideSets, p.part, "side sets");
      require(p.mesh.dimension == first.mesh.dimension,
              partText(p.part) + " has another number of dimensions than part 0");
      require(p.whole.nodes == first.whole.nodes && p.whole.elements == first.whole.elements,
              partText(p.part) + " is of a mesh with " + std::to_string(p.whole.nodes) + " nodes and " +
                  std::to_string(p.whole.elements) + " elements, part 0 of one with " +
                  std::to_string(first.whole.nodes) + " and " + std::to_string(first.whole.elements));
    }
  }

  void joinNodes() {
    std::vector<Entry> entries;
    for (const MeshPart& p : parts_) {
      joined_.nodes.emplace_back(p.mesh.numNodes());
      for (int n = 0; n < p.mesh.numNodes(); ++n) entries.push_back({p.mesh.nodeIds[n], p.part, n});
    }
    std::sort(entries.begin(), entries.end());
    fem::Mesh& mesh = joined_.mesh;
    mesh.dimension = parts_.front().mesh.dimension;
    for (std::size_t i = 0; i < entries.size(); ++i) {
      const Entry& e = entries[i];
      const double* x = &parts_[e.part].mesh.coordinates[3 * static_cast<std::size_t>(e.local)];
      if (i == 0 || e.id != entries[i - 1].id) {
        mesh.nodeIds.push_back(e.id);
        mesh.coordinates.insert(mesh.coordinates.end(), x, x + 3);
      } else {
        require(e.part != entries[i - 1].part,
                partText(e.part) + " has two nodes with the id " + std::to_string(e.id));
        require(std::equal(x, x + 3, mesh.coordinates.end() - 3),
                "node " + std::to_string(e.id) + " stands at one place in part " +
                    std::to_string(entries[i - 1].part) + " and at another one in part " +
                    std::to_string(e.part));
      }
      joined_.nodes[e.part][e.local] = mesh.numNodes() - 1;
    }
    checkCount(mesh.numNodes(), parts_.front().whole.nodes, "nodes");
  }

  void checkCount(long long found, long long announced, const std::string& kind) const {
    require(found == announced, "the parts have " + std::to_string(found) + " " + kind +
                                    " together, the files announce " + std::to_string(announced));
  }

  void joinBlocks() {
    for (const MeshPart& p : parts_) joined_.elements.emplace_back(p.mesh.numElements());
    std::vector<int> firstOfPart(parts_.size(), 0);
    std::vector<Entry> all;
    int count = 0;
    for (std::size_t b = 0; b < parts_.front().mesh.blocks.size(); ++b) {
      fem::Block& block = joined_.mesh.blocks.emplace_back(header(b));
      const std::size_t N = fem::nodesPerElement(block.topology), A = block.attributeNames.size();
      std::vector<Entry> entries;
      for (const MeshPart& p : parts_) {
        const int elements = static_cast<int>(p.mesh.blocks[b].nodes.size() / N);
        for (int e = 0; e < elements; ++e)
          entries.push_back({p.mesh.elementIds[firstOfPart[p.part] + e], p.part, e});
      }
      std::sort(entries.begin(), entries.end());
      for (const Entry& e : entries) {
        const fem::Block& own = parts_[e.part].mesh.blocks[b];
        for (std::size_t n = 0; n < N; ++n)
          block.nodes.push_back(joined_.nodes[e.part][own.nodes[e.local * N + n]]);
        for (std::size_t a = 0; a < A; ++a) block.attributes.push_back(own.attributes[e.local * A + a]);
        joined_.elements[e.part][firstOfPart[e.part] + e.local] = count++;
        joined_.partOfElement.push_back(e.part);
        joined_.mesh.elementIds.push_back(e.id);
      }
      all.insert(all.end(), entries.begin(), entries.end());
      for (const MeshPart& p : parts_)
        firstOfPart[p.part] += static_cast<int>(p.mesh.blocks[b].nodes.size() / N);
    }
    std::sort(all.begin(), all.end());
    for (std::size_t i = 1; i < all.size(); ++i)
      require(all[i].id != all[i - 1].id, "element " + std::to_string(all[i].id) + " is in part " +
                                              std::to_string(all[i - 1].part) + " and again in part " +
                                              std::to_string(all[i].part));
    checkCount(count, parts_.front().whole.elements, "elements");
  }

  /// The block without its elements, as the parts that have some know it.
  fem::Block header(std::size_t b) const {
    const MeshPart* known = nullptr;
    for (const MeshPart& p : parts_) {
      const fem::Block& own = p.mesh.blocks[b];
      if (own.nodes.empty()) continue;
      if (!known) known = &p;
      const fem::Block& first = known->mesh.blocks[b];
      require(own.topology == first.topology && own.attributeNames == first.attributeNames,
              "block " + std::to_string(own.id) + " has other elements or attributes in part " +
                  std::to_string(p.part) + " than in part " + std::to_string(known->part));
    }
    fem::Block block = (known ? *known : parts_.front()).mesh.blocks[b];
    block.nodes.clear();
    block.attributes.clear();
    return block;
  }

  void joinNodeSets() {
    for (std::size_t s = 0; s < parts_.front().mesh.nodeSets.size(); ++s) {
      std::map<int, double> factorOf;  // a node that several parts have counts once
      bool hasFactors = false;
      for (const MeshPart& p : parts_) {
        const fem::NodeSet& own = p.mesh.nodeSets[s];
        hasFactors = hasFactors || !own.factors.empty();
        for (std::size_t i = 0; i < own.nodes.size(); ++i)
          factorOf.emplace(joined_.nodes[p.part][own.nodes[i]], own.factors.empty() ? 1.0 : own.factors[i]);
      }
      const fem::NodeSet& first = parts_.front().mesh.nodeSets[s];
      fem::NodeSet& set = joined_.mesh.nodeSets.emplace_back();
      set.name = first.name;
      set.id = first.id;
      for (const auto& [node, factor] : factorOf) {
        set.nodes.push_back(node);
        if (hasFactors) set.factors.push_back(factor);
      }
    }
  }

  void joinSideSets() {
    for (std::size_t s = 0; s < parts_.front().mesh.sideSets.size(); ++s) {
      const fem::SideSet& first = parts_.front().mesh.sideSets[s];
      fem::SideSet& set = joined_.mesh.sideSets.emplace_back();
      set.name = first.name;
      set.id = first.id;
      for (const MeshPart& p : parts_)
        for (const fem::Side& side : p.mesh.sideSets[s].sides)
          set.sides.push_back({joined_.elements[p.part][side.element], side.side});
      std::sort(set.sides.begin(), set.sides.end(), [](const fem::Side& a, const fem::Side& b) {
        return std::tie(a.element, a.side) < std::tie(b.element, b.side);
      });
    }
  }

  void checkBorders() const {
    std::map<std::pair<int, int>, std::vector<int>> nodesAt;  // this part, the other one
    for (const MeshPart& p : parts_)
      for (const PartBorder& border : p.borders) {
        require(border.part >= 0 && border.part < static_cast<int>(parts_.size()) && border.part != p.part,
                partText(p.part) + " has a communication map with part " + std::to_string(border.part));
        auto& nodes = nodesAt[{p.part, border.part}];
        for (const int n : border.nodes) nodes.push_back(joined_.nodes[p.part][n]);
        std::sort(nodes.begin(), nodes.end());
      }
    for (const auto& [pair, nodes] : nodesAt) {
      const auto back = nodesAt.find({pair.second, pair.first});
      require(back != nodesAt.end() && back->second == nodes,
              "the communication maps of parts " + std::to_string(pair.first) + " and " +
                  std::to_string(pair.second) + " do not name the same nodes");
    }
  }

  static void dropTrivial(std::vector<long long>& ids) {
    for (std::size_t i = 0; i < ids.size(); ++i)
      if (ids[i] != static_cast<long long>(i) + 1) return;
    ids.clear();
  }

  const std::vector<MeshPart>& parts_;
  const std::string& file_;
  JoinedMesh joined_;
};

}  // namespace

JoinedMesh join(const std::vector<MeshPart>& parts, const std::string& file) { return Joiner(parts, file)(); }

}  // namespace atrapos::exodus
