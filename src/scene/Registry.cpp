#include "scene/Registry.hpp"

#include <cmath>
#include <stdexcept>
#include <variant>

#include "atrapos/fem/EnhancedTerm.hpp"
#include "atrapos/fem/LawTerm.hpp"
#include "atrapos/solid/MixedBody.hpp"
#include "atrapos/solid/MixedLaw.hpp"
#include "atrapos/solid/SaintVenantKirchhoff.hpp"

namespace atrapos::registry {
namespace {

// What a law of rubber has in place of a bulk modulus that is infinite: MixedLaw divides by it and nothing
// else.
void setBulk(solid::NeoHookean& law, double bulk) { law.lambda = bulk; }
template <class Law>
void setBulk(Law& law, double bulk) {
  law.bulk = bulk;
}

/// The law with this bulk modulus, which may be infinite; `make` takes finite ones.
template <class Make>
auto withBulk(double bulk, const Make& make) {
  if (std::isfinite(bulk)) return make(bulk);
  auto law = make(1.0);
  setBulk(law, bulk);
  return law;
}

// ------------------------------------------------------------------ deck entry -> law, one line each
solid::SaintVenantKirchhoff law(const deck::SaintVenantKirchhoff& m) {
  return solid::SaintVenantKirchhoff::fromYoung(m.youngsModulus, m.poissonsRatio);
}
solid::NeoHookean law(const deck::NeoHookean& m) {
  return m.youngsModulus ? solid::NeoHookean::fromYoung(*m.youngsModulus, m.poissonsRatio.value())
                         : withBulk(m.bulkModulus.value(), [&](double bulk) {
                             return solid::NeoHookean::fromModuli(m.shearModulus.value(), bulk);
                           });
}
solid::MooneyRivlin law(const deck::MooneyRivlin& m) {
  return withBulk(m.bulkModulus,
                  [&](double bulk) { return solid::MooneyRivlin::fromModuli(m.c1, m.c2, bulk); });
}
solid::Yeoh law(const deck::Yeoh& m) {
  return withBulk(m.bulkModulus,
                  [&](double bulk) { return solid::Yeoh::fromModuli(m.c1, m.c2, m.c3, bulk); });
}
solid::Gent law(const deck::Gent& m) {
  return withBulk(m.bulkModulus,
                  [&](double bulk) { return solid::Gent::fromModuli(m.shearModulus, m.limit, bulk); });
}

std::unique_ptr<fem::PointLaw> inBody(std::unique_ptr<fem::PointLaw> law,
                                      const std::optional<solid::PlaneSection>& plane) {
  return plane ? solid::planeLaw(std::move(law), plane->kind) : std::move(law);
}

std::unique_ptr<fem::PointLaw> mixedLaw(const solid::SaintVenantKirchhoff&, const fem::Mesh&,
                                        const fem::Block&) {
  throw std::logic_error("registry: Saint Venant-Kirchhoff with pressures");  // decks are checked
}
template <class Law>
std::unique_ptr<fem::PointLaw> mixedLaw(const Law& law, const fem::Mesh& mesh, const fem::Block& block) {
  return fem::pointLaw(solid::MixedLaw<Law>{law, solid::pressureScale(mesh, block, law.shearModulus())});
}

}  // namespace

std::unique_ptr<fem::Term> materialTerm(const deck::Material& material, const fem::PointSet& points,
                                        const std::optional<solid::PlaneSection>& plane) {
  return std::visit(
      [&](const auto& entry) -> std::unique_ptr<fem::Term> {
        return fem::lawTerm(inBody(fem::pointLaw(law(entry)), plane), points);
      },
      material.law);
}

std::unique_ptr<fem::Term> mixedTerm(const deck::Material& material, const fem::Mesh& mesh,
                                     const fem::Block& block, const fem::PointSet& points,
                                     const std::optional<solid::PlaneSection>& plane) {
  return std::visit(
      [&](const auto& entry) {
        return fem::lawTerm(inBody(mixedLaw(law(entry), mesh, block), plane), points);
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
