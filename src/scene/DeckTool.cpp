// Deck entry -> tool of the package: one function each.
#include "scene/DeckTool.hpp"

#include "scene/Degrees.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <variant>

namespace atrapos {
namespace {

std::array<double, 3> unit(const deck::Vector3& v) {
  const double length = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  return {v[0] / length, v[1] / length, v[2] / length};
}

void copy(const std::array<double, 3>& from, double (&to)[3]) { std::copy(from.begin(), from.end(), to); }

contact::Plane tool(const deck::PlaneTool& t) {
  contact::Plane plane;
  copy(t.point, plane.point);
  copy(unit(t.normal), plane.normal);
  return plane;
}

contact::Cylinder tool(const deck::CylinderTool& t) {
  contact::Cylinder cylinder;
  copy(t.center, cylinder.center);
  copy(unit(t.axis), cylinder.axis);
  cylinder.radius = t.radius;
  cylinder.inside = t.side == deck::Side::Inside;
  return cylinder;
}

contact::Sphere tool(const deck::SphereTool& t) {
  contact::Sphere sphere;
  copy(t.center, sphere.center);
  sphere.radius = t.radius;
  sphere.inside = t.side == deck::Side::Inside;
  return sphere;
}

contact::Cone tool(const deck::ConeTool& t) {
  contact::Cone cone;
  copy(t.apex, cone.apex);
  copy(unit(t.axis), cone.axis);
  cone.halfAngle = radians(t.halfAngle);
  cone.inside = t.side == deck::Side::Inside;
  return cone;
}

contact::Torus tool(const deck::TorusTool& t) {
  contact::Torus torus;
  copy(t.center, torus.center);
  copy(unit(t.axis), torus.axis);
  torus.radius = t.radius;
  torus.tubeRadius = t.tubeRadius;
  torus.inside = t.side == deck::Side::Inside;
  return torus;
}

contact::TaperedRoll tool(const deck::TaperedRollTool& t) {
  contact::TaperedRoll roll;
  copy(t.center, roll.center);
  copy(unit(t.axis), roll.axis);
  roll.profile = {t.radius, t.flat, radians(t.angle), t.smoothing,
                  t.ends == deck::TaperedRollTool::Ends::Both};
  return roll;
}

contact::AnyTool tool(const deck::CrownedRollTool& t) {
  const auto placed = [&](auto roll) -> contact::AnyTool {
    copy(t.center, roll.center);
    copy(unit(t.axis), roll.axis);
    return roll;
  };
  if (t.coefficients.empty()) {
    contact::TabulatedRoll roll;
    roll.profile = contact::TableProfile::through(t.places, t.radii);
    return placed(roll);
  }
  contact::CrownedRoll roll;
  roll.profile = contact::PolynomialProfile::of(t.coefficients);
  return placed(roll);
}

std::vector<contact::BezierPatch> patches(const deck::SplineSurface& s) {
  if (s.knots[0].empty() && s.knots[1].empty()) return {contact::BezierPatch{s.degree, s.points, s.weights}};
  contact::NurbsSurface surface;
  surface.degree = s.degree;
  surface.knots = s.knots;
  surface.points = s.points;
  surface.weights = s.weights;
  for (std::size_t d = 0; d < 2; ++d) {
    if (s.knots[d].empty())
      throw std::invalid_argument("knots_" + std::to_string(d + 1) +
                                  " is missing beside the other direction's");
    surface.count[d] = static_cast<int>(s.knots[d].size()) - s.degree[d] - 1;
  }
  return surface.patches();
}

}  // namespace

contact::Motion toolMotion(const deck::ToolMotion& m) {
  contact::Motion motion;
  double power = 1;
  for (std::size_t k = 0; k < std::max(m.shift.size(), m.angle.size()); ++k) {
    power *= m.heldAt.value_or(0);
    const std::size_t at = m.heldAt ? 0 : k + 1;  // held: a constant
    const double factor = m.heldAt ? power : 1;
    for (int i = 0; k < m.shift.size() && i < 3; ++i) motion.shift[at][i] += factor * m.shift[k][i];
    if (k < m.angle.size()) motion.angle[at] += factor * radians(m.angle[k]);
  }
  copy(unit(m.axis), motion.axis);
  copy(m.pivot, motion.pivot);
  return motion;
}

std::vector<contact::BezierPatch> bezierPatches(const deck::PatchesTool& t) {
  std::vector<contact::BezierPatch> all;
  for (const deck::SplineSurface& surface : t.surfaces) try {
      const auto pieces = patches(surface);
      for (const contact::BezierPatch& piece : pieces) piece.validate();
      all.insert(all.end(), pieces.begin(), pieces.end());
    } catch (const std::invalid_argument& e) {
      throw std::invalid_argument("surface '" + surface.name + "': " + e.what());
    }
  return all;
}

std::unique_ptr<contact::RigidTool> makeTool(const deck::Tool& entry) {
  constexpr double unlimited = std::numeric_limits<double>::infinity();
  std::optional<contact::Motion> moves;
  if (entry.motion.moves()) moves = toolMotion(entry.motion);
  if (const auto* t = std::get_if<deck::PatchesTool>(&entry.surface))
    return contact::rigidTool(
        std::make_shared<contact::PatchSet>(bezierPatches(*t), t->reversed, t->thickness.value_or(unlimited)),
        moves);
  const contact::AnyTool rigid = std::visit(
      [](const auto& t) -> contact::AnyTool {
        if constexpr (std::is_same_v<decltype(t), const deck::PatchesTool&>)
          throw std::logic_error("makeTool: patches are made above");
        else
          return tool(t);
      },
      entry.surface);
  return contact::rigidTool(rigid, moves);
}

SceneTools sceneTools(const deck::Deck& deck) {
  SceneTools made;
  for (const deck::Tool& tool : deck.tools) try {
      made.tools.push_back(makeTool(tool));
      made.atStart.emplace_back();
      if (tool.motion.heldAt) {
        deck::Tool atStart = tool;
        atStart.motion.heldAt = 0;
        made.atStart.back() = makeTool(atStart);
      }
    } catch (const std::invalid_argument& e) {
      deck::failAt(deck, "tools/" + tool.name, e.what());
    }
  return made;
}

}  // namespace atrapos
