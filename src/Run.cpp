#include "Run.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <ostream>

#include "Files.hpp"
#include "Imperfections.hpp"
#include "Interrupt.hpp"
#include "PathPlot.hpp"
#include "Recorder.hpp"
#include "RestartFile.hpp"
#include "RunSettings.hpp"
#include "RunSummary.hpp"
#include "atrapos/linear/MakeTangentSolver.hpp"
#include "atrapos/path/PathFollower.hpp"

namespace atrapos {
namespace {

/// A path without branches as a diagram of one.
class Single final : public path::Observer {
 public:
  Single(Recorder& recorder, path::BranchDiagram& diagram) : recorder_(recorder), diagram_(diagram) {}
  bool onStep(const path::StepReport& report, const path::Series& series) override {
    for (const auto& point : report.criticalPoints) diagram_.points.push_back({point, 0, report.step});
    return recorder_.onStep(0, report, series);
  }

 private:
  Recorder& recorder_;
  path::BranchDiagram& diagram_;
};

bool isBranchFile(const std::string& name) {
  return name.rfind("results_branch", 0) == 0 && name.size() > 4 && name.substr(name.size() - 4) == ".exo";
}

/// A run that is killed must not leave an earlier run's files beside its own.
void removeStale(const std::string& directory) {
  for (const char* old : {"summary.json", "branches.csv", "path.png"})
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
  if (pathCase.problem().eventCount() > 0)
    throw std::invalid_argument("a problem that changes by events cannot be restarted");
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
  linear::TangentSolverOptions solverOptions;
  solverOptions.type = deck.solver.spec();
  solverOptions.symmetric = problem.symmetric();
  const auto solver = linear::makeTangentSolver(solverOptions);
  path::Options settings = pathOptions(deck.path);
  settings.direction *= pathCase.direction();
  const path::Stops stops = pathCase.stops();
  path::PathFollower follower(problem, *solver, settings, stops);
  path::BranchFollower tree(problem, *solver, settings, stops, branchOptions(deck.path));
  follower.watch(pathCase.functionals());
  tree.watch(pathCase.functionals());
  const auto continued = continuedRun(pathCase, options);

  prepareFolder(options.directory, {"path.csv", "points.csv", "branches.csv", "results.exo", "restart.bin",
                                    "summary.json", "path.png"});
  Interrupt interrupt;
  Recorder recorder(pathCase, options.directory, options.progress, continued);
  removeStale(options.directory);
  const path::State start = pathCase.start();
  path::BranchDiagram diagram;
  if (deck.path.branches == path::Follow::none) {
    diagram.branches.emplace_back();
    diagram.branches[0].start = continued ? continued->from.state : start;
    Single single(recorder, diagram);
    diagram.branches[0].outcome =
        continued ? follower.runFrom(continued->from, single) : follower.run(start, single);
  } else {
    diagram = tree.run(start, recorder);
  }
  recorder.finish(start);
  std::string trouble;
  std::vector<double> imperfections;
  try {
    followImperfect(pathCase, *solver, settings, recorder, diagram, imperfections);
  } catch (const std::runtime_error& e) {
    trouble = e.what();  // what has been found stays
  }

  auto summary = runSummary(pathCase, diagram, imperfections, *solver, recorder);
  if (continued) summary["restarted_behind_step"] = continued->from.steps;
  replaceFile(options.directory + "/summary.json", summary.dump(2) + "\n");
  replaceFile(options.directory + "/branches.csv", branchTable(diagram, imperfections));
  const std::string plot = plotPath(options.directory, deck.title, pathCase.monitorNames(),
                                    static_cast<int>(diagram.branches.size()));
  if (options.progress) {
    *options.progress << fmt::format(
        "{} steps, {} factorizations, {} solves, {:.2f} s; worst residual {:.2e}\n",
        summary["steps"].get<int>(), summary["factorizations"].get<int>(), summary["solves"].get<int>(),
        recorder.seconds(), recorder.worstResidual());
    if (!plot.empty()) *options.progress << plot << '\n';
  }
  RunResult result = resultOf(diagram);
  if (result.reachedStop && !trouble.empty()) result = {false, trouble};
  return result;
}

}  // namespace atrapos
