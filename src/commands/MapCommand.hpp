#pragma once

#include <string>
#include <vector>

namespace atrapos {

/// The words of `atrapos map`, empty where they are not given.
struct MapWords {
  std::vector<std::string> decks, orders, pades;
  std::vector<std::string> vary;  ///< KEY=LIST
  std::vector<double> deltas;
  std::string output;
  bool quiet = false;
};

/// Makes the map that the words ask for: every deck with every combination of the values that `vary` gives
/// its keys, under every setting. Throws std::invalid_argument or deck::DeckError, one line, on words and
/// decks that make no sense, before the first run; otherwise as writeMap.
void makeMap(const MapWords& words);

}  // namespace atrapos
