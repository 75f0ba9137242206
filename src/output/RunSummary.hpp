#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "atrapos/linear/TangentSolver.hpp"
#include "atrapos/path/Branches.hpp"
#include "commands/PathCase.hpp"
#include "output/Recorder.hpp"

namespace atrapos {

/// summary.json: how the run ended, what was found, what it cost. Counts and seconds are those of all
/// branches together; the load factor, the path length and how it ended are those of the first path, of a
/// path in stages those of the last one. `pathCase`: of the deck, or of its first stage.
nlohmann::ordered_json runSummary(const deck::Deck& deck, const PathCase& pathCase,
                                  const path::BranchDiagram& diagram, const linear::TangentSolver& solver,
                                  const Recorder& recorder);

/// branches.csv: one row per branch of the diagram, the first path included.
std::string branchTable(const path::BranchDiagram& diagram);

}  // namespace atrapos
