#include "import/InpRigidMotions.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace atrapos::importer {
namespace {

using Components = std::array<std::optional<double>, 3>;

/// Components from `first` on of a node's support; none where it has none.
Components componentsOf(const InpStep& step, int node, std::size_t first) {
  Components found;
  const auto support = step.supports.find(node);
  if (support == step.supports.end()) return found;
  for (std::size_t d = 0; d < 3; ++d) found[d] = support->second.value[first + d];
  return found;
}

std::size_t heldOf(const Components& c) {
  return static_cast<std::size_t>(
      std::count_if(c.begin(), c.end(), [](const auto& v) { return v.has_value(); }));
}

}  // namespace

InpRigidMotions::InpRigidMotions(InpModel& model, InpStep& step) {
  const bool plane = std::any_of(model.elements.begin(), model.elements.end(),
                                 [](const InpElement& e) { return fem::isPlane(e.type->topology); });
  for (const InpRigidBody& body : model.rigidBodies) {
    if (plane) body.place.fail("*RIGID BODY: decks have none of plane bodies");
    add(body, step);
  }
}

void InpRigidMotions::add(const InpRigidBody& body, InpStep& step) {
  Components turns = componentsOf(step, body.reference, 3);
  if (body.rotation >= 0) {
    const Components own = componentsOf(step, body.rotation, 0);
    for (std::size_t d = 0; d < 3; ++d)
      if (own[d]) turns[d] = own[d];
    step.supports.erase(body.rotation);
    if (const auto own = step.forces.find(body.rotation); own != step.forces.end()) {
      auto& moments = step.moments[body.reference];
      for (std::size_t d = 0; d < 3; ++d) moments[d] += own->second[d];
      step.forces.erase(own);
    }
  }
  const auto moments = step.moments.find(body.reference);
  const std::array<double, 3> moment =
      moments == step.moments.end() ? std::array<double, 3>{} : moments->second;
  const bool loaded = moment != std::array<double, 3>{};
  const auto driven = [](const auto& turn) { return turn.value_or(0) != 0; };
  const auto numDriven = std::count_if(turns.begin(), turns.end(), driven);
  if (heldOf(turns) == 0) {
    if (loaded)
      body.place.fail(
          "*RIGID BODY: a moment on a body that turns in all directions; decks have moments about an axis");
    couplings_.push_back({true, body.nodes, body.reference});
    return;
  }
  // About one axis: the others' turns are held.
  const bool isFree = heldOf(turns) == 2 && numDriven == 0;
  if (isFree || (heldOf(turns) == 3 && numDriven == 1)) {
    Coupling c{true, body.nodes, body.reference};
    const auto at = isFree ? std::find(turns.begin(), turns.end(), std::nullopt)
                           : std::find_if(turns.begin(), turns.end(), driven);
    c.axis = static_cast<int>(at - turns.begin());
    c.angle = at->value_or(0) * 180 / std::acos(-1.0);
    if (isFree) c.moment = moment[static_cast<std::size_t>(c.axis)];
    couplings_.push_back(std::move(c));
    return;
  }
  if (heldOf(turns) < 3 || numDriven > 0)
    body.place.fail(
        "*RIGID BODY: turns about more than one axis, or about two freely; decks have bodies that turn "
        "freely, "
        "about one axis or not at all");

  const Components shift = componentsOf(step, body.reference, 0);
  step.supports.erase(body.reference);
  const bool given = heldOf(shift) == 3;
  for (const int node : body.nodes) {
    InpSupport& support = step.supports[node];
    support.place = body.place;
    for (std::size_t d = 3; d < 6; ++d) support.value[d] = 0;
    if (given || node == body.nodes.front())
      for (std::size_t d = 0; d < 3; ++d)
        if (shift[d]) support.value[d] = shift[d];
  }
  if (const auto force = step.forces.find(body.reference); force != step.forces.end()) {
    const auto value = force->second;  // at any node of the body
    step.forces.erase(force);
    for (std::size_t d = 0; d < 3; ++d) step.forces[body.nodes.front()][d] += value[d];
  }
  if (!given) couplings_.push_back({false, body.nodes, -1});
}

std::vector<int> InpRigidMotions::references() const {
  std::vector<int> nodes;
  for (const Coupling& c : couplings_)
    if (c.reference >= 0) nodes.push_back(c.reference);
  return nodes;
}

}  // namespace atrapos::importer
