#include "gmsh/ReadGmsh.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <gmsh.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <unordered_map>
#include <utility>

#include "atrapos/fem/ReferenceCell.hpp"
#include "deck/Characters.hpp"
#include "import/Names.hpp"

namespace atrapos::importer {
namespace {

using fem::Topology;

/// An open file under a name that no file of options can stand beside: libgmsh would run those.
class OpenFile {
 public:
  explicit OpenFile(const std::string& file)
      : descriptor_(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {
    if (descriptor_ < 0) throw Error(file + ": cannot be read");
    std::array<char, 64> start{};
    const auto n = ::pread(descriptor_, start.data(), start.size() - 1, 0);
    const std::string text(start.data(), n > 0 ? static_cast<std::size_t>(n) : 0);
    static const std::string begin = "$MeshFormat";
    const std::size_t version = text.find_first_not_of("\r\n", begin.size());
    if (text.compare(0, begin.size(), begin) != 0 || version == begin.size() || version == std::string::npos)
      throw Error(file + ": is no mesh of Gmsh; expected $MeshFormat in the first line");
    const std::string number = text.substr(version, text.find_first_of(" \r\n", version) - version);
    if (number != "2.2" && number != "4.1")
      throw Error(fmt::format("{}: is of Gmsh's format '{}'; expected 2.2 or 4.1 (gmsh -format msh41)", file,
                              deck::shortened(number)));
  }
  ~OpenFile() { close(descriptor_); }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  std::string name() const { return fmt::format("/proc/self/fd/{}", descriptor_); }

 private:
  int descriptor_;
};

/// libgmsh from its start to its end.
class Session {
 public:
  Session() {
    gmsh::initialize(0, nullptr, false);
    gmsh::option::setNumber("General.Terminal", 0);
  }
  ~Session() {
    try {
      gmsh::finalize();
    } catch (...) {  // the file has been read, or refused, by then
    }
  }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;
};

std::optional<Topology> topologyOf(int dimension, int nodes, bool shells) {
  if (dimension == 3) {
    switch (nodes) {
      case 4:
        return Topology::Tet4;
      case 10:
        return Topology::Tet10;
      case 8:
        return Topology::Hex8;
      case 20:
        return Topology::Hex20;
      case 27:
        return Topology::Hex27;
      case 6:
        return Topology::Wedge6;
      case 15:
        return Topology::Wedge15;
      default:
        return std::nullopt;
    }
  }
  if (dimension != 2) return std::nullopt;
  if (nodes == 4) return shells ? Topology::Shell4 : Topology::Quad4;
  if (nodes == 8) return shells ? Topology::Shell8 : Topology::Quad8;
  if (nodes == 9) return shells ? Topology::Shell9 : Topology::Quad9;
  if (nodes == 3) return shells ? Topology::Shell3 : Topology::Tri3;
  if (nodes == 6) return shells ? Topology::Shell6 : Topology::Tri6;
  return std::nullopt;
}

/// An element type of Gmsh.
struct Type {
  std::string name;
  int dimension = 0, nodes = 0, corners = 0;
  std::vector<double> places;  ///< [node][dimension] in the reference cell, which is that of Exodus
};

Type typeOf(int number) {
  Type type;
  int order = 0;
  gmsh::model::mesh::getElementProperties(number, type.name, type.dimension, order, type.nodes, type.places,
                                          type.corners);
  return type;
}

/// Position in Gmsh's element of each node of the cell: nodes at the same place of the reference cell. Empty
/// where they do not stand at the same places.
std::vector<int> nodeOrder(Topology topology, const Type& type) {
  const std::vector<double> places = fem::referenceNodes(topology);
  const auto dim = static_cast<std::size_t>(type.dimension), count = static_cast<std::size_t>(type.nodes);
  if (places.size() != dim * count || type.places.size() != places.size()) return {};
  std::vector<int> order;
  for (std::size_t n = 0; n < count; ++n)
    for (std::size_t g = 0; g < count; ++g) {
      double distance = 0;
      for (std::size_t d = 0; d < dim; ++d)
        distance = std::max(distance, std::abs(places[n * dim + d] - type.places[g * dim + d]));
      if (distance < 1e-6) order.push_back(static_cast<int>(g));
    }
  return order.size() == count ? order : std::vector<int>{};
}

/// Elements of one type on one entity of the geometry.
struct Elements {
  Type type;
  std::vector<std::size_t> tags, nodes;
};

/// A physical group.
struct Group {
  int dimension, tag;
  std::string name;
  std::vector<Elements> elements;
};

class Reader {
 public:
  Reader(std::string file, Surfaces surfaces) : file_(std::move(file)), surfaces_(surfaces) {}

  Model operator()() {
    readNodes();
    readGroups();
    const auto solids = std::max_element(groups_.begin(), groups_.end(), [](const Group& a, const Group& b) {
      return a.dimension < b.dimension;
    });
    if (solids == groups_.end() || solids->dimension < 2)
      fail("has no cells; expected elements of surfaces or volumes");
    dimension_ = solids->dimension;
    isShells_ = dimension_ == 2 && (surfaces_ == Surfaces::shells || !isFlat());
    mesh().dimension = dimension_ == 3 || isShells_ ? 3 : 2;
    for (const Group& group : groups_)
      if (group.dimension == dimension_) addBlocks(group);
    if (mesh().blocks.empty()) fail("has no cells that this program knows");
    keepUsedNodes();
    countSides();
    for (const Group& group : groups_)
      if (group.dimension < dimension_) addSets(group);
    for (const Shells& group : shells_) addFaces(group);
    return std::move(model_);
  }

 private:
  /// The elements of a group of shells: from `first` on, before `end`.
  struct Shells {
    std::string name;
    int first, end;
  };

  fem::Mesh& mesh() { return model_.mesh; }
  [[noreturn]] void fail(const std::string& what) const { throw Error(file_ + ": " + what); }
  void remark(const std::string& what) { model_.remarks.push_back(file_ + ": " + what); }

  void readNodes() {
    std::vector<double> parameters;
    gmsh::model::mesh::getNodes(nodeTags_, coordinates_, parameters, -1, -1, false, false);
    if (coordinates_.size() != 3 * nodeTags_.size()) fail("is damaged: nodes without coordinates");
    for (std::size_t n = 0; n < nodeTags_.size(); ++n) nodeAt_[nodeTags_[n]] = n;
  }

  void readGroups() {
    gmsh::vectorpair groups;
    gmsh::model::getPhysicalGroups(groups);
    std::set<std::pair<int, int>> grouped;  // entities
    for (const auto& [dimension, tag] : groups) {
      Group group{dimension, tag, {}, {}};
      gmsh::model::getPhysicalName(dimension, tag, group.name);
      if (group.name.empty()) group.name = fmt::format("group_{}", tag);
      std::vector<int> entities;
      gmsh::model::getEntitiesForPhysicalGroup(dimension, tag, entities);
      for (const int entity : entities) {
        grouped.insert({dimension, entity});
        readEntity(dimension, entity, group);
      }
      if (!group.elements.empty()) groups_.push_back(std::move(group));
    }
    if (!groups_.empty()) return;
    // A mesh without groups: all cells.
    for (int dimension = 3; dimension >= 2 && groups_.empty(); --dimension) {
      Group group{dimension, 1, "body", {}};
      readEntity(dimension, -1, group);
      if (!group.elements.empty()) groups_.push_back(std::move(group));
    }
  }

  void readEntity(int dimension, int entity, Group& group) {
    std::vector<int> types;
    std::vector<std::vector<std::size_t>> tags, nodes;
    gmsh::model::mesh::getElements(types, tags, nodes, dimension, entity);
    for (std::size_t t = 0; t < types.size(); ++t) {
      Elements elements{typeOf(types[t]), std::move(tags[t]), std::move(nodes[t])};
      if (elements.type.nodes < 1 ||
          elements.nodes.size() != elements.tags.size() * static_cast<std::size_t>(elements.type.nodes))
        fail("is damaged: elements without all their nodes");
      if (!elements.tags.empty()) group.elements.push_back(std::move(elements));
    }
  }

  /// Whether all cells lie in z = 0.
  bool isFlat() const {
    for (const Group& group : groups_)
      if (group.dimension == dimension_)
        for (const Elements& elements : group.elements)
          for (const std::size_t tag : elements.nodes)
            if (coordinates_[3 * nodeOf(tag) + 2] != 0) return false;
    return true;
  }

  std::size_t nodeOf(std::size_t tag) const {
    const auto at = nodeAt_.find(tag);
    if (at == nodeAt_.end()) fail(fmt::format("is damaged: an element has node {}, which is not there", tag));
    return at->second;
  }

  static long long idOf(std::size_t tag) {
    return static_cast<long long>(std::min<std::size_t>(tag, std::numeric_limits<int>::max()));
  }

  /// One block of each type.
  void addBlocks(const Group& group) {
    std::map<Topology, fem::Block> blocks;
    std::map<Topology, std::vector<long long>> ids;
    std::size_t twice = 0;
    const int before = mesh().numElements();
    for (const Elements& elements : group.elements) {
      const auto topology = topologyOf(dimension_, elements.type.nodes, isShells_);
      const auto order = topology ? nodeOrder(*topology, elements.type) : std::vector<int>();
      if (order.empty()) {
        remark(fmt::format("group '{}': {} elements '{}' are left out, no cell here is equal",
                           plainName(group.name), elements.tags.size(), elements.type.name));
        continue;
      }
      for (std::size_t e = 0; e < elements.tags.size(); ++e) {
        if (!taken_.insert(elements.tags[e]).second) {
          ++twice;
          continue;
        }
        ids[*topology].push_back(idOf(elements.tags[e]));
        for (const int n : order)
          blocks[*topology].nodes.push_back(
              static_cast<int>(nodeOf(elements.nodes[e * order.size() + static_cast<std::size_t>(n)])));
      }
    }
    for (auto& [topology, block] : blocks) {
      block.name = blockNames_.take(blockNames_.isTaken(plainName(group.name))
                                        ? group.name + "_" + fem::topologyName(topology)
                                        : group.name);
      block.topology = topology;
      block.id = static_cast<long long>(mesh().blocks.size()) + 1;
      mesh().blocks.push_back(std::move(block));
      mesh().elementIds.insert(mesh().elementIds.end(), ids[topology].begin(), ids[topology].end());
    }
    if (isShells_) shells_.push_back({group.name, before, mesh().numElements()});
    if (twice > 0)
      remark(fmt::format("group '{}': {} elements are in the block of an earlier group",
                         plainName(group.name), twice));
  }

  /// The faces of a group's shells, for pressures and contact: those from which their nodes go round
  /// counter-clockwise.
  void addFaces(const Shells& group) {
    std::set<std::pair<int, int>> sides;
    for (int e = group.first; e < group.end; ++e) sides.insert({e, 0});
    addSideSet(group.name, sides);
  }

  /// Of elements and their sides, if there are any.
  void addSideSet(const std::string& name, const std::set<std::pair<int, int>>& sides) {
    if (sides.empty()) return;
    fem::SideSet set{sideSetNames_.take(name), static_cast<long long>(mesh().sideSets.size()) + 1, {}};
    for (const auto& [element, side] : sides) set.sides.push_back({element, side});
    mesh().sideSets.push_back(std::move(set));
  }

  void keepUsedNodes() {
    newNode_.assign(nodeTags_.size(), -1);
    for (const fem::Block& block : mesh().blocks)
      for (const int node : block.nodes) newNode_[static_cast<std::size_t>(node)] = 0;
    for (std::size_t n = 0; n < newNode_.size(); ++n) {
      if (newNode_[n] < 0) continue;
      newNode_[n] = mesh().numNodes();
      mesh().coordinates.insert(mesh().coordinates.end(), &coordinates_[3 * n], &coordinates_[3 * n] + 3);
      mesh().nodeIds.push_back(idOf(nodeTags_[n]));
    }
    for (fem::Block& block : mesh().blocks)
      for (int& node : block.nodes) node = newNode_[static_cast<std::size_t>(node)];
  }

  /// Corners, ascending; -1 where there are less than four.
  using Corners = std::array<int, 4>;

  void countSides() {
    int element = 0;
    for (const fem::Block& block : mesh().blocks) {
      const auto perElement = static_cast<std::size_t>(fem::nodesPerElement(block.topology));
      const int first = fem::isShell(block.topology) ? 2 : 0;  // edges of shells
      for (std::size_t start = 0; start < block.nodes.size(); start += perElement, ++element)
        for (int side = first; side < fem::numSides(block.topology); ++side) {
          const auto local = fem::sideNodes(block.topology, side);
          const std::size_t count = dimension_ == 2 ? 2 : local.size() == 3 || local.size() == 6 ? 3 : 4;
          Corners corners{-1, -1, -1, -1};
          for (std::size_t i = 0; i < count; ++i)
            corners[i] = block.nodes[start + static_cast<std::size_t>(local[i])];
          std::sort(corners.begin(), corners.end());
          sides_[corners].push_back({element, side});
        }
    }
  }

  void addSets(const Group& group) {
    std::set<int> nodes;
    std::set<std::pair<int, int>> sides;
    std::size_t lost = 0, shared = 0;
    for (const Elements& elements : group.elements) {
      const auto count = static_cast<std::size_t>(elements.type.nodes);
      for (std::size_t first = 0; first < elements.nodes.size(); first += count) {
        for (std::size_t n = 0; n < count; ++n)
          if (const int node = newNode_[nodeOf(elements.nodes[first + n])]; node >= 0) nodes.insert(node);
        if (group.dimension != dimension_ - 1) continue;
        Corners corners{-1, -1, -1, -1};
        for (std::size_t n = 0; n < static_cast<std::size_t>(std::min(elements.type.corners, 4)); ++n)
          corners[n] = newNode_[nodeOf(elements.nodes[first + n])];
        std::sort(corners.begin(), corners.end());
        const auto at = sides_.find(corners);
        if (at == sides_.end()) {
          ++lost;
          continue;
        }
        shared += at->second.size() > 1 ? 1 : 0;
        sides.insert({at->second.front().element, at->second.front().side});
      }
    }
    const std::string name = plainName(group.name);
    if (lost > 0) remark(fmt::format("group '{}': {} elements are sides of no cell", name, lost));
    if (shared > 0)
      remark(fmt::format("group '{}': {} sides are between cells and count for the first one", name, shared));
    if (!nodes.empty()) {
      const auto id = static_cast<long long>(mesh().nodeSets.size()) + 1;
      mesh().nodeSets.push_back({nodeSetNames_.take(group.name), id, {nodes.begin(), nodes.end()}});
    }
    addSideSet(group.name, sides);
  }

  std::string file_;
  Surfaces surfaces_;
  Model model_;
  int dimension_ = 0;  ///< of the cells
  bool isShells_ = false;
  std::vector<std::size_t> nodeTags_;
  std::vector<double> coordinates_;
  std::unordered_map<std::size_t, std::size_t> nodeAt_;  ///< by tag
  std::vector<int> newNode_;                             ///< -1: of no cell
  std::vector<Group> groups_;
  std::set<std::size_t> taken_;  ///< elements in blocks
  std::vector<Shells> shells_;
  std::map<Corners, std::vector<fem::Side>> sides_;
  Names blockNames_, nodeSetNames_, sideSetNames_;
};

}  // namespace

Model readGmsh(const std::string& file, Surfaces surfaces) {
  const OpenFile open(file);
  const Session session;
  const std::string damaged = file + ": is damaged: Gmsh's library does not read it";
  try {
    gmsh::merge(open.name());
  } catch (...) {  // whatever it throws, its words are not for users of this program
    throw Error(damaged);
  }
  try {
    return Reader(file, surfaces)();
  } catch (const Error&) {
    throw;
  } catch (...) {
    throw Error(damaged);
  }
}

}  // namespace atrapos::importer
