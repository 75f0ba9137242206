#pragma once

#include <string>

#include "atrapos/contact/RigidTool.hpp"
#include "atrapos/fem/Mesh.hpp"
#include "deck/Deck.hpp"
#include "scene/ContactPressure.hpp"

namespace atrapos {

/// What the law and the points of a contact are chosen by.
struct ContactSurroundings {
  const deck::Deck& deck;
  const fem::Mesh& mesh;
  const deck::Tool& tool;             ///< the contact's
  const contact::RigidTool& atStart;  ///< the same where the path starts
  const BodySize& body;
  bool holds;  ///< some of the body is held by nothing but contacts, none of which it lies on
};

/// Whether a side of the contact's set lies on the tool with all of its nodes where the path starts.
bool liesOnTool(const deck::Contact& contact, const fem::Mesh& mesh, const contact::RigidTool& atStart,
                double thickness);

/// The contact with the law and the points that the deck leaves open (docs/deck.md, `contact`): zones where a
/// slender body meets a tool along lines, else hard contact; the hyperbola of law (15), which acts from afar,
/// where these cannot be.
deck::Contact chosenContact(const deck::Contact& contact, const ContactSurroundings& around);

/// The beginning of its description: what was left open. Empty where nothing was.
std::string choiceMade(const deck::Contact& asked, const deck::Contact& chosen);

}  // namespace atrapos
