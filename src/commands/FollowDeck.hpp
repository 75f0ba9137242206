#pragma once

#include <functional>
#include <iosfwd>
#include <string>

#include "commands/Run.hpp"
#include "deck/Deck.hpp"

namespace atrapos {

/// Makes the scene or the model of a deck and follows its path (runPath). `tell`: gets the deck's title, then
/// what is followed. Collective; a model problem is followed by the first rank, which alone calls it then.
RunResult followDeck(const deck::Deck& deck, const RunOptions& options,
                     const std::function<void(const std::string&)>& tell);

/// printCheck of a deck. Collective.
void checkDeck(const deck::Deck& deck, std::ostream& out);

/// Writes the mesh that a deck generates into a file (empty: mesh/file of the deck), which is made anew
/// unless it is another program's or holds results. What it is, in one line.
std::string writeDeckMesh(const deck::Deck& deck, const std::string& file);

}  // namespace atrapos
