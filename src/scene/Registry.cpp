#include "scene/Registry.hpp"

#include <cmath>
#include <stdexcept>
#include <variant>

#include "atrapos/fem/EnhancedTerm.hpp"
#include "atrapos/fem/LawTerm.hpp"
#include "atrapos/physics/Dielectric.hpp"
#include "atrapos/solid/FiniteVonMises.hpp"
#include "atrapos/solid/MixedBody.hpp"
#include "atrapos/solid/MixedLaw.hpp"
#include "atrapos/solid/SaintVenantKirchhoff.hpp"
#include "atrapos/solid/ShellTerms.hpp"
#include "atrapos/solid/VonMises.hpp"

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
solid::Ogden law(const deck::Ogden& m) {
  return withBulk(m.bulkModulus, [&](double bulk) { return solid::Ogden::fromModuli(m.mu, m.alpha, bulk); });
}

std::unique_ptr<fem::PointLaw> inBody(std::unique_ptr<fem::PointLaw> law,
                                      const std::optional<solid::PlaneSection>& plane) {
  return plane ? solid::planeLaw(std::move(law), plane->kind) : std::move(law);
}

std::unique_ptr<fem::PointLaw> mixedLaw(const deck::SaintVenantKirchhoff&, const fem::Mesh&,
                                        const fem::Block&) {
  throw std::logic_error("registry: saint_venant_kirchhoff with pressures");  // decks are checked
}
std::unique_ptr<fem::PointLaw> mixedLaw(const deck::VonMises&, const fem::Mesh&, const fem::Block&) {
  throw std::logic_error("registry: von_mises with pressures");
}
template <class Entry>
std::unique_ptr<fem::PointLaw> mixedLaw(const Entry& entry, const fem::Mesh& mesh, const fem::Block& block) {
  const auto rubber = law(entry);
  return fem::pointLaw(solid::MixedLaw<decltype(law(entry))>{
      rubber, solid::pressureScale(mesh, block, rubber.shearModulus())});
}

solid::Metal metal(const deck::VonMises& m) {
  solid::Metal plastic;
  plastic.yieldStress = m.yieldStress;
  plastic.modulus = m.hardeningModulus;
  plastic.saturation = m.saturation;
  plastic.exponent = m.exponent;
  plastic.kinematicModulus = m.kinematicModulus;
  plastic.recall = m.recall;
  plastic.width = m.yieldWidth;
  return solid::metalFromYoung(m.youngsModulus, m.poissonsRatio, plastic);
}

template <class Entry>
std::unique_ptr<fem::PointLaw> lawInSpace(const Entry& entry) {
  return fem::pointLaw(law(entry));
}
std::unique_ptr<fem::PointLaw> lawInSpace(const deck::VonMises& entry) {
  if (entry.strains == deck::VonMises::Strains::Finite)
    return fem::pointLaw(solid::FiniteVonMises{metal(entry)});
  if (entry.kinematicModulus > 0) return fem::pointLaw(solid::VonMises<true>{metal(entry)});
  return fem::pointLaw(solid::VonMises<false>{metal(entry)});
}

/// In the plane.
template <class Entry>
std::unique_ptr<fem::PointLaw> lawInPlane(const Entry& entry, solid::PlaneSection::Kind kind) {
  return solid::planeLaw(lawInSpace(entry), kind);
}
std::unique_ptr<fem::PointLaw> lawInPlane(const deck::VonMises& entry, solid::PlaneSection::Kind kind) {
  using Kind = solid::PlaneSection::Kind;
  if (kind != Kind::stress) return solid::planeLaw(lawInSpace(entry), kind);
  // It has eliminated the strain across itself.
  auto law = entry.kinematicModulus > 0 ? fem::pointLaw(solid::VonMises<true, true>{metal(entry)})
                                        : fem::pointLaw(solid::VonMises<false, true>{metal(entry)});
  return solid::planeLaw(std::move(law), Kind::strain);
}

/// The materials that are compiled with scalar fields.
template <class Entry>
constexpr bool inFields =
    std::is_same_v<Entry, deck::SaintVenantKirchhoff> || std::is_same_v<Entry, deck::NeoHookean> ||
    std::is_same_v<Entry, deck::MooneyRivlin>;

template <class Entry>
std::unique_ptr<fem::PointLaw> dielectric(const Entry& entry, double permittivity) {
  if constexpr (inFields<Entry>)
    return fem::pointLaw(physics::Dielectric<decltype(law(entry))>{law(entry), permittivity});
  else
    throw std::logic_error("registry: an electric field in another material");  // decks are checked
}

template <class Entry>
std::unique_ptr<fem::PointLaw> expanding(const Entry& entry, const physics::Expansion& expansion) {
  if constexpr (inFields<Entry>)
    return physics::expandingLaw(law(entry), expansion);
  else
    throw std::logic_error("registry: an expansion of another material");  // decks are checked
}

// ------------------------------------------------------------------ Poisson's ratio at rest
double poissonsRatio(double lambda, double mu) { return lambda / (2 * (lambda + mu)); }
double poissonsRatio(const solid::SaintVenantKirchhoff& law) { return poissonsRatio(law.lambda, law.mu); }
double poissonsRatio(const solid::NeoHookean& law) { return poissonsRatio(law.lambda, law.mu); }
template <class Rubber>
double poissonsRatio(const Rubber& law) {
  const double mu = law.shearModulus();
  return poissonsRatio(law.bulk - 2 * mu / 3, mu);
}

solid::ShellStrains strainsOf(deck::Shear shear) {
  return shear == deck::Shear::Assumed ? solid::ShellStrains::assumedShear : solid::ShellStrains::compatible;
}

std::unique_ptr<fem::Term> shells(const deck::VonMises& entry, const solid::ShellElements& elements,
                                  const solid::ShellCubature& cubature, deck::Shear shear) {
  return solid::shellMetalTerm(metal(entry), elements, strainsOf(shear), cubature);
}
template <class Entry>
std::unique_ptr<fem::Term> shells(const Entry& entry, const solid::ShellElements& elements,
                                  const solid::ShellCubature& cubature, deck::Shear shear) {
  using Law = decltype(law(entry));
  if (elements.nodesPerElement == 3) {
    const Law material = law(entry);
    return fem::enhancedTerm(fem::pointLaw(solid::Mitc3Law<Law>{material}),
                             solid::mitc3Points(elements, poissonsRatio(material), cubature));
  }
  if (elements.nodesPerElement == 4) {
    const Law material = law(entry);
    return fem::enhancedTerm(fem::pointLaw(solid::Mitc4Law<Law>{material}),
                             solid::mitc4Points(elements, poissonsRatio(material), cubature));
  }
  if (elements.nodesPerElement == 6)
    return fem::enhancedTerm(
        solid::sixNodeShellLaw(fem::pointLaw(solid::ShellMaterialStage<Law>{law(entry)})),
        solid::mitc6Points(elements, cubature));
  if (shear == deck::Shear::Assumed)
    return fem::enhancedTerm(fem::pointLaw(solid::AssumedShearLaw<Law>{law(entry)}),
                             solid::assumedShearPoints(elements, cubature));
  return fem::enhancedTerm(fem::pointLaw(solid::ShellLaw<Law>{law(entry)}),
                           solid::shellPoints(elements, cubature));
}

template <class Entry>
std::unique_ptr<fem::Term> expandingShells(const Entry& entry, const solid::ShellElements& elements,
                                           const solid::ShellCubature& cubature, deck::Shear shear,
                                           physics::ShellExpansion expansion) {
  if constexpr (inFields<Entry>) {
    const auto material = law(entry);
    return solid::expandingShellTerm(elements, strainsOf(shear), poissonsRatio(material),
                                     fem::pointLaw(solid::ShellMaterialStage<decltype(law(entry))>{material}),
                                     std::move(expansion.stage), expansion.fields, cubature);
  } else {
    throw std::logic_error("registry: an expansion of another material");  // decks are checked
  }
}

std::unique_ptr<fem::PointLaw> thin(const deck::VonMises& entry, bool bars) {
  return bars ? solid::barLaw(metal(entry)) : solid::membraneLaw(metal(entry));
}
template <class Entry>
std::unique_ptr<fem::PointLaw> thin(const Entry& entry, bool bars) {
  auto material = fem::pointLaw(solid::ShellMaterialStage<decltype(law(entry))>{law(entry)});
  return bars ? solid::barLaw(std::move(material)) : solid::membraneLaw(std::move(material));
}

}  // namespace

std::unique_ptr<fem::Term> materialTerm(const deck::Material& material, const fem::PointSet& points,
                                        const std::optional<solid::PlaneSection>& plane) {
  return std::visit(
      [&](const auto& entry) -> std::unique_ptr<fem::Term> {
        auto law = plane ? lawInPlane(entry, plane->kind) : lawInSpace(entry);
        // What a law keeps begins with zeros.
        const std::vector<double> data(static_cast<std::size_t>(points.numPoints()) * law->shape().data);
        return fem::lawTerm(std::move(law), points, data);
      },
      material.law);
}

std::unique_ptr<fem::Term> expandingTerm(const deck::Material& material, const physics::Expansion& expansion,
                                         const fem::PointSet& points,
                                         const std::optional<solid::PlaneSection>& plane) {
  auto inSpace = std::visit(
      [&](const auto& entry) -> std::unique_ptr<fem::PointLaw> { return expanding(entry, expansion); },
      material.law);
  return fem::lawTerm(inBody(std::move(inSpace), plane), points, points.positions);
}

std::unique_ptr<fem::Term> dielectricTerm(const deck::Material& material, const fem::PointSet& points,
                                          const std::optional<solid::PlaneSection>& plane) {
  constexpr int acrossThePlane = 11;  // the gradient's part along z
  auto inSpace = std::visit(
      [&](const auto& entry) -> std::unique_ptr<fem::PointLaw> {
        return dielectric(entry, material.dielectric.value().permittivity);
      },
      material.law);
  return fem::lawTerm(
      plane ? solid::planeLaw(std::move(inSpace), plane->kind, acrossThePlane) : std::move(inSpace), points);
}

std::unique_ptr<fem::Term> mixedTerm(const deck::Material& material, const fem::Mesh& mesh,
                                     const fem::Block& block, const fem::PointSet& points,
                                     const std::optional<solid::PlaneSection>& plane) {
  return std::visit(
      [&](const auto& entry) { return fem::lawTerm(inBody(mixedLaw(entry, mesh, block), plane), points); },
      material.law);
}

std::unique_ptr<fem::Term> shellTerm(const deck::Material& material, const solid::ShellElements& elements,
                                     const solid::ShellCubature& cubature, deck::Shear shear,
                                     physics::ShellExpansion expansion) {
  return std::visit(
      [&](const auto& entry) -> std::unique_ptr<fem::Term> {
        if (expansion.stage) return expandingShells(entry, elements, cubature, shear, std::move(expansion));
        return shells(entry, elements, cubature, shear);
      },
      material.law);
}

std::unique_ptr<fem::Term> thinTerm(const deck::Material& material, bool bars,
                                    const solid::ThinPoints& points, const solid::ThinSection& section) {
  return solid::thinTerm(std::visit([&](const auto& entry) { return thin(entry, bars); }, material.law),
                         points, section);
}

}  // namespace atrapos::registry
