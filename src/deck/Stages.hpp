#pragma once

#include <string>
#include <vector>

#include "deck/Deck.hpp"

namespace atrapos::deck {

/// An entry of a deck that the load factor acts on.
struct Driven {
  enum class Kind { Load, Support, Coupling, Tool, Material, Physics };
  Kind kind = Kind::Load;
  std::size_t index = 0;  ///< in the deck's list of that kind
  std::string name;
};

/// All of them: loads that are neither constant nor zero, supports and angles with a part per load factor,
/// tools of contacts that move, formulas with lambda.
std::vector<Driven> drivenOf(const Deck& deck);

/// Those that a stage drives: the named ones, without names all; none where it releases.
std::vector<Driven> drivenBy(const Deck& deck, const Stage& stage);

/// The load factor where a stage begins, that of what it drives; `ends`: the load factors at which the stages
/// before it ended. 0 where it releases.
double beginOf(const Deck& deck, std::size_t stage, const std::vector<double>& ends);

/// The problem of a stage as a deck without stages: what it drives goes on with the load factor, what else
/// there is stays at the load factor at which an earlier stage left it, or at 0, and what has been released
/// is. `ends` as above.
Deck stageDeck(const Deck& deck, std::size_t stage, const std::vector<double>& ends);

}  // namespace atrapos::deck
