#pragma once

#include <memory>
#include <ostream>

#include "commands/PathCase.hpp"
#include "output/Recorder.hpp"
#include "scene/DeckMesh.hpp"

namespace atrapos {

/// What one stage of a path behind the first one is a path of.
class StageCase {
 public:
  /// `before`: the case of a stage before, of the same body; `ends`: the load factors at which the stages
  /// before ended; `start`: where this one begins.
  StageCase(const deck::Deck& whole, int stage, const std::vector<double>& ends, const PathCase& before,
            const path::State& start);
  ~StageCase();

  PathCase& pathCase() { return *case_; }
  path::Problem& problem();

 private:
  std::unique_ptr<PathCase> case_;
  std::unique_ptr<path::Problem> released_;  ///< null where the stage releases nothing
};

/// The state that a stage has ended at, where the next one begins at this load factor: with conditions that
/// are said, since those with which that one's problem would start may be other ones.
path::State startOfNext(const path::State& end, path::Problem& problem, double loadFactor);

/// The deck that a scene is made of: that of the first stage, or the deck itself where it has none. Throws
/// DeckError where a stage releases what holds a body. `mesh` is the deck's.
deck::Deck firstDeck(const deck::Deck& whole, const DeckMesh& mesh);

/// The stage behind the first one that a continued run is under way with; null where it is at the first one.
/// Throws std::invalid_argument, one line, where the run has followed other stages than those of the deck.
std::unique_ptr<StageCase> stageUnderWay(const deck::Deck& whole, const PathCase& first,
                                         const path::BranchProgress& progress);

/// Follows the stages behind the first one, those that are not done yet, the one under way first, as long as
/// each ends at a stop. They are further branches of the diagram, without a parent.
void followStages(const deck::Deck& whole, PathCase& first, std::unique_ptr<StageCase> underWay,
                  Recorder& recorder, path::BranchProgress& progress, std::ostream* told);

}  // namespace atrapos
