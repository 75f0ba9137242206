#include "scene/ContactWaste.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "atrapos/fem/ReferenceCell.hpp"
#include "scene/Sets.hpp"
#include "scene/Vectors.hpp"

namespace atrapos {
namespace {

using namespace vectors;

struct Side {
  Vector3 middle{}, out{};  ///< out: of any length
};

Side sideOf(const std::vector<Vector3>& corners) {
  Side side;
  for (const Vector3& corner : corners) side.middle = sum(side.middle, 1.0 / corners.size(), corner);
  if (corners.size() == 2) {  // an edge of a plane body, which runs counter-clockwise
    side.out = cross(sum(corners[1], -1, corners[0]), {0, 0, 1});
    return side;
  }
  for (std::size_t i = 0; i < corners.size(); ++i)  // the triangles around the middle
    side.out =
        sum(side.out, 1,
            cross(sum(corners[i], -1, side.middle), sum(corners[(i + 1) % corners.size()], -1, side.middle)));
  return side;
}

std::vector<Vector3> cornersOf(const fem::Mesh& mesh, const fem::Block& block, int element, int side) {
  const auto first =
      static_cast<std::size_t>(element) * static_cast<std::size_t>(fem::nodesPerElement(block.topology));
  const auto local = fem::sideNodes(block.topology, side);
  std::vector<Vector3> corners;
  for (int i = 0; i < fem::numCorners(fem::sideFace(block.topology, side)); ++i) {
    const double* const x = &mesh.coordinates[3 * static_cast<std::size_t>(block.nodes[first + local[i]])];
    corners.push_back({x[0], x[1], x[2]});
  }
  return corners;
}

/// Whether the body is between the middle of the side and the tool: out of the side is away from the tool.
bool isAway(const Side& side, const contact::RigidTool& tool) {
  const double place[4] = {side.middle[0], side.middle[1], side.middle[2], 0};
  const contact::ToolProjection over = tool.project(place);
  if (!(over.gap > 0) || !std::isfinite(over.gap)) return false;
  constexpr double turned = 0.5;  // within 60 degrees of straight away
  return dot(side.out, over.normal) > turned * length(side.out);
}

}  // namespace

std::string sidesAway(const ContactPoints& contact, const deck::Deck& deck, const fem::Mesh& mesh) {
  const auto entry = std::find_if(deck.contacts.begin(), deck.contacts.end(),
                                  [&](const deck::Contact& c) { return c.name == contact.name; });
  if (entry == deck.contacts.end() || entry->points == deck::Contact::Points::Nodes) return {};
  const fem::SideSet& set = sidesOf(mesh, entry->set);
  std::size_t away = 0, all = 0;
  for (const fem::Side& side : set.sides) {
    const auto [b, e] = fem::addressOf(mesh, side.element);
    const fem::Block& block = mesh.blocks[b];
    if (fem::isShell(block.topology)) continue;
    ++all;
    away += isAway(sideOf(cornersOf(mesh, block, e, side.side)), *contact.atStart) ? 1 : 0;
  }
  if (away == 0 || 2 * away < all) return {};
  return fmt::format(
      "contact/{}: {} of the {} sides in '{}' look away from '{}', with the body between; a set "
      "without them has fewer points",
      contact.name, away, all, entry->set, entry->tool);
}

}  // namespace atrapos
