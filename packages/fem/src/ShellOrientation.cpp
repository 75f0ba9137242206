#include "atrapos/fem/ShellOrientation.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "Vec3.hpp"

namespace atrapos::fem {
namespace {

/// The same cell seen from the other side: its first corner stays.
std::vector<int> reversedNodes(Topology topology) {
  if (topology == Topology::Shell3) return {0, 2, 1};
  if (topology == Topology::Shell6) return {0, 2, 1, 5, 4, 3};
  std::vector<int> order{0, 3, 2, 1};
  if (topology != Topology::Shell4) order.insert(order.end(), {7, 6, 5, 4});
  if (topology == Topology::Shell9) order.push_back(8);
  return order;
}

/// Sides as Topology has them, 0-based: the faces change, and the edges run from the first corner the other
/// way round.
int reversedSide(int side, int corners) { return side < 2 ? 1 - side : corners + 3 - side; }

class Orientation {
 public:
  Orientation(Mesh& mesh, double foldAngle)
      : mesh_(mesh), cosFold_(std::cos(std::min(foldAngle, 45.0) * 3.14159265358979323846 / 180.0)) {}

  std::vector<ShellPart> operator()() {
    collect();
    join();
    std::vector<ShellPart> parts;
    std::vector<std::vector<int>> members;
    partOf_.assign(elements_.size(), -1);
    for (int e = 0; e < static_cast<int>(elements_.size()); ++e)
      if (partOf_[e] < 0) {
        members.push_back(walk(e, static_cast<int>(parts.size())));
        parts.push_back({blockOf(e).name, elements_[e].number, static_cast<int>(members.back().size())});
      }
    for (std::size_t p = 0; p < parts.size(); ++p) parts[p].turned = turn(members[p]);
    turnSides(parts);
    return parts;
  }

 private:
  struct Element {
    int block, inBlock, number;  // number: over all blocks
  };
  struct Neighbour {
    int element;
    bool agrees;
  };

  const Block& blockOf(int e) const { return mesh_.blocks[elements_[e].block]; }
  int corners(int e) const { return shellCorners(blockOf(e).topology); }
  int* nodesOf(int e) {
    Block& b = mesh_.blocks[elements_[e].block];
    return &b.nodes[static_cast<std::size_t>(elements_[e].inBlock) * nodesPerElement(b.topology)];
  }
  Vec3 place(int node) const { return vectorAt(mesh_.coordinates, node); }

  void collect() {
    int number = 0;
    for (std::size_t b = 0; b < mesh_.blocks.size(); ++b) {
      const Block& block = mesh_.blocks[b];
      const int count = static_cast<int>(block.nodes.size()) / nodesPerElement(block.topology);
      for (int e = 0; e < count; ++e, ++number)
        if (isShell(block.topology)) elements_.push_back({static_cast<int>(b), e, number});
    }
  }

  /// Unit normal of the plane through the edge from corner c and the middle of the opposite edge (corner): of
  /// the element's side that is at the edge.
  Vec3 normalAt(int e, int c) {
    const int* n = nodesOf(e);
    const int count = corners(e), opposite = (c + 2) % count;
    const Vec3 a = place(n[c]), b = place(n[(c + 1) % count]);
    Vec3 inwards = scaled(0.5, place(n[opposite])), along = b;
    add(0.5, place(n[count == 3 ? opposite : (c + 3) % 4]), inwards);
    add(-0.5, a, inwards);
    add(-0.5, b, inwards);
    add(-1, a, along);
    const Vec3 normal = cross(along, inwards);
    const double size = norm(normal);
    return size > 0 ? scaled(1 / size, normal) : normal;
  }

  void join() {
    struct Use {
      int element, corner, first;
    };
    std::map<std::pair<int, int>, std::vector<Use>> edges;
    for (int e = 0; e < static_cast<int>(elements_.size()); ++e)
      for (int c = 0, count = corners(e); c < count; ++c) {
        const int a = nodesOf(e)[c], b = nodesOf(e)[(c + 1) % count];
        edges[std::minmax(a, b)].push_back({e, c, a});
      }
    neighbours_.resize(elements_.size());
    for (const auto& edge : edges) {
      const std::vector<Use>& uses = edge.second;
      for (std::size_t i = 0; i < uses.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
          const bool agrees = uses[i].first != uses[j].first;
          if (uses.size() > 2) {
            const double cosine =
                dot(normalAt(uses[i].element, uses[i].corner), normalAt(uses[j].element, uses[j].corner));
            if ((agrees ? cosine : -cosine) < cosFold_) continue;
          }
          neighbours_[uses[i].element].push_back({uses[j].element, agrees});
          neighbours_[uses[j].element].push_back({uses[i].element, agrees});
        }
    }
  }

  /// The elements of a part; against_ says which are against the first.
  std::vector<int> walk(int first, int part) {
    std::vector<int> found{first};
    against_.resize(elements_.size(), 0);
    partOf_[first] = part;
    for (std::size_t i = 0; i < found.size(); ++i)
      for (const Neighbour& n : neighbours_[found[i]]) {
        if (partOf_[n.element] >= 0) continue;
        partOf_[n.element] = part;
        against_[n.element] = n.agrees ? against_[found[i]] : static_cast<char>(1 - against_[found[i]]);
        found.push_back(n.element);
      }
    return found;
  }

  int turn(const std::vector<int>& members) {
    const auto numAgainst =
        std::count_if(members.begin(), members.end(), [&](int e) { return against_[e] != 0; });
    const char turned = 2 * static_cast<std::size_t>(numAgainst) > members.size() ? 0 : 1;
    int count = 0;
    for (const int e : members) {
      if (against_[e] != turned) continue;
      reverse(e);
      turned_.insert(elements_[e].number);
      ++count;
    }
    return count;
  }

  void reverse(int e) {
    Block& block = mesh_.blocks[elements_[e].block];
    const std::vector<int> order = reversedNodes(block.topology);
    permute(nodesOf(e), order);
    // One attribute for every node: thicknesses (ShellThickness.hpp).
    if (block.attributeNames.size() == order.size())
      permute(&block.attributes[static_cast<std::size_t>(elements_[e].inBlock) * order.size()], order);
  }

  template <class Number>
  static void permute(Number* values, const std::vector<int>& order) {
    const std::vector<Number> old(values, values + order.size());
    for (std::size_t i = 0; i < order.size(); ++i) values[i] = old[order[i]];
  }

  void turnSides(std::vector<ShellPart>& parts) {
    std::map<int, int> position;  // of an element's number
    for (std::size_t e = 0; e < elements_.size(); ++e) position[elements_[e].number] = static_cast<int>(e);
    for (SideSet& set : mesh_.sideSets) {
      std::map<int, int> faces;  // part -> 1: tops, 2: bottoms, 3: both
      for (Side& side : set.sides) {
        const auto shell = position.find(side.element);
        if (turned_.count(side.element) > 0) side.side = reversedSide(side.side, corners(shell->second));
        if (shell != position.end() && side.side < 2) faces[partOf_[shell->second]] |= 1 + side.side;
      }
      for (const auto& [part, sides] : faces)
        if (sides == 3 && parts[part].turned > 0) parts[part].sidesMixed = true;
    }
  }

  Mesh& mesh_;
  double cosFold_;  ///< at branches, as shellGeometry has it there
  std::vector<Element> elements_;
  std::vector<std::vector<Neighbour>> neighbours_;
  std::vector<int> partOf_;
  std::vector<char> against_;
  std::set<int> turned_;
};

}  // namespace

std::vector<ShellPart> orientShells(Mesh& mesh, double foldAngle) { return Orientation(mesh, foldAngle)(); }

}  // namespace atrapos::fem
