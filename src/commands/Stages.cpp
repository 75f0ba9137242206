#include "commands/Stages.hpp"

#include <fmt/format.h>

#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <stdexcept>
#include <utility>

#include "atrapos/path/Forced.hpp"
#include "commands/OnePath.hpp"
#include "commands/RunSettings.hpp"
#include "deck/Stages.hpp"
#include "machine/Interrupt.hpp"
#include "scene/Scene.hpp"

namespace atrapos {
namespace {

using path::BranchProgress;

/// The load factors at which the first `count` stages of a diagram ended.
std::vector<double> endsOf(const path::BranchDiagram& diagram, std::size_t count) {
  std::vector<double> ends;
  for (std::size_t s = 0; s < count; ++s) ends.push_back(diagram.branches.at(s).outcome.final.lambda);
  return ends;
}

}  // namespace

path::State startOfNext(const path::State& end, path::Problem& problem, double loadFactor) {
  path::State start = problem.afterEvent({}, problem.settled(end)).copy();
  start.lambda = loadFactor;
  if (start.memory && !start.memory->u.is_null()) {
    auto memory = std::make_shared<path::Memory>(*start.memory);
    memory->lambda = loadFactor;
    start.memory = std::move(memory);
  }
  return start;
}

deck::Deck firstDeck(const deck::Deck& whole, const DeckMesh& mesh) {
  const auto& stages = whole.path.stages;
  if (stages.empty()) return whole;
  // Where the last stage ends is not known yet; what holds the body does not depend on it.
  const auto releases = [](const deck::Stage& stage) { return !stage.release.empty(); };
  if (std::any_of(stages.begin(), stages.end(), releases))
    Scene(deck::stageDeck(whole, stages.size() - 1, std::vector<double>(stages.size() - 1, 0.0)),
          DeckMesh(fem::Mesh(mesh.mesh), mesh.ranks));
  return deck::stageDeck(whole, 0, {});
}

StageCase::StageCase(const deck::Deck& whole, int stage, const std::vector<double>& ends,
                     const PathCase& before, const path::State& start)
    : case_(before.under(deck::stageDeck(whole, stage, ends), start)) {
  if (!case_) throw std::logic_error("StageCase: a case without a body");
  if (!case_->problem().map()->isSameAs(*start.u->getMap()))
    throw std::runtime_error(
        fmt::format("path/stages/{}: its unknowns are shared out otherwise among the ranks",
                    whole.path.stages[stage].name));
  if (whole.path.stages[stage].release.empty()) return;
  released_ =
      std::make_unique<path::ForcedProblem>(case_->problem(), path::forceThatFades(case_->problem(), start));
}

StageCase::~StageCase() = default;

path::Problem& StageCase::problem() { return released_ ? *released_ : case_->problem(); }

std::unique_ptr<StageCase> stageUnderWay(const deck::Deck& whole, const PathCase& first,
                                         const BranchProgress& progress) {
  const auto& branches = progress.diagram.branches;
  const auto& stages = whole.path.stages;
  for (std::size_t b = 0; b < branches.size(); ++b) {
    const std::string name = b < stages.size() ? stages[b].name : "";
    if (branches[b].stage != name)
      throw std::invalid_argument(
          fmt::format("path/stages: the run's stage {} is {}, the deck's {}", b + 1,
                      branches[b].stage.empty() ? "a path without stages" : "'" + branches[b].stage + "'",
                      name.empty() ? "is not there" : "'" + name + "'"));
  }
  if (progress.current == 0 || stages.empty()) return nullptr;
  return std::make_unique<StageCase>(whole, progress.current, endsOf(progress.diagram, progress.current),
                                     first, branches[progress.current].start);
}

void followStages(const deck::Deck& whole, PathCase& first, std::unique_ptr<StageCase> underWay,
                  Recorder& recorder, BranchProgress& progress, std::ostream* told) {
  auto& branches = progress.diagram.branches;
  const auto& stages = whole.path.stages;
  const auto follow = [&](StageCase& stage) {
    const auto solver = tangentSolver(stage.pathCase(), told);
    followOne(stage.pathCase(), stage.problem(), *solver, recorder, progress);
    recorder.finish(branches[progress.current].start);
    if (Interrupt::came()) return;
    progress.path.reset();
    recorder.onProgress(progress);
  };
  if (underWay && progress.path) follow(*underWay);
  while (branches.size() < stages.size()) {
    const path::Outcome& before = branches.back().outcome;
    if (Interrupt::came() || before.reason != path::EndReason::stopReached) return;
    const int number = static_cast<int>(branches.size());
    const auto ends = endsOf(progress.diagram, branches.size());
    PathCase& caseBefore = underWay ? underWay->pathCase() : first;
    path::Branch branch;
    branch.stage = stages[number].name;
    branch.start = startOfNext(before.final, caseBefore.problem(), deck::beginOf(whole, number, ends));
    auto next = std::make_unique<StageCase>(whole, number, ends, caseBefore, branch.start);
    progress.current = number;
    progress.path.emplace();
    progress.path->state = branch.start;
    recorder.beginOther(next->pathCase(), next->problem(), number, fmt::format("stage {}", branch.stage));
    branches.push_back(std::move(branch));
    underWay = std::move(next);
    follow(*underWay);
  }
}

}  // namespace atrapos
