#include "scene/Registry.hpp"

#include <variant>

#include "atrapos/fem/EnhancedTerm.hpp"
#include "atrapos/fem/LawTerm.hpp"
#include "atrapos/solid/SaintVenantKirchhoff.hpp"

namespace atrapos::registry {
namespace {

// ------------------------------------------------------------------ deck entry -> law, one line each
solid::SaintVenantKirchhoff law(const deck::SaintVenantKirchhoff& m) {
  return solid::SaintVenantKirchhoff::fromYoung(m.youngsModulus, m.poissonsRatio);
}

}  // namespace

std::unique_ptr<fem::Term> materialTerm(const deck::Material& material, const fem::PointSet& points,
                                        const std::optional<solid::PlaneSection>& plane) {
  return std::visit(
      [&](const auto& entry) -> std::unique_ptr<fem::Term> {
        auto inSpace = fem::pointLaw(law(entry));
        return fem::lawTerm(plane ? solid::planeLaw(std::move(inSpace), plane->kind) : std::move(inSpace),
                            points);
      },
      material.law);
}

std::unique_ptr<fem::Term> shellTerm(const deck::Material& material, const solid::ShellElements& elements,
                                     deck::Shear shear) {
  return std::visit(
      [&](const auto& entry) -> std::unique_ptr<fem::Term> {
        using Law = decltype(law(entry));
        if (shear == deck::Shear::Assumed)
          return fem::enhancedTerm(fem::pointLaw(solid::AssumedShearLaw<Law>{law(entry)}),
                                   solid::assumedShearPoints(elements));
        return fem::enhancedTerm(fem::pointLaw(solid::ShellLaw<Law>{law(entry)}),
                                 solid::shellPoints(elements));
      },
      material.law);
}

}  // namespace atrapos::registry
