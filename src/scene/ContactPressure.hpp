#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "atrapos/contact/OneOf.hpp"
#include "atrapos/contact/Overclosure.hpp"
#include "deck/Deck.hpp"

namespace atrapos {

/// Size and stiffness of what is pressed on a tool, in the deck's units.
struct BodySize {
  double youngsModulus = 0;  ///< the largest of the deck
  double length = 0;         ///< largest extent of the body, of plane cells in their plane
  double thickness =
      0;  ///< volume over the product of the two largest extents, of plane cells area over length
  double smallestGap = 0;   ///< > 0, of the contact's points at the start
  double areaPerPoint = 1;  ///< of law points at nodes: forces instead of pressures; 1 at face points
  double shortestLine = 0;  ///< of a contact with zones, the shortest of its lines; 0: it has none
  /// Whether it bends rather than yields where it is pressed.
  bool isSlender() const { return thickness < 0.2 * length; }
};

/// A pressure law with all of its numbers.
struct ContactPressure {
  bool hard = false;  ///< no law: h >= 0, R >= 0, h R = 0
  contact::AnyPressure law;
  std::optional<contact::RegularisedPressure> regularised;  ///< the law where it is (15)
  std::optional<contact::Overclosure> overclosure;          ///< the law of zones
  double leastReference = 0;  ///< least sensible Delta of a point that touches at the start; 0: none
  double closedGap = 0;       ///< a point with a smaller gap is closed; < 0: 1e-3 of its reference gap
  std::string text;           ///< name and numbers, with (chosen) after those that the deck leaves open
  /// Constants of the law by their names in decks, in this order.
  std::vector<std::pair<std::string, double>> numbers;
};

/// The law of a contact. Numbers that the deck leaves open come from the body (docs/theory/contact.md,
/// Defaults). Throws std::invalid_argument, one line, where they make no law.
ContactPressure contactPressure(const deck::Contact& contact, const BodySize& body);

}  // namespace atrapos
