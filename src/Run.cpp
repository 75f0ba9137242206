#include "Run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <ostream>

#include "Files.hpp"
#include "Imperfections.hpp"
#include "Interrupt.hpp"
#include "PathPlot.hpp"
#include "Ranks.hpp"
#include "Recorder.hpp"
#include "RestartFile.hpp"
#include "RunSettings.hpp"
#include "RunSummary.hpp"
#include "atrapos/path/PathFollower.hpp"

namespace atrapos {
namespace {

/// A path without branches as a diagram of one.
class Single final : public path::Observer {
 public:
  Single(PathCase& pathCase, Recorder& recorder, path::BranchDiagram& diagram)
      : case_(pathCase), recorder_(recorder), diagram_(diagram) {}

  /// Follows the path; where the problem has become another one on a step, again from the step's start.
  template <class Follower>
  path::Outcome follow(Follower& follower, const path::Start& start) {
    next_ = start;
    path::Outcome total;
    do {
      changed_ = false;
      const path::Outcome part = follower.runFrom(next_, *this);
      total = total.final.u ? sum(total, part) : part;
    } while (changed_);
    return total;
  }

  bool onStep(const path::StepReport& report, const path::Series& series) override {
    changed_ = case_.changedOn(report.length, series);
    if (changed_) return false;
    next_ = report.next;
    for (const auto& point : report.criticalPoints) diagram_.points.push_back({point, 0, report.step});
    return recorder_.onStep(0, report, series);
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
    last.worstResidual = std::max(last.worstResidual, first.worstResidual);
    last.seconds.tangent += first.seconds.tangent;
    last.seconds.factor += first.seconds.factor;
    last.seconds.solve += first.seconds.solve;
    last.seconds.orderRhs += first.seconds.orderRhs;
    last.seconds.residual += first.seconds.residual;
    last.seconds.total += first.seconds.total;
    return last;
  }

  PathCase& case_;
  Recorder& recorder_;
  path::BranchDiagram& diagram_;
  path::Start next_;
  bool changed_ = false;
};

bool isBranchFile(const std::string& name) {
  return name.rfind("results_branch", 0) == 0 && name.size() > 4 && name.substr(name.size() - 4) == ".exo";
}

/// A run that is killed must not leave an earlier run's files beside its own.
void removeStale(const std::string& directory) {
  if (!ranks::isFirst()) return;
  for (const char* old : {"summary.json", "branches.csv", "path.png", "sharpen.csv"})
    std::filesystem::remove(directory + "/" + old);
  std::vector<std::filesystem::path> branches;
  for (const auto& entry : std::filesystem::directory_iterator(directory))
    if (isBranchFile(entry.path().filename().string())) branches.push_back(entry.path());
  for (const auto& file : branches) std::filesystem::remove(file);
}

std::optional<Continued> continuedRun(PathCase& pathCase, const RunOptions& options) {
  if (options.restart.empty()) return {};
  if (pathCase.deck().path.branches != path::Follow::none)
    throw std::invalid_argument("path/branches: a run with branches cannot be restarted; expected none");
  if (!pathCase.deck().path.imperfections.empty())
    throw std::invalid_argument("path/imperfections: a run with imperfect paths cannot be restarted");
  Continued continued{options.restart, readRestart(options.restart + "/restart.bin", options.fromStep,
                                                   pathCase.problem().map())};
  if (!pathCase.deck().path.autoOrder)
    continued.from.order = 0;  // that of the deck, which may be another one
  return continued;
}

bool atStop(const path::Branch& branch) {
  return branch.end != path::BranchEnd::path || branch.outcome.reason == path::EndReason::stopReached ||
         branch.outcome.reason == path::EndReason::stepLimit;
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
  const auto solver = tangentSolver(pathCase);
  const path::Options settings = pathOptions(pathCase);
  const path::Stops stops = pathCase.stops();
  const std::vector<int> conditions = problem.conditions();
  path::PathFollower follower(problem, *solver, settings, stops);
  path::BranchFollower tree(problem, *solver, settings, stops, branchOptions(deck.path));
  follower.watch(pathCase.functionals());
  tree.watch(pathCase.functionals());
  const auto continued = continuedRun(pathCase, options);
  ranks::wait();  // all have read what the first one is going to replace

  prepareFolder(options.directory, {"path.csv", "points.csv", "events.csv", "branches.csv", "results.exo",
                                    "restart.bin", "sharpen.csv", "summary.json", "path.png"});
  Interrupt interrupt;
  Recorder recorder(pathCase, options.directory, options.progress, continued);
  removeStale(options.directory);
  const path::State start = pathCase.start();
  path::BranchDiagram diagram;
  if (deck.path.branches == path::Follow::none) {
    diagram.branches.emplace_back();
    diagram.branches[0].start = continued ? continued->from.state : start;
    path::Start from;
    from.state = start;
    if (continued) from = continued->from;
    Single single(pathCase, recorder, diagram);
    if (deck.path.series()) {
      diagram.branches[0].outcome = single.follow(follower, from);
    } else {
      path::NewtonFollower newton(problem, *solver, newtonOptions(pathCase), stops);
      diagram.branches[0].outcome = single.follow(newton, from);
    }
  } else {
    diagram = tree.run(start, recorder);
  }
  recorder.finish(start);
  std::string trouble;
  std::vector<double> imperfections;
  try {
    followImperfect(pathCase, *solver, settings, conditions, recorder, diagram, imperfections);
  } catch (const std::runtime_error& e) {
    trouble = e.what();  // what has been found stays
  }

  auto summary = runSummary(pathCase, diagram, imperfections, *solver, recorder);
  if (continued) summary["restarted_behind_step"] = continued->from.steps;
  std::string finished;
  const path::Outcome& first = diagram.branches[0].outcome;
  if (first.reason == path::EndReason::stopReached && !Interrupt::came())
    finished = pathCase.finish(first.final, settings, *solver, options.directory, summary);
  replaceFile(options.directory + "/summary.json", summary.dump(2) + "\n");
  replaceFile(options.directory + "/branches.csv", branchTable(diagram, imperfections));
  const std::string plot = plotPath(options.directory, deck.title, pathCase.monitorNames(),
                                    static_cast<int>(diagram.branches.size()));
  if (options.progress) {
    *options.progress << fmt::format(
        "{} steps, {} factorizations, {} solves, {:.2f} s; worst residual {:.2e}\n",
        summary["steps"].get<int>(), summary["factorizations"].get<int>(), summary["solves"].get<int>(),
        recorder.seconds(), recorder.worstResidual());
    if (!finished.empty()) *options.progress << finished << '\n';
    if (!plot.empty()) *options.progress << plot << '\n';
  }
  RunResult result = resultOf(diagram);
  if (result.reachedStop && !trouble.empty()) result = {false, trouble};
  return result;
}

}  // namespace atrapos
