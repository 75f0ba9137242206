#include <algorithm>
#include <limits>
#include <set>
#include <utility>

#include "CheckMesh.hpp"
#include "ElementTypes.hpp"
#include "File.hpp"
#include "PartRecords.hpp"
#include "atrapos/exodus/MeshFile.hpp"
#include "atrapos/exodus/MeshPart.hpp"

namespace atrapos::exodus {

namespace {

class MeshReader {
 public:
  explicit MeshReader(const std::string& name)
      : file_(File::open(name)),
        nameLength_(static_cast<std::size_t>(ex_inquire_int(file_.id(), EX_INQ_MAX_READ_NAME_LENGTH))) {}

  fem::Mesh whole() {
    read();
    mesh_.nodeIds = trivialDropped(idMap(EX_NODE_MAP, init_.num_nodes));
    mesh_.elementIds = trivialDropped(ofCells(idMap(EX_ELEM_MAP, init_.num_elem)));
    checkMesh(mesh_, file_.name());
    return std::move(mesh_);
  }

  ForeignMesh foreign() {
    lowerCells_ = true;
    ForeignMesh result;
    result.mesh = whole();
    result.remarks = std::move(remarks_);
    return result;
  }

  MeshPart part(const PartName& name) {
    extent_ = Extent::part;
    read();
    mesh_.nodeIds = idMap(EX_NODE_MAP, init_.num_nodes);
    mesh_.elementIds = idMap(EX_ELEM_MAP, init_.num_elem);
    checkMesh(mesh_, file_.name(), extent_);
    MeshPart part;
    part.part = name.part;
    part.parts = name.parts;
    part.mesh = std::move(mesh_);
    readPartRecords(file_, part);
    return part;
  }

 private:
  void read() {
    file_.check(ex_get_init_ext(file_.id(), &init_), "reading the sizes");
    require(init_.num_dim == 2 || init_.num_dim == 3,
            "the mesh has " + std::to_string(init_.num_dim) + " dimensions; two or three are needed");
    mesh_.dimension = static_cast<int>(init_.num_dim);
    if (extent_ == Extent::whole) {
      require(init_.num_nodes > 0, "the mesh has no nodes");
      require(init_.num_elem > 0, "the mesh has no elements");
    }
    constexpr int64_t most = std::numeric_limits<int>::max() / 3;
    require(init_.num_nodes < most && init_.num_elem < most, "the mesh is too large");
    mesh_.title = init_.title;
    readCoordinates();
    readBlocks();
    readNodeSets();
    require(static_cast<int64_t>(firstSide_.size()) == init_.num_elem,
            "the blocks have " + std::to_string(firstSide_.size()) + " elements, the file announces " +
                std::to_string(init_.num_elem));
    readSideSets();
    addLowerSets();
  }

  void require(bool condition, const std::string& message) const {
    if (!condition) throw Error(file_.name() + ": " + message);
  }

  void readCoordinates() {
    const auto n = static_cast<std::size_t>(init_.num_nodes);
    if (n == 0) return;
    std::vector<double> x(n), y(n), z(n, 0.0);
    file_.check(ex_get_coord(file_.id(), x.data(), y.data(), mesh_.dimension == 3 ? z.data() : nullptr),
                "reading the coordinates");
    mesh_.coordinates.resize(3 * n);
    for (std::size_t i = 0; i < n; ++i) {
      mesh_.coordinates[3 * i] = x[i];
      mesh_.coordinates[3 * i + 1] = y[i];
      mesh_.coordinates[3 * i + 2] = z[i];
    }
  }

  /// Ids and names of the blocks or sets of one kind, in the file's order.
  std::vector<std::pair<int64_t, std::string>> idsAndNames(ex_entity_type type, int64_t count,
                                                           const std::string& kind) const {
    std::vector<std::pair<int64_t, std::string>> result;
    if (count <= 0) return result;
    std::vector<int64_t> ids(static_cast<std::size_t>(count));
    file_.check(ex_get_ids(file_.id(), type, ids.data()), "reading the ids of the " + kind);
    Strings names(ids.size(), nameLength_);
    file_.check(ex_get_names(file_.id(), type, names.data()), "reading the names of the " + kind);
    const auto texts = names.get();
    for (std::size_t i = 0; i < ids.size(); ++i) result.emplace_back(ids[i], texts[i]);
    return result;
  }

  void readBlocks() {
    for (const auto& [id, name] : idsAndNames(EX_ELEM_BLOCK, init_.num_elem_blk, "blocks")) {
      const std::string owner = "block '" + name + "' (id " + std::to_string(id) + ")";
      ex_block param{};
      param.id = id;
      param.type = EX_ELEM_BLOCK;
      file_.check(ex_get_block_param(file_.id(), &param), "reading " + owner);
      if (param.num_entry == 0) {
        if (extent_ == Extent::whole) continue;
        fem::Block& empty = mesh_.blocks.emplace_back();
        empty.name = name;
        empty.id = id;
        continue;
      }
      if (lowerCells_ && isLower(param.topology)) {
        keepAsSet(param, name, owner);
        continue;
      }
      const auto topology =
          topologyOf(param.topology, static_cast<int>(param.num_nodes_per_entry), mesh_.dimension);
      require(topology.has_value(), owner + ": element type '" + param.topology + "' with " +
                                        std::to_string(param.num_nodes_per_entry) +
                                        " nodes is not supported; accepted are " +
                                        acceptedElementTypes(mesh_.dimension));
      require(param.num_entry > 0 && param.num_entry <= init_.num_elem,
              owner + " has more elements than the mesh");
      require(fem::isPlane(*topology) == (mesh_.dimension == 2),
              owner + ": element type '" + param.topology + "' in a mesh of " +
                  std::to_string(mesh_.dimension) + " dimensions; accepted are " +
                  acceptedElementTypes(mesh_.dimension));
      fem::Block block;
      block.name = name;
      block.id = id;
      block.topology = *topology;
      block.nodes = readConnectivity(param, owner);
      readAttributes(param, owner, block);
      firstSide_.insert(firstSide_.end(), static_cast<std::size_t>(param.num_entry),
                        firstSide(param.topology, mesh_.dimension));
      mesh_.blocks.push_back(std::move(block));
    }
  }

  /// The nodes of a block of lines or points; its elements count where the file numbers elements.
  void keepAsSet(const ex_block& param, const std::string& name, const std::string& owner) {
    require(param.num_entry > 0 && param.num_entry <= init_.num_elem,
            owner + " has more elements than the mesh");
    std::vector<int> nodes = readConnectivity(param, owner);
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    const std::string set = name.empty() ? "block_" + std::to_string(param.id) : name;
    remarks_.push_back(file_.name() + ": " + owner + " has " + std::to_string(param.num_entry) +
                       " elements '" + param.topology + "', whose nodes are the node set '" + set + "'");
    lowerSets_.push_back({set, 0, std::move(nodes)});
    firstSide_.insert(firstSide_.end(), static_cast<std::size_t>(param.num_entry), noCell);
  }

  /// With the first ids that are free.
  void addLowerSets() {
    std::set<long long> ids;
    for (const fem::NodeSet& set : mesh_.nodeSets) ids.insert(set.id);
    long long id = 1;
    for (fem::NodeSet& set : lowerSets_) {
      while (!ids.insert(id).second) ++id;
      set.id = id;
      mesh_.nodeSets.push_back(std::move(set));
    }
  }

  /// Values by the file's elements without those that are no cells.
  std::vector<long long> ofCells(const std::vector<long long>& values) const {
    std::vector<long long> kept;
    for (std::size_t i = 0; i < values.size(); ++i)
      if (firstSide_[i] != noCell) kept.push_back(values[i]);
    return kept;
  }

  std::vector<int> readConnectivity(const ex_block& param, const std::string& owner) const {
    std::vector<int64_t> nodes(static_cast<std::size_t>(param.num_entry * param.num_nodes_per_entry));
    file_.check(ex_get_conn(file_.id(), EX_ELEM_BLOCK, param.id, nodes.data(), nullptr, nullptr),
                "reading the nodes of " + owner);
    return zeroBased(nodes, init_.num_nodes, owner, "node");
  }

  /// Checked here too, before 64-bit numbers become 32-bit ones.
  std::vector<int> zeroBased(const std::vector<int64_t>& numbers, int64_t count, const std::string& owner,
                             const std::string& kind) const {
    std::vector<int> result;
    result.reserve(numbers.size());
    for (int64_t n : numbers) {
      require(n >= 1 && n <= count,
              owner + " has " + kind + " " + std::to_string(n) + ", the mesh has " + std::to_string(count));
      result.push_back(static_cast<int>(n - 1));
    }
    return result;
  }

  void readAttributes(const ex_block& param, const std::string& owner, fem::Block& block) const {
    if (param.num_attribute <= 0) return;
    Strings names(static_cast<std::size_t>(param.num_attribute), nameLength_);
    file_.check(ex_get_attr_names(file_.id(), EX_ELEM_BLOCK, param.id, names.data()),
                "reading the attribute names of " + owner);
    block.attributeNames = names.get();
    block.attributes.resize(static_cast<std::size_t>(param.num_entry * param.num_attribute));
    file_.check(ex_get_attr(file_.id(), EX_ELEM_BLOCK, param.id, block.attributes.data()),
                "reading the attributes of " + owner);
  }

  struct SetLength {
    std::size_t entries, factors;
  };
  SetLength setLength(ex_entity_type type, int64_t id, const std::string& owner) const {
    int64_t entries = 0, factors = 0;
    file_.check(ex_get_set_param(file_.id(), type, id, &entries, &factors), "reading the length of " + owner);
    require(entries >= 0 && entries < std::numeric_limits<int>::max(), owner + " is too large");
    return {static_cast<std::size_t>(entries), static_cast<std::size_t>(std::max<int64_t>(factors, 0))};
  }

  void readNodeSets() {
    for (const auto& [id, name] : idsAndNames(EX_NODE_SET, init_.num_node_sets, "node sets")) {
      const std::string owner = "node set '" + name + "' (id " + std::to_string(id) + ")";
      const SetLength length = setLength(EX_NODE_SET, id, owner);
      std::vector<int64_t> nodes(length.entries);
      if (!nodes.empty())
        file_.check(ex_get_set(file_.id(), EX_NODE_SET, id, nodes.data(), nullptr), "reading " + owner);
      require(length.factors == 0 || length.factors == length.entries,
              owner + " has not as many distribution factors as nodes");
      std::vector<double> factors(length.factors);
      if (!factors.empty())
        file_.check(ex_get_set_dist_fact(file_.id(), EX_NODE_SET, id, factors.data()),
                    "reading the distribution factors of " + owner);
      mesh_.nodeSets.push_back(
          {name, id, zeroBased(nodes, init_.num_nodes, owner, "node"), std::move(factors)});
    }
  }

  void readSideSets() {
    for (const auto& [id, name] : idsAndNames(EX_SIDE_SET, init_.num_side_sets, "side sets")) {
      const std::string owner = "side set '" + name + "' (id " + std::to_string(id) + ")";
      std::vector<int64_t> elements(setLength(EX_SIDE_SET, id, owner).entries), ordinals(elements.size());
      if (!elements.empty())
        file_.check(ex_get_set(file_.id(), EX_SIDE_SET, id, elements.data(), ordinals.data()),
                    "reading " + owner);
      const auto element = zeroBased(elements, init_.num_elem, owner, "element");
      const auto side = zeroBased(ordinals, 6, owner, "side");
      fem::SideSet set{name, id, {}};
      std::size_t lost = 0;
      for (std::size_t i = 0; i < element.size(); ++i) {
        const int first = firstSide_[static_cast<std::size_t>(element[i])];
        if (first == noCell) {
          ++lost;
          continue;
        }
        require(side[i] + first < 6, owner + " has side " + std::to_string(side[i] + 1) + " of element " +
                                         std::to_string(element[i] + 1LL) + ", which has " +
                                         std::to_string(6 - first) + " sides");
        set.sides.push_back({cellOf(element[i]), side[i] + first});
      }
      if (lost > 0)
        remarks_.push_back(file_.name() + ": " + owner + ": " + std::to_string(lost) +
                           " sides of lines are left out");
      mesh_.sideSets.push_back(std::move(set));
    }
  }

  /// Position among the mesh's elements of one of the file's.
  int cellOf(int element) {
    if (lowerSets_.empty()) return element;
    if (cells_.empty())
      for (std::size_t i = 0, n = 0; i < firstSide_.size(); ++i)
        cells_.push_back(static_cast<int>(firstSide_[i] == noCell ? n : n++));
    return cells_[static_cast<std::size_t>(element)];
  }

  /// 1, 2, ... where the file has no map.
  std::vector<long long> idMap(ex_entity_type type, int64_t count) const {
    std::vector<int64_t> ids(static_cast<std::size_t>(count));
    if (ids.empty()) return {};
    file_.check(ex_get_id_map(file_.id(), type, ids.data()), "reading the node and element ids");
    return {ids.begin(), ids.end()};
  }

  static std::vector<long long> trivialDropped(std::vector<long long> ids) {
    for (std::size_t i = 0; i < ids.size(); ++i)
      if (ids[i] != static_cast<long long>(i) + 1) return ids;
    return {};
  }

  File file_;
  std::size_t nameLength_;
  Extent extent_ = Extent::whole;
  ex_init_params init_{};
  static constexpr int noCell = -1;
  std::vector<int> firstSide_;  // [element] of the sides in the file; noCell: a line or a point
  bool lowerCells_ = false;     // blocks of lines and points become node sets
  std::vector<int> cells_;
  std::vector<fem::NodeSet> lowerSets_;
  std::vector<std::string> remarks_;
  fem::Mesh mesh_;
};

}  // namespace

fem::Mesh readMesh(const std::string& file) { return MeshReader(file).whole(); }

ForeignMesh readForeignMesh(const std::string& file) { return MeshReader(file).foreign(); }

MeshPart readPart(const std::string& name) {
  const PartName parsed = parsePartName(name);
  return MeshReader(name).part(parsed);
}

}  // namespace atrapos::exodus
