#include "CheckMesh.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <utility>
#include <vector>

#include "ElementTypes.hpp"
#include "atrapos/exodus/Error.hpp"

namespace atrapos::exodus {

namespace {

constexpr std::size_t maxTitle = 80;                          // Exodus: MAX_LINE_LENGTH
constexpr std::size_t maxName = 255;                          // NetCDF: NC_MAX_NAME less the final zero
constexpr long long maxId = std::numeric_limits<int>::max();  // integers in a 64-bit-offset file have 32 bits

class Checker {
 public:
  Checker(const fem::Mesh& mesh, const std::string& file, Extent extent)
      : mesh_(mesh), file_(file), isPart_(extent == Extent::part) {}

  void operator()() {
    require(mesh_.title.size() <= maxTitle, "the title has more than 80 characters");
    require(mesh_.coordinates.size() % 3 == 0, "the number of coordinates is not a multiple of three");
    require(isPart_ || mesh_.numNodes() > 0, "the mesh has no nodes");
    require(mesh_.dimension == 2 || mesh_.dimension == 3, "the mesh has neither two nor three dimensions");
    checkFinite(mesh_.coordinates, "a node has a coordinate");
    for (const fem::Block& block : mesh_.blocks) checkBlock(block);
    checkTwins();
    require(isPart_ || !sidesOfElement_.empty(), "the mesh has no elements");
    for (const fem::NodeSet& set : mesh_.nodeSets) {
      checkNodes(set.nodes, describe("node set", set));
      require(set.factors.empty() || set.factors.size() == set.nodes.size(),
              describe("node set", set) + " has not as many distribution factors as nodes");
      checkFinite(set.factors, describe("node set", set) + " has a distribution factor");
    }
    for (const fem::SideSet& set : mesh_.sideSets) checkSides(set);
    checkNamesAndIds(mesh_.blocks, "block");
    checkNamesAndIds(mesh_.nodeSets, "node set");
    checkNamesAndIds(mesh_.sideSets, "side set");
    checkNumbers(mesh_.nodeIds, mesh_.numNodes(), "node");
    checkNumbers(mesh_.elementIds, static_cast<int>(sidesOfElement_.size()), "element");
  }

 private:
  void require(bool condition, const std::string& message) const {
    if (!condition) throw Error(file_ + ": " + message);
  }

  template <class Item>
  static std::string describe(const std::string& kind, const Item& item) {
    return kind + " '" + item.name + "' (id " + std::to_string(item.id) + ")";
  }

  void checkFinite(const std::vector<double>& values, const std::string& what) const {
    require(std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); }),
            what + " that is not a finite number");
  }

  void checkNodes(const std::vector<int>& nodes, const std::string& owner) const {
    const int numNodes = mesh_.numNodes();
    for (int node : nodes)
      require(node >= 0 && node < numNodes, owner + " has node " + std::to_string(node + 1LL) +
                                                ", the mesh has " + std::to_string(numNodes));
  }

  void checkBlock(const fem::Block& block) {
    const std::string owner = describe("block", block);
    require(block.nodes.empty() || fem::isPlane(block.topology) == (mesh_.dimension == 2),
            owner + " has " + fem::topologyName(block.topology) + " in a mesh of " +
                std::to_string(mesh_.dimension) + " dimensions");
    const std::size_t perElement = fem::nodesPerElement(block.topology);
    require(block.nodes.size() % perElement == 0,
            owner + " has a node list that is not a multiple of " + std::to_string(perElement) + " long");
    const std::size_t count = block.nodes.size() / perElement;
    require(block.attributes.size() == count * block.attributeNames.size(),
            owner + " has not as many attributes as elements times attribute names");
    for (const std::string& name : block.attributeNames)
      require(name.size() <= maxName, owner + " has an attribute name of more than 255 characters");
    checkFinite(block.attributes, owner + " has an attribute");
    checkNodes(block.nodes, owner);
    sidesOfElement_.insert(sidesOfElement_.end(), count, static_cast<char>(numSides(block.topology)));
  }

  /// Two elements on the same nodes would count twice, whatever block they are in.
  void checkTwins() const {
    struct Element {
      std::uint64_t key;  ///< the same for the same nodes in whatever order
      int number;
      const int* nodes;
      int count;
    };
    std::vector<Element> elements;
    elements.reserve(sidesOfElement_.size());
    for (const fem::Block& block : mesh_.blocks) {
      const int count = fem::nodesPerElement(block.topology);
      for (std::size_t first = 0; first < block.nodes.size(); first += static_cast<std::size_t>(count)) {
        Element e{0, static_cast<int>(elements.size()), &block.nodes[first], count};
        for (int i = 0; i < count; ++i) e.key += mixed(static_cast<std::uint64_t>(e.nodes[i]));
        elements.push_back(e);
      }
    }
    std::sort(elements.begin(), elements.end(), [](const Element& a, const Element& b) {
      return a.key != b.key ? a.key < b.key : a.number < b.number;
    });
    const auto twins =
        std::adjacent_find(elements.begin(), elements.end(), [](const Element& a, const Element& b) {
          return a.key == b.key && a.count == b.count &&
                 std::is_permutation(a.nodes, a.nodes + a.count, b.nodes);
        });
    if (twins != elements.end())
      require(false, "elements " + std::to_string(mesh_.elementNumber(twins->number)) + " and " +
                         std::to_string(mesh_.elementNumber(twins[1].number)) + " have the same nodes");
  }

  /// Steele, Lea and Flood's mixing function.
  static std::uint64_t mixed(std::uint64_t x) {
    x += 0x9e3779b97f4a7c15;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9;
    x = (x ^ (x >> 27)) * 0x94d049bb133111eb;
    return x ^ (x >> 31);
  }

  void checkSides(const fem::SideSet& set) const {
    const int numElements = static_cast<int>(sidesOfElement_.size());
    for (const fem::Side& side : set.sides) {
      require(side.element >= 0 && side.element < numElements,
              describe("side set", set) + " has element " + std::to_string(side.element + 1LL) +
                  ", the mesh has " + std::to_string(numElements));
      require(side.side >= 0 && side.side < sidesOfElement_[side.element],
              describe("side set", set) + " has side " + std::to_string(side.side + 1LL) + " of element " +
                  std::to_string(mesh_.elementNumber(side.element)) + ", which has " +
                  std::to_string(sidesOfElement_[side.element]) + " sides");
    }
    std::vector<std::pair<int, int>> sides;
    for (const fem::Side& side : set.sides) sides.emplace_back(side.element, side.side);
    std::sort(sides.begin(), sides.end());
    const auto twice = std::adjacent_find(sides.begin(), sides.end());
    require(twice == sides.end(),
            describe("side set", set) + " has a side twice" +
                (twice == sides.end() ? ""
                                      : ", of element " + std::to_string(mesh_.elementNumber(twice->first))));
  }

  template <class Items>
  void checkNamesAndIds(const Items& items, const std::string& kind) const {
    std::set<long long> ids;
    for (const auto& item : items) {
      require(item.name.size() <= maxName,
              kind + " " + std::to_string(item.id) + " has a name of more than 255 characters");
      require(item.id >= 0 && item.id <= maxId,  // meshio counts from 0
              describe(kind, item) + " has an id that is not within 0 and 2147483647");
      require(ids.insert(item.id).second, describe(kind, item) + " has the id of another " + kind);
    }
  }

  void checkNumbers(const std::vector<long long>& ids, int count, const std::string& kind) const {
    if (ids.empty()) return;
    require(ids.size() == static_cast<std::size_t>(count),
            "there are not as many " + kind + " ids as " + kind + "s");
    for (long long id : ids)
      require(id > 0 && id <= maxId, kind + " id " + std::to_string(id) + " is not within 1 and 2147483647");
  }

  const fem::Mesh& mesh_;
  const std::string& file_;
  bool isPart_;
  std::vector<char> sidesOfElement_;
};

}  // namespace

void checkMesh(const fem::Mesh& mesh, const std::string& file, Extent extent) {
  Checker(mesh, file, extent)();
}

}  // namespace atrapos::exodus
