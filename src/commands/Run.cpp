#include "commands/Run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <ostream>

#include "atrapos/exodus/Error.hpp"
#include "atrapos/exodus/MeshPart.hpp"
#include "atrapos/path/PathFollower.hpp"
#include "commands/RunSettings.hpp"
#include "deck/ProblemLines.hpp"
#include "machine/Interrupt.hpp"
#include "machine/Memory.hpp"
#include "machine/OutputFile.hpp"
#include "machine/Ranks.hpp"
#include "output/Files.hpp"
#include "output/PathPlot.hpp"
#include "output/Recorder.hpp"
#include "output/RunSummary.hpp"
#include "report/Report.hpp"
#include "restart/RestartFile.hpp"
#include "scene/Imperfections.hpp"

namespace atrapos {
namespace {

/// A path without branches as a diagram of one.
class Single final : public path::Observer {
 public:
  Single(PathCase& pathCase, Recorder& recorder, path::BranchProgress& progress)
      : case_(pathCase), recorder_(recorder), progress_(progress) {}

  /// Follows the path; where the problem has become another one on a step, again from the step's start.
  template <class Follower>
  void follow(Follower& follower) {
    path::Outcome total;
    do {
      changed_ = false;
      const path::Start from = *progress_.path;
      const path::Outcome part = follower.runFrom(from, *this);
      total = total.final.u ? sum(total, part) : part;
    } while (changed_);
    progress_.diagram.branches[0].outcome = total;
  }

  void onSearch(int found, int wanted) override { recorder_.onSearch(0, found, wanted); }

  bool onStep(const path::StepReport& report, const path::Series& series) override {
    changed_ = case_.changedOn(report.length, series);
    if (changed_) return false;
    auto& points = progress_.diagram.points;
    for (const auto& point : report.criticalPoints) points.push_back({point, 0, report.step});
    progress_.path = report.next;
    const bool more = recorder_.onStep(0, report, series);
    recorder_.onProgress(progress_);
    return more;
  }

 private:
  /// The costs of both; all else is that of the last part.
  static path::Outcome sum(const path::Outcome& first, path::Outcome last) {
    last.factorizations += first.factorizations;
    last.events += first.events;
    last.eventTrials += first.eventTrials;
    last.solves += first.solves;
    last.orders += first.orders;
    last.startIterations += first.startIterations;
    last.corrections += first.corrections;
    last.restarts += first.restarts;
    last.retreats += first.retreats;
    last.criticalFactorizations += first.criticalFactorizations;
    last.closings += first.closings;
    last.cutBacks += first.cutBacks;
    last.jumps += first.jumps;
    last.worstResidual = std::max(last.worstResidual, first.worstResidual);
    last.worstJump = std::max(last.worstJump, first.worstJump);
    last.seconds.tangent += first.seconds.tangent;
    last.seconds.analysis += first.seconds.analysis;
    last.seconds.factor += first.seconds.factor;
    last.seconds.solve += first.seconds.solve;
    last.seconds.orderRhs += first.seconds.orderRhs;
    last.seconds.residual += first.seconds.residual;
    last.seconds.total += first.seconds.total;
    return last;
  }

  PathCase& case_;
  Recorder& recorder_;
  path::BranchProgress& progress_;
  bool changed_ = false;
};

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

std::optional<Continued> continuedRun(PathCase& pathCase, const RunProblem& problem,
                                      const RunOptions& options) {
  if (options.restart.empty()) return {};
  const deck::Path& settings = pathCase.deck().path;
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

bool atStop(const path::Branch& branch) {
  return branch.end != path::BranchEnd::path || branch.outcome.reason == path::EndReason::stopReached ||
         branch.outcome.reason == path::EndReason::stepLimit;
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

RunResult resultOf(const path::BranchDiagram& diagram) {
  RunResult result;
  result.reachedStop = true;
  result.text = diagram.branches[0].outcome.text;
  for (std::size_t b = 0; b < diagram.branches.size(); ++b) {
    if (atStop(diagram.branches[b])) continue;
    result.reachedStop = false;
    result.text = diagram.branches[b].outcome.text;
    if (b > 0) result.text = fmt::format("branch {}: {}", b, result.text);
    break;
  }
  if (Interrupt::came()) {
    result.reachedStop = false;
    result.text = "interrupted; every finished step is on disk";
  }
  return result;
}

}  // namespace

RunResult runPath(PathCase& pathCase, const RunOptions& options) {
  const deck::Deck& deck = pathCase.deck();
  path::Problem& problem = pathCase.problem();
  requireRoom(pathCase);
  const auto solver = tangentSolver(pathCase, options.progress);
  const path::Options settings = pathOptions(pathCase);
  const path::Stops stops = pathCase.stops();
  path::PathFollower follower(problem, *solver, settings, stops);
  path::BranchFollower tree(problem, *solver, settings, stops, branchOptions(deck.path));
  follower.watch(pathCase.functionals());
  tree.watch(pathCase.functionals());
  const RunProblem runProblem{deck::problemLines(deck), pathCase.meshDigest()};
  const bool inPlace = isOneFolder(options.restart, options.directory);
  std::optional<FolderLock> reads, writes;
  if (!options.restart.empty())
    lock(inPlace ? writes : reads, options.restart,
         inPlace ? FolderLock::For::writing : FolderLock::For::reading);
  auto continued = continuedRun(pathCase, runProblem, options);
  auto imperfect = continued ? imperfectUnderWay(pathCase, continued->progress) : nullptr;
  ranks::wait();  // all have read what the first one is going to replace

  prepareFolder(options.directory, inputsOf(deck));
  if (!inPlace) lock(writes, options.directory, FolderLock::For::writing);
  ranks::wait();  // the folder is there
  Interrupt interrupt;
  Recorder recorder(imperfect ? imperfect->pathCase() : pathCase, imperfect ? imperfect->problem() : problem,
                    runProblem, options.directory, options.progress, continued);
  reads.reset();
  const path::State start = pathCase.start();
  const std::optional<path::Start> behind = continued ? continued->progress.path : std::nullopt;
  path::BranchProgress progress = continued ? continued->progress : path::BranchProgress(start);
  if (progress.diagram.branches.back().imperfection == 0) {
    if (deck.path.branches != path::Follow::none) {
      tree.goOn(progress, recorder);
    } else if (progress.path) {
      Single single(pathCase, recorder, progress);
      if (deck.path.series()) {
        single.follow(follower);
      } else {
        path::NewtonFollower newton(problem, *solver, newtonOptions(pathCase), stops);
        single.follow(newton);
      }
      if (!deck.path.imperfections.empty() && !Interrupt::came()) {
        progress.path.reset();
        recorder.onProgress(progress);
      }
    }
    recorder.finish(start);
  }
  const path::BranchDiagram& diagram = progress.diagram;
  std::string trouble;
  try {
    followImperfect(pathCase, *solver, settings, std::move(imperfect), recorder, progress);
  } catch (const std::runtime_error& e) {
    trouble = e.what();  // what has been found stays
  }

  auto summary = runSummary(pathCase, diagram, *solver, recorder);
  if (continued) {
    const int branch = continued->progress.current;
    summary["restarted_on_branch"] = branch;
    summary["restarted_behind_step"] =
        behind ? behind->steps : continued->progress.diagram.branches[branch].outcome.steps;
  }
  std::string finished;
  const path::Outcome& first = diagram.branches[0].outcome;
  if (first.reason == path::EndReason::stopReached && !Interrupt::came())
    finished = pathCase.finish(first.final, settings, *solver, options.directory, summary);
  replaceFile(options.directory + "/summary.json", summary.dump(2) + "\n");
  replaceFile(options.directory + "/branches.csv", branchTable(diagram));
  const std::string plot = plotPath({options.directory});
  const std::string unreported = report(options.directory);
  if (options.progress) {
    *options.progress << fmt::format(
        "{} steps, {} factorizations, {} solves, {:.2f} s; worst residual {:.2e}\n",
        summary["steps"].get<int>(), summary["factorizations"].get<int>(), summary["solves"].get<int>(),
        recorder.seconds(), recorder.worstResidual());
    if (!finished.empty()) *options.progress << finished << '\n';
    if (!plot.empty()) *options.progress << plot << '\n';
    if (!unreported.empty()) *options.progress << unreported << '\n';
  }
  RunResult result = resultOf(diagram);
  if (result.reachedStop && !trouble.empty()) result = {false, trouble};
  return result;
}

}  // namespace atrapos
