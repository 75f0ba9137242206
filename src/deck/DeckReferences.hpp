#pragma once

#include "deck/Deck.hpp"
#include "deck/DeckValue.hpp"

namespace atrapos::deck {

/// Checks what involves several blocks: names of other entries, a load factor that has something to drive.
/// Throws DeckError.
void checkReferences(const Value& root, const Deck& deck);

/// Checks that the deck asks of Newton steps only what they can do, and sets what they fix. Throws DeckError.
void checkMethod(const Value& root, Deck& deck);

/// Checks that what the deck asks for at bifurcation points can be done. Throws DeckError.
void checkBranches(const Value& root, const Deck& deck);

}  // namespace atrapos::deck
