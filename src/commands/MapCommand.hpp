#pragma once

#include <string>
#include <vector>

#include "commands/FailureMap.hpp"

namespace atrapos {

/// The words of `atrapos map`, empty where they are not given.
struct MapWords {
  std::vector<std::string> decks, orders, pades;
  std::vector<double> deltas;
  std::string output;
  bool quiet = false;
};

/// What they ask for. Throws std::invalid_argument, one line, on a word that makes no sense.
MapOptions mapOptions(const MapWords& words);

}  // namespace atrapos
