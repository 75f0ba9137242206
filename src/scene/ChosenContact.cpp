#include "scene/ChosenContact.hpp"

#include <algorithm>
#include <vector>

#include "atrapos/fem/ReferenceCell.hpp"
#include "scene/Sets.hpp"

namespace atrapos {
namespace {

using deck::Contact;

/// Whether the tool goes on along straight lines, or nearly: a body that bends touches it along these.
bool isRoll(const deck::Tool& tool) {
  const auto& surface = tool.surface;
  return std::holds_alternative<deck::CylinderTool>(surface) ||
         std::holds_alternative<deck::ConeTool>(surface) ||
         std::holds_alternative<deck::TaperedRollTool>(surface) ||
         std::holds_alternative<deck::CrownedRollTool>(surface);
}

/// Whether something asks for the pressure as a function of the gap at points that stay, far ones too.
bool needsPressure(const Contact& contact, const ContactSurroundings& around) {
  const deck::Deck& deck = around.deck;
  return around.holds || deck.path.sharpen ||
         std::any_of(deck.loads.begin(), deck.loads.end(), [&](const deck::Load& load) {
           const auto* inflow = std::get_if<deck::InflowLoad>(&load.load);
           return inflow != nullptr && inflow->contact == contact.name;
         });
}

/// Newton's method and iterations have no hard contact.
bool mayBeHard(const deck::Deck& deck) { return deck.path.series() && !deck.solver.mayIterate(); }

bool hasTriangles(const Contact& contact, const fem::Mesh& mesh) {
  const auto& sides = sidesOf(mesh, contact.set).sides;
  return std::any_of(sides.begin(), sides.end(), [&](const fem::Side& side) {
    const fem::Block& block = mesh.blocks[fem::addressOf(mesh, side.element).block];
    return fem::numCorners(fem::sideFace(block.topology, side.side)) == 3;
  });
}

bool meetsAlongLines(const Contact& contact, const ContactSurroundings& around) {
  const bool lines = around.mesh.dimension == 2
                         ? !std::holds_alternative<deck::PatchesTool>(around.tool.surface)
                         : isRoll(around.tool);
  return lines && around.body.isSlender() && !hasTriangles(contact, around.mesh) &&
         !liesOnTool(contact, around.mesh, around.atStart, around.body.thickness);
}

}  // namespace

bool liesOnTool(const Contact& contact, const fem::Mesh& mesh, const contact::RigidTool& atStart,
                double thickness) {
  if (deck::isAtNodes(contact, mesh)) return false;
  const auto touches = [&](int node) {
    const double* x = &mesh.coordinates[3 * static_cast<std::size_t>(node)];
    const double place[4] = {x[0], x[1], x[2], 0};
    return atStart.project(place).gap < 1e-9 * thickness;
  };
  const auto& sides = sidesOf(mesh, contact.set).sides;
  return std::any_of(sides.begin(), sides.end(), [&](const fem::Side& side) {
    const std::vector<int> nodes = fem::nodesOf(mesh, {"", 0, {side}});
    return std::all_of(nodes.begin(), nodes.end(), touches);
  });
}

Contact chosenContact(const Contact& contact, const ContactSurroundings& around) {
  using Points = Contact::Points;
  using Law = Contact::Law;
  Contact chosen = contact;
  const bool pressure = needsPressure(contact, around);
  const auto zones = [&] {
    return contact.hasEdge() || (contact.law == Law::Auto && !pressure && meetsAlongLines(contact, around));
  };
  if (deck::isAtNodes(contact, around.mesh))
    chosen.points = Points::Nodes;
  else if (contact.points == Points::Auto)
    chosen.points = zones() ? Points::Zones : Points::Quadrature;
  if (contact.law == Law::Auto)
    chosen.law = chosen.points == Points::Zones        ? Law::Linear
                 : !pressure && mayBeHard(around.deck) ? Law::Hard
                                                       : Law::Hyperbola;
  return chosen;
}

std::string choiceMade(const Contact& asked, const Contact& chosen) {
  std::string text;
  if (asked.points != chosen.points)
    text += chosen.points == Contact::Points::Zones   ? "points zones (chosen), "
            : chosen.points == Contact::Points::Nodes ? "points nodes (chosen), "
                                                      : "points quadrature (chosen), ";
  if (asked.law != chosen.law) text += "law (chosen) ";
  return text;
}

}  // namespace atrapos
