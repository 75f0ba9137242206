#pragma once

#include <array>
#include <memory>
#include <string>

#include "atrapos/contact/RegularisedPressure.hpp"
#include "atrapos/fem/EnhancedTerm.hpp"
#include "atrapos/fem/PointSet.hpp"
#include "atrapos/fem/Term.hpp"
#include "deck/Deck.hpp"

/// The laws and tools that decks can name. A new one is one struct in its package and one line in
/// Registry.cpp.
namespace atrapos::registry {

/// The term of a material at volume points.
std::unique_ptr<fem::Term> materialTerm(const deck::Material& material, const fem::PointSet& points);

/// The term of a material in shells, at their points.
std::unique_ptr<fem::Term> shellTerm(const deck::Material& material, const fem::EnhancedPoints& points);

/// Throws std::invalid_argument, one line, where a tool's numbers make no surface.
void validate(const deck::Tool& tool);

/// Why the point at x has no unique projection, as the end of "the point ..."; empty where it has one.
std::string ambiguity(const deck::Tool& tool, const double* x);

/// Gap and normal of a tool seen from a place: h, n_x, n_y, n_z.
std::array<double, 4> project(const deck::Tool& tool, const double* x);

/// The term of a contact at face or node points; referenceGaps is [point].
std::unique_ptr<fem::Term> contactTerm(const deck::Tool& tool, const contact::RegularisedPressure& pressure,
                                       const fem::PointSet& points, const std::vector<double>& referenceGaps);

}  // namespace atrapos::registry
