#pragma once

#include <functional>
#include <iosfwd>
#include <optional>
#include <string>

#include "commands/PathCase.hpp"
#include "output/Recorder.hpp"
#include "restart/RestartRecord.hpp"

namespace atrapos {

struct RunOptions {
  std::string directory;             ///< where results go; made if missing
  std::ostream* progress = nullptr;  ///< one line a step; none where null
  std::string restart;               ///< folder with the results of a run that goes on; empty: a new run
  std::optional<RestartPlace> from;  ///< where it goes on; empty: behind all that it has finished
  /// Called on every rank when a step is on disk; may ask for the end of the run (Interrupt::ask).
  std::function<void(const StepTaken&)> afterStep;
};

/// How a run ended.
struct RunResult {
  bool reachedStop = false;  ///< false: a path could not be continued to a stop of the deck
  std::string text;          ///< one line
};

/// Follows the path of a deck, and the branches or further stages that the deck asks for, and writes
/// path.csv, points.csv, branches.csv, summary.json, path.png, restart.bin and, where there are fields,
/// results.exo and results_branch<n>.exo into the directory. Every finished step is on disk before the next
/// one begins. On several ranks all call it and the first one writes. `pathCase`: of the deck, or of its
/// first stage (deck::stageDeck).
RunResult runPath(const deck::Deck& deck, PathCase& pathCase, const RunOptions& options);

}  // namespace atrapos
