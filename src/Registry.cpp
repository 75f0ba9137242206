#include "Registry.hpp"

#include <cmath>
#include <type_traits>
#include <variant>

#include "atrapos/contact/ContactLaw.hpp"
#include "atrapos/fem/LawTerm.hpp"
#include "atrapos/solid/SaintVenantKirchhoff.hpp"
#include "atrapos/solid/ShellPoints.hpp"

namespace atrapos::registry {
namespace {

std::array<double, 3> unit(const deck::Vector3& v) {
  const double length = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  return {v[0] / length, v[1] / length, v[2] / length};
}

void copy(const std::array<double, 3>& from, double (&to)[3]) { std::copy(from.begin(), from.end(), to); }

double radians(double degrees) { return degrees * std::acos(-1.0) / 180; }

// ------------------------------------------------------------------ deck entry -> law, one line each
solid::SaintVenantKirchhoff law(const deck::SaintVenantKirchhoff& m) {
  return solid::SaintVenantKirchhoff::fromYoung(m.youngsModulus, m.poissonsRatio);
}

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

/// By coefficients or by a table: two laws.
std::variant<contact::CrownedRoll, contact::TabulatedRoll> tool(const deck::CrownedRollTool& t) {
  const auto placed = [&](auto roll) {
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

template <class T, class F>
auto onTool(const F& f, const T& tool) {
  return f(tool);
}
template <class... T, class F>
auto onTool(const F& f, const std::variant<T...>& tool) {
  return std::visit(f, tool);
}

/// f(the tool of the package) for the tool of a deck.
template <class F>
auto withTool(const deck::Tool& entry, const F& f) {
  return std::visit([&](const auto& surface) { return onTool(f, tool(surface)); }, entry.surface);
}

}  // namespace

std::unique_ptr<fem::Term> materialTerm(const deck::Material& material, const fem::PointSet& points) {
  return std::visit(
      [&](const auto& entry) -> std::unique_ptr<fem::Term> {
        using Law = decltype(law(entry));
        return std::make_unique<fem::LawTerm<Law, fem::DisplacementGradient>>(law(entry), points);
      },
      material.law);
}

std::unique_ptr<fem::Term> shellTerm(const deck::Material& material, const fem::EnhancedPoints& points) {
  return std::visit(
      [&](const auto& entry) -> std::unique_ptr<fem::Term> {
        using Law = decltype(law(entry));
        return std::make_unique<solid::ShellTerm<Law>>(solid::ShellLaw<Law>{law(entry)}, points);
      },
      material.law);
}

void validate(const deck::Tool& entry) {
  withTool(entry, [](const auto& rigid) { rigid.validate(); });
}

std::string ambiguity(const deck::Tool& entry, const double* x) {
  return withTool(entry, [&](const auto& rigid) -> std::string { return rigid.ambiguity(x); });
}

std::array<double, 4> project(const deck::Tool& entry, const double* x) {
  return withTool(entry, [&](const auto& rigid) {
    constexpr int unknowns = std::decay_t<decltype(rigid)>::numUnknowns;
    double y[unknowns];
    taylor::solveImplicit<3, unknowns>(rigid, x, y);
    return std::array<double, 4>{y[0], y[1], y[2], y[3]};
  });
}

std::unique_ptr<fem::Term> contactTerm(const deck::Tool& entry, const contact::RegularisedPressure& pressure,
                                       const fem::PointSet& points,
                                       const std::vector<double>& referenceGaps) {
  return withTool(entry, [&](const auto& rigid) -> std::unique_ptr<fem::Term> {
    using Law = contact::ContactLaw<std::decay_t<decltype(rigid)>>;
    return std::make_unique<fem::LawTerm<Law, fem::CurrentPosition>>(Law{rigid, pressure}, points,
                                                                     referenceGaps);
  });
}

}  // namespace atrapos::registry
