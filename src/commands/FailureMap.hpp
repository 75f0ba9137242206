#pragma once

#include <functional>
#include <iosfwd>
#include <memory>
#include <string>
#include <vector>

#include "commands/PathCase.hpp"

namespace atrapos {

/// What is varied: every combination is one run.
struct MapOptions {
  std::vector<int> orders{5, 10, 15, 20, 30, 40};             ///< 0: automatic
  std::vector<double> deltas{1e-2, 1e-4, 1e-6, 1e-8, 1e-10};  ///< delta of eq. (36) and residual bound alike
  std::vector<path::PadeUse> pades{path::PadeUse::off, path::PadeUse::automatic};
  std::string file = "map.csv";
  std::ostream* progress = nullptr;  ///< one line a problem; none where null
};

/// One problem of a map, of a deck.
struct MapProblem {
  deck::Deck deck;                  ///< with all its stages
  std::string values;               ///< what the map varies in the deck, "key=value ..."; empty: nothing
  std::unique_ptr<PathCase> first;  ///< of the path, or of its first stage
};

/// Makes one when it is its turn.
using MakeProblem = std::function<MapProblem()>;

/// Follows the first path of each problem, or its stages one after another, under all settings and writes one
/// row a run into a table, each on disk before the next run: problem, order, delta, pade, outcome, steps,
/// factorizations, orders, corrections, points, points_expected, worst_residual, seconds, values, reason.
///
/// Each run is compared with a reference path of the same problem (order 10, no rational series, delta 1e-10
/// or, where rounding leaves larger residuals, the least power of ten that they allow up to 1e-6). Outcome:
/// `end` (a stop was reached, with stages that of the last), `ended` (before it, with a reason), `limit` (of
/// steps), `jumped` (it left the reference path), `turned` (it went back on it), `residual` (the relative
/// residual somewhere inside a step is above twice the bound). Throws std::runtime_error, one line, where a
/// reference path does not reach a stop.
void writeMap(const std::vector<MakeProblem>& problems, const std::vector<std::string>& decks,
              const MapOptions& options);

}  // namespace atrapos
