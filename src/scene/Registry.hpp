#pragma once

#include <memory>
#include <optional>

#include "atrapos/fem/PointSet.hpp"
#include "atrapos/fem/Term.hpp"
#include "atrapos/physics/Expansion.hpp"
#include "atrapos/solid/PlaneBody.hpp"
#include "atrapos/solid/ShellPoints.hpp"
#include "atrapos/solid/ThinBody.hpp"
#include "deck/Deck.hpp"

/// The materials that decks can name. A new one is one struct in its package and one line in Registry.cpp.
namespace atrapos::registry {

/// The term of a material at volume points, or at those of a plane body.
std::unique_ptr<fem::Term> materialTerm(const deck::Material& material, const fem::PointSet& points,
                                        const std::optional<solid::PlaneSection>& plane);

/// The same with an expansion (physics::expandingLaw), at points that have the values of its field.
std::unique_ptr<fem::Term> expandingTerm(const deck::Material& material, const physics::Expansion& expansion,
                                         const fem::PointSet& points,
                                         const std::optional<solid::PlaneSection>& plane);

/// The same in an electric field (physics::Dielectric), at points that have its gradients.
std::unique_ptr<fem::Term> dielectricTerm(const deck::Material& material, const fem::PointSet& points,
                                          const std::optional<solid::PlaneSection>& plane);

/// The same with pressures, at points that have them.
std::unique_ptr<fem::Term> mixedTerm(const deck::Material& material, const fem::Mesh& mesh,
                                     const fem::Block& block, const fem::PointSet& points,
                                     const std::optional<solid::PlaneSection>& plane);

/// The term of a material in shells; the stage of its expansion may be null. Throws std::runtime_error where
/// an element cannot be (solid::shellPoints).
std::unique_ptr<fem::Term> shellTerm(const deck::Material& material, const solid::ShellElements& elements,
                                     const solid::ShellCubature& cubature, deck::Shear shear,
                                     physics::ShellExpansion expansion);

/// The term of a material in membranes, or in bars.
std::unique_ptr<fem::Term> thinTerm(const deck::Material& material, bool bars,
                                    const solid::ThinPoints& points, const solid::ThinSection& section);

}  // namespace atrapos::registry
