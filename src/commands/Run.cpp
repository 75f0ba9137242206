#include "commands/Run.hpp"

#include <fmt/format.h>

#include <Tpetra_Map.hpp>
#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <ostream>

#include "atrapos/exodus/Error.hpp"
#include "atrapos/exodus/MeshPart.hpp"
#include "commands/OnePath.hpp"
#include "commands/RunSettings.hpp"
#include "commands/Stages.hpp"
#include "deck/ProblemLines.hpp"
#include "machine/Interrupt.hpp"
#include "machine/Memory.hpp"
#include "machine/OutputFile.hpp"
#include "machine/Ranks.hpp"
#include "output/Files.hpp"
#include "output/PathPlot.hpp"
#include "output/Recorder.hpp"
#include "output/RunSummary.hpp"
#include "output/ToolShapes.hpp"
#include "report/Report.hpp"
#include "restart/RestartFile.hpp"
#include "scene/Imperfections.hpp"

namespace atrapos {
namespace {

/// Files that the run reads, and must not replace.
std::vector<std::string> inputsOf(const deck::Deck& deck) {
  std::vector<std::string> inputs{deck.file};
  if (deck.problem) return inputs;
  inputs.push_back(deck.mesh.path);
  for (const int parts : exodus::findParts(deck.mesh.path))
    for (int p = 0; p < parts; ++p) inputs.push_back(exodus::partName(deck.mesh.path, parts, p));
  return inputs;
}

bool isOneFolder(const std::string& a, const std::string& b) {
  std::error_code notThere;
  return std::filesystem::equivalent(a, b, notThere);
}

/// A lock of the first rank.
void lock(std::optional<FolderLock>& of, const std::string& folder, FolderLock::For purpose) {
  if (ranks::isFirst()) of.emplace(folder, purpose);
}

std::optional<Continued> continuedRun(const deck::Deck& deck, PathCase& pathCase, const RunProblem& problem,
                                      const RunOptions& options) {
  if (options.restart.empty()) return {};
  const deck::Path& settings = deck.path;
  Continued continued = readRestart(options.restart, options.from, problem, pathCase.problem().map());
  const bool tree = settings.branches != path::Follow::none;
  if (continued.tree != tree)
    throw std::invalid_argument(fmt::format("path/branches: the run in {} follows {}branches; expected {}",
                                            options.restart, continued.tree ? "" : "no ",
                                            continued.tree ? "all or stable" : "none"));
  const auto& branches = continued.progress.diagram.branches;
  std::size_t imperfect = 0;
  for (const path::Branch& b : branches)
    if (b.imperfection != 0) {
      const auto& asked = settings.imperfections;
      if (imperfect >= asked.size() || asked[imperfect] != b.imperfection)
        throw std::invalid_argument(fmt::format("path/imperfections: the run in {} has {:g} in place {}",
                                                options.restart, b.imperfection, imperfect + 1));
      ++imperfect;
    }
  if (continued.progress.path && !settings.autoOrder)
    continued.progress.path->order = 0;  // that of the deck, which may be another one
  return continued;
}

/// Histories and series are the most of a run that is known before its first factorization. Collective.
void requireRoom(PathCase& pathCase) {
  const deck::Path& path = pathCase.deck().path;
  if (!path.series() || path.autoOrder) return;
  const double vector =
      sizeof(double) * static_cast<double>(pathCase.problem().map()->getGlobalNumElements());
  const double needed = pathCase.historyBytes() + 2 * (path.order + 1) * vector,
               room = allMachines().available;
  if (room > 0 && needed > room)
    deck::failAt(pathCase.deck(), "path/order",
                 fmt::format("histories and series of order {} take {}, the machine has {} left; a coarser "
                             "mesh, a lower order "
                             "or path/method: newton take less",
                             path.order, inBytes(needed), inBytes(room)));
}

/// The page of what has been found; a line where there is none. What stands in the tables counts, not the
/// page.
std::string report(const std::string& folder) {
  try {
    writeReport(folder, folder + "/report.html");
    return {};
  } catch (const std::invalid_argument& e) {
    return fmt::format("report.html not written: {}", e.what());
  } catch (const exodus::Error& e) {
    return fmt::format("report.html not written: {}", e.what());
  }
}

/// The tools as surfaces, for viewers; a line where they cannot be written.
std::string drawTools(const std::string& folder, const deck::Deck& deck) {
  try {
    writeToolShapes(folder, deck);
    return {};
  } catch (const std::runtime_error& e) {
    return fmt::format("tools.exo not written: {}", e.what());
  }
}

RunResult resultOf(const deck::Deck& deck, const path::BranchDiagram& diagram) {
  const auto named = [&](std::size_t b) {
    const path::Branch& branch = diagram.branches[b];
    if (!branch.stage.empty()) return fmt::format("stage {}: {}", branch.stage, branch.outcome.text);
    return b > 0 ? fmt::format("branch {}: {}", b, branch.outcome.text) : branch.outcome.text;
  };
  const auto& stages = deck.path.stages;
  RunResult result;
  result.reachedStop = true;
  result.text = stages.empty() ? named(0) : named(diagram.branches.size() - 1);
  for (std::size_t b = 0; b < diagram.branches.size(); ++b) {
    if (path::atStop(diagram.branches[b])) continue;
    result.reachedStop = false;
    result.text = named(b);
    break;
  }
  if (result.reachedStop && diagram.branches.size() < stages.size()) {
    result.reachedStop = false;
    result.text += fmt::format("; stage {} has not begun", stages[diagram.branches.size()].name);
  }
  if (Interrupt::came()) {
    result.reachedStop = false;
    result.text = "interrupted; every finished step is on disk";
  }
  return result;
}

}  // namespace

RunResult runPath(const deck::Deck& deck, PathCase& pathCase, const RunOptions& options) {
  path::Problem& problem = pathCase.problem();
  requireRoom(pathCase);
  const auto solver = tangentSolver(pathCase, options.progress);
  const path::Options settings = pathOptions(pathCase);
  const path::Stops stops = pathCase.stops();
  path::BranchFollower tree(problem, *solver, settings, stops, branchOptions(deck.path));
  tree.watch(pathCase.functionals());
  const RunProblem runProblem{deck::problemLines(deck), pathCase.meshDigest()};
  const bool inPlace = isOneFolder(options.restart, options.directory);
  std::optional<FolderLock> reads, writes;
  if (!options.restart.empty())
    lock(inPlace ? writes : reads, options.restart,
         inPlace ? FolderLock::For::writing : FolderLock::For::reading);
  auto continued = continuedRun(deck, pathCase, runProblem, options);
  auto imperfect = continued ? imperfectUnderWay(pathCase, continued->progress) : nullptr;
  auto stage = continued ? stageUnderWay(deck, pathCase, continued->progress) : nullptr;
  PathCase& caseHere = imperfect ? imperfect->pathCase() : stage ? stage->pathCase() : pathCase;
  path::Problem& problemHere = imperfect ? imperfect->problem() : stage ? stage->problem() : problem;
  ranks::wait();  // all have read what the first one is going to replace

  prepareFolder(options.directory, inputsOf(deck));
  if (!inPlace) lock(writes, options.directory, FolderLock::For::writing);
  ranks::wait();  // the folder is there
  Interrupt interrupt;
  const bool inStages = !deck.path.stages.empty();
  if (inStages && options.progress)
    *options.progress << fmt::format("stage {}\n",
                                     deck.path.stages[continued ? continued->progress.current : 0].name);
  Recorder recorder(caseHere, problemHere, runProblem, options.directory, options.progress, continued);
  recorder.setAfterStep(options.afterStep);
  reads.reset();
  const path::State start = pathCase.start();
  const std::optional<path::Start> behind = continued ? continued->progress.path : std::nullopt;
  path::BranchProgress progress = continued ? continued->progress : path::BranchProgress(start);
  if (inStages) progress.diagram.branches[0].stage = deck.path.stages[0].name;
  if (progress.diagram.branches.back().imperfection == 0 && !stage) {
    if (deck.path.branches != path::Follow::none) {
      tree.goOn(progress, recorder);
    } else if (progress.path) {
      followOne(pathCase, problem, *solver, recorder, progress);
      if ((inStages || !deck.path.imperfections.empty()) && !Interrupt::came()) {
        progress.path.reset();
        recorder.onProgress(progress);
      }
    }
    recorder.finish(start);
  }
  const path::BranchDiagram& diagram = progress.diagram;
  std::string trouble;
  try {
    if (inStages) followStages(deck, pathCase, std::move(stage), recorder, progress, options.progress);
    followImperfect(pathCase, *solver, std::move(imperfect), recorder, progress);
  } catch (const std::runtime_error& e) {
    trouble = e.what();  // what has been found stays
  }

  auto summary = runSummary(deck, pathCase, diagram, *solver, recorder);
  if (continued) {
    const int branch = continued->progress.current;
    summary["restarted_on_branch"] = branch;
    summary["restarted_behind_step"] =
        behind ? behind->steps : continued->progress.diagram.branches[branch].outcome.steps;
  }
  RunResult result = resultOf(deck, diagram);
  const Costs unused = result.reachedStop ? recorder.unused() : Costs();
  for (const auto& [entry, line] : unused) summary["unused"].push_back(entry);
  std::string finished;
  const path::Outcome& first = diagram.branches[0].outcome;
  if (first.reason == path::EndReason::stopReached && !Interrupt::came())
    finished = pathCase.finish(first.final, settings, *solver, options.directory, summary);
  replaceFile(options.directory + "/summary.json", summary.dump(2) + "\n");
  replaceFile(options.directory + "/branches.csv", branchTable(diagram));
  const std::string plot = plotPath({options.directory});
  // The page shows the tools.
  const std::string undrawn = drawTools(options.directory, deck), unreported = report(options.directory);
  if (options.progress) {
    *options.progress << fmt::format(
        "{} steps, {} factorizations, {} solves, {:.2f} s; worst residual {:.2e}\n",
        summary["steps"].get<int>(), summary["factorizations"].get<int>(), summary["solves"].get<int>(),
        recorder.seconds(), recorder.worstResidual());
    if (!finished.empty()) *options.progress << finished << '\n';
    for (const auto& [entry, line] : unused) *options.progress << fmt::format("waste: {}: {}\n", entry, line);
    if (!plot.empty()) *options.progress << plot << '\n';
    for (const std::string& line : {unreported, undrawn})
      if (!line.empty()) *options.progress << line << '\n';
  }
  if (result.reachedStop && !trouble.empty()) result = {false, trouble};
  return result;
}

}  // namespace atrapos
