#pragma once

#include <string>
#include <vector>

#include "deck/Deck.hpp"

namespace atrapos::deck {

/// What makes a deck's problem, with its defaults: a line "materials/steel/poissons_ratio: 0.3" for each
/// value. Left out: title, mesh, path but what stages drive and release, solver, and all of output but the
/// monitors. Surfaces from files are as in the deck.
std::vector<std::string> problemLines(const Deck& deck);

/// What differs first, "materials/steel/poissons_ratio was 0.3 and is 0 now"; empty: nothing but new stages.
std::string firstDifference(const std::vector<std::string>& before, std::vector<std::string> now);

}  // namespace atrapos::deck
