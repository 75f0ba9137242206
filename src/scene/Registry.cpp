#include "scene/Registry.hpp"

#include <variant>

#include "atrapos/fem/EnhancedTerm.hpp"
#include "atrapos/fem/LawTerm.hpp"
#include "atrapos/solid/Gent.hpp"
#include "atrapos/solid/MooneyRivlin.hpp"
#include "atrapos/solid/NeoHookean.hpp"
#include "atrapos/solid/SaintVenantKirchhoff.hpp"
#include "atrapos/solid/Yeoh.hpp"

namespace atrapos::registry {
namespace {

// ------------------------------------------------------------------ deck entry -> law, one line each
solid::SaintVenantKirchhoff law(const deck::SaintVenantKirchhoff& m) {
  return solid::SaintVenantKirchhoff::fromYoung(m.youngsModulus, m.poissonsRatio);
}
solid::NeoHookean law(const deck::NeoHookean& m) {
  return m.youngsModulus ? solid::NeoHookean::fromYoung(*m.youngsModulus, m.poissonsRatio.value())
                         : solid::NeoHookean::fromModuli(m.shearModulus.value(), m.bulkModulus.value());
}
solid::MooneyRivlin law(const deck::MooneyRivlin& m) {
  return solid::MooneyRivlin::fromModuli(m.c1, m.c2, m.bulkModulus);
}
solid::Yeoh law(const deck::Yeoh& m) { return solid::Yeoh::fromModuli(m.c1, m.c2, m.c3, m.bulkModulus); }
solid::Gent law(const deck::Gent& m) {
  return solid::Gent::fromModuli(m.shearModulus, m.limit, m.bulkModulus);
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
