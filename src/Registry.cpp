#include "Registry.hpp"

#include <cmath>

#include "atrapos/contact/ContactLaw.hpp"
#include "atrapos/fem/LawTerm.hpp"
#include "atrapos/solid/SaintVenantKirchhoff.hpp"

namespace atrapos::registry {
namespace {

std::array<double, 3> unit(const deck::Vector3& v) {
  const double length = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  return {v[0] / length, v[1] / length, v[2] / length};
}

void copy(const std::array<double, 3>& from, double (&to)[3]) { std::copy(from.begin(), from.end(), to); }

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
  return cylinder;
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

std::array<double, 4> project(const deck::Tool& entry, const double* x) {
  return std::visit(
      [&](const auto& surface) {
        const auto rigid = tool(surface);
        double y[decltype(rigid)::numUnknowns];
        taylor::solveImplicit<3, decltype(rigid)::numUnknowns>(rigid, x, y);
        return std::array<double, 4>{y[0], y[1], y[2], y[3]};
      },
      entry.surface);
}

std::unique_ptr<fem::Term> contactTerm(const deck::Tool& entry, const contact::RegularisedPressure& pressure,
                                       const fem::PointSet& points,
                                       const std::vector<double>& referenceGaps) {
  return std::visit(
      [&](const auto& surface) -> std::unique_ptr<fem::Term> {
        using Law = contact::ContactLaw<decltype(tool(surface))>;
        return std::make_unique<fem::LawTerm<Law, fem::CurrentPosition>>(Law{tool(surface), pressure}, points,
                                                                         referenceGaps);
      },
      entry.surface);
}

}  // namespace atrapos::registry
