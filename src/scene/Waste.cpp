#include "scene/Waste.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "scene/ContactWaste.hpp"
#include "scene/Extents.hpp"
#include "scene/Sets.hpp"

namespace atrapos {
namespace {

std::string thinBody(const fem::Mesh& mesh, const fem::Block& block) {
  constexpr double thin = 20;  // what shells leave out is a thousandth of the bending then, (t/L)^2
  auto sides = extentsOf(mesh, block).body;
  std::sort(sides.begin(), sides.end());
  if (!(sides[0] > 0 && sides[1] >= thin * sides[0])) return {};
  return fmt::format(
      "block '{}': {} in a body {:.3g} thick and {:.3g} wide; shells (docs/shells.md) bend as well with "
      "fewer unknowns, where stresses across the thickness do not matter",
      block.name, fem::topologyName(block.topology), sides[0], sides[1]);
}

/// Nodes whose displacement along an axis supports hold at zero.
std::set<int> heldAlong(const deck::Deck& deck, const fem::Mesh& mesh, int axis) {
  std::set<int> held;
  for (const deck::Support& support : deck.supports) {
    const auto& component = support.components[axis];
    if (!component || component->driven() || component->value != 0 || !component->valueFormula.empty())
      continue;
    const auto nodes = nodesOf(mesh, support.set);
    held.insert(nodes.begin(), nodes.end());
  }
  return held;
}

/// One cell along the axis, and both of its faces held: what is between them moves by nothing either.
bool standsStillAlong(const deck::Deck& deck, const fem::Mesh& mesh, int axis) {
  const auto place = [&](int n) {
    return mesh.coordinates[3 * static_cast<std::size_t>(n) + static_cast<std::size_t>(axis)];
  };
  const auto [low, high] = rangeAlong(mesh, axis);
  const double near = 1e-9 * (high - low);  // rounding
  for (const fem::Block& block : mesh.blocks)
    if (!fem::isSolid(block.topology) || extentsOf(mesh, block).cell[axis] < high - low - near) return false;
  const auto held = heldAlong(deck, mesh, axis);
  for (int n = 0; n < mesh.numNodes(); ++n)
    if ((place(n) - low <= near || high - place(n) <= near) && held.count(n) == 0) return false;
  return true;
}

std::string wastefulOrder(const deck::Deck& deck) {
  constexpr int lowest = 8, highest = 30;
  const auto& path = deck.path;
  if (!path.series() || path.autoOrder) return {};
  const bool smooth = deck.contacts.empty() &&
                      std::none_of(deck.materials.begin(), deck.materials.end(), [](const deck::Material& m) {
                        return std::holds_alternative<deck::VonMises>(m.law);
                      });
  // Between events that are near a few orders do.
  if (path.order < lowest && smooth)
    return fmt::format(
        "path/order: {} takes several times the factorizations of 20, the default: 5 takes 8 to 25 times as "
        "many (docs/chart.md)",
        path.order);
  if (path.order > highest)
    return fmt::format("path/order: {} costs more than 30 and reaches no farther (docs/chart.md)",
                       path.order);
  return {};
}

}  // namespace

std::vector<std::string> waste(const Scene& scene) {
  const deck::Deck& deck = scene.deck();
  const fem::Mesh& mesh = scene.mesh();
  std::vector<std::string> lines;
  for (int axis = 0; mesh.dimension == 3 && axis < 3; ++axis)
    if (standsStillAlong(deck, mesh, axis))
      lines.push_back(fmt::format(
          "nothing moves along {}: a plane body (plane: {{kind: strain}}) has a third of the unknowns "
          "and the same answer",
          "xyz"[axis]));
  if (lines.empty())
    for (const fem::Block& block : mesh.blocks)
      if (fem::isSolid(block.topology))
        if (std::string line = thinBody(mesh, block); !line.empty()) lines.push_back(std::move(line));
  for (const ContactPoints& contact : scene.contacts())
    if (std::string line = sidesAway(contact, deck, mesh); !line.empty()) lines.push_back(std::move(line));
  if (std::string line = wastefulOrder(deck); !line.empty()) lines.push_back(std::move(line));
  return lines;
}

}  // namespace atrapos
