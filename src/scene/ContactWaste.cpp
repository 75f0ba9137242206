#include "scene/ContactWaste.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "atrapos/fem/ReferenceCell.hpp"

namespace atrapos {
namespace {

using Vector3 = std::array<double, 3>;

struct Side {
  Vector3 middle{}, out{};  ///< out: of any length
};

Side sideOf(const fem::Mesh& mesh, const std::vector<int>& corners) {
  const auto at = [&](std::size_t i) { return &mesh.coordinates[3 * static_cast<std::size_t>(corners[i])]; };
  Side side;
  for (std::size_t i = 0; i < corners.size(); ++i)
    for (int c = 0; c < 3; ++c) side.middle[c] += at(i)[c] / static_cast<double>(corners.size());
  if (corners.size() == 2) {  // an edge of a plane body, which runs counter-clockwise
    side.out = {at(1)[1] - at(0)[1], at(0)[0] - at(1)[0], 0};
    return side;
  }
  for (std::size_t i = 0; i < corners.size(); ++i) {  // the triangles around the middle
    const double *const a = at(i), *const b = at((i + 1) % corners.size());
    for (int c = 0; c < 3; ++c) {
      const int d = (c + 1) % 3, e = (c + 2) % 3;
      side.out[c] += (a[d] - side.middle[d]) * (b[e] - side.middle[e]) -
                     (a[e] - side.middle[e]) * (b[d] - side.middle[d]);
    }
  }
  return side;
}

std::vector<int> cornersOf(const fem::Block& block, int element, int side) {
  const std::size_t first =
      static_cast<std::size_t>(element) * static_cast<std::size_t>(fem::nodesPerElement(block.topology));
  const auto local = fem::sideNodes(block.topology, side);
  // A triangle has 3 or 6 nodes, a quadrilateral 4, 8 or 9.
  const std::size_t corners = fem::isPlane(block.topology)                ? 2
                              : local.size() % 3 == 0 && local.size() < 9 ? 3
                                                                          : 4;
  std::vector<int> nodes;
  for (std::size_t i = 0; i < corners; ++i) nodes.push_back(block.nodes[first + local[i]]);
  return nodes;
}

/// Whether the body is between the middle of the side and the tool: out of the side is away from the tool.
bool isAway(const Side& side, const contact::RigidTool& tool) {
  const double place[4] = {side.middle[0], side.middle[1], side.middle[2], 0};
  const contact::ToolProjection over = tool.project(place);
  if (!(over.gap > 0) || !std::isfinite(over.gap)) return false;
  double along = 0, size = 0;
  for (int c = 0; c < 3; ++c) {
    along += side.out[c] * over.normal[c];
    size += side.out[c] * side.out[c];
  }
  constexpr double turned = 0.5;  // within 60 degrees of straight away
  return along > turned * std::sqrt(size);
}

}  // namespace

std::string sidesAway(const ContactPoints& contact, const deck::Deck& deck, const fem::Mesh& mesh) {
  const auto entry = std::find_if(deck.contacts.begin(), deck.contacts.end(),
                                  [&](const deck::Contact& c) { return c.name == contact.name; });
  if (entry == deck.contacts.end() || entry->points == deck::Contact::Points::Nodes) return {};
  const auto set = std::find_if(mesh.sideSets.begin(), mesh.sideSets.end(), [&](const fem::SideSet& s) {
    return s.name == entry->set || std::to_string(s.id) == entry->set;
  });
  if (set == mesh.sideSets.end()) return {};
  std::size_t away = 0, all = 0;
  for (const fem::Side& side : set->sides) {
    const auto [b, e] = fem::addressOf(mesh, side.element);
    const fem::Block& block = mesh.blocks[b];
    if (fem::isShell(block.topology)) continue;
    ++all;
    away += isAway(sideOf(mesh, cornersOf(block, e, side.side)), *contact.atStart) ? 1 : 0;
  }
  if (away == 0 || 2 * away < all) return {};
  return fmt::format(
      "contact/{}: {} of the {} sides in '{}' look away from '{}', with the body between; a set "
      "without them has fewer points",
      contact.name, away, all, entry->set, entry->tool);
}

}  // namespace atrapos
