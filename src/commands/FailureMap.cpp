#include "commands/FailureMap.hpp"

#include <fmt/format.h>

#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <map>
#include <ostream>
#include <stdexcept>

#include "atrapos/path/PathFollower.hpp"
#include "commands/RunSettings.hpp"
#include "deck/DeckTables.hpp"
#include "output/Files.hpp"
#include "output/PathTable.hpp"
#include "output/ReferencePath.hpp"

namespace atrapos {
namespace {

constexpr int kReferenceSamples = 20, kRunSamples = 8;  // of each step

/// Part of the reference path's extent that a state may be away from it: far above the error of the runs with
/// the loosest bound and of the chain's chords, far below the distance of branches where they end.
constexpr double kOnPath = 0.03;

struct Reference {
  ReferencePath path{kReferenceSamples};
  double extent = 0;
  int points = 0;
};

class ReferenceObserver final : public path::Observer {
 public:
  explicit ReferenceObserver(Reference& reference) : reference_(reference) {}
  bool onStep(const path::StepReport& report, const path::Series& series) override {
    reference_.path.append(report, series);
    reference_.points += static_cast<int>(report.criticalPoints.size());
    return true;
  }

 private:
  Reference& reference_;
};

/// Watches one run of the map.
class Judge final : public path::Observer {
 public:
  Judge(const Reference& reference, path::Problem& problem)
      : walker_(reference.path, kOnPath * reference.extent),
        problem_(problem),
        r_(Teuchos::rcp(new path::Vector(problem.map()))) {}

  bool onStep(const path::StepReport& report, const path::Series& series) override {
    points += static_cast<int>(report.criticalPoints.size());
    for (int j = 1; j <= kRunSamples; ++j) {
      look(j < kRunSamples ? series.state(report.length * j / kRunSamples) : report.end, report.step);
    }
    return true;
  }

  bool atEnd() const { return walker_.atEnd(); }

  std::string outcome, where;  ///< empty: on the path all along
  int points = 0;
  double worstResidual = 0;

 private:
  void look(const path::State& state, int step) {
    worstResidual = std::max(worstResidual, problem_.residual(state, *r_).relative());
    if (!outcome.empty()) return;
    const auto place = walker_.go(*state.u, state.lambda);
    if (place == ReferencePath::Walker::Place::on) return;
    outcome = place == ReferencePath::Walker::Place::off ? "jumped" : "turned";
    where = fmt::format("{} in step {} at load factor {:.4g}",
                        place == ReferencePath::Walker::Place::off ? "left the path" : "went back", step,
                        state.lambda);
  }

  ReferencePath::Walker walker_;
  path::Problem& problem_;
  path::RCP<path::Vector> r_;
};

Reference referenceOf(PathCase& pathCase) {
  path::Options options = pathOptions(pathCase);
  options.order = 10;
  options.autoOrder = false;
  options.delta = options.residualBound = 1e-10;
  options.pade = path::PadeUse::off;
  options.searchEveryStep = options.criticalPoints;
  options.maxSteps = 100000;
  Reference reference;
  ReferenceObserver observer(reference);
  const auto solver = tangentSolver(pathCase);
  path::PathFollower follower(pathCase.problem(), *solver, options, pathCase.stops());
  const path::Outcome outcome = follower.run(pathCase.start(), observer);
  if (outcome.reason != path::EndReason::stopReached)
    throw std::runtime_error(
        fmt::format("{}: the reference path does not reach a stop: {}", pathCase.deck().file, outcome.text));
  reference.extent = reference.path.extent();
  return reference;
}

/// Text as one field of a table.
std::string field(std::string text) {
  std::replace(text.begin(), text.end(), ',', ';');
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

std::string row(PathCase& pathCase, const Reference& reference, int order, double delta, path::PadeUse pade,
                std::string& outcome) {
  path::Options options = pathOptions(pathCase);
  options.autoOrder = order == 0;
  if (order > 0) options.order = order;
  options.delta = options.residualBound = delta;
  options.pade = pade;
  Judge judge(reference, pathCase.problem());
  const auto solver = tangentSolver(pathCase);
  path::PathFollower follower(pathCase.problem(), *solver, options, pathCase.stops());
  const path::Outcome end = follower.run(pathCase.start(), judge);
  std::string reason = end.text;
  // Inside a step the bound is not asked for, only expected: the factor leaves room for that.
  constexpr double honest = 2;
  if (!judge.outcome.empty()) {
    outcome = judge.outcome;
    reason = judge.where;
  } else if (end.reason == path::EndReason::stopReached && !judge.atEnd()) {
    outcome = "jumped";
    reason = "reached the stop on another branch";
  } else if (judge.worstResidual > honest * delta) {
    outcome = "residual";
  } else if (end.reason == path::EndReason::stopReached) {
    outcome = "end";
  } else {
    outcome = end.reason == path::EndReason::stepLimit ? "limit" : "ended";
  }
  return fmt::format("{},{},{:g},{},{},{},{},{},{},{},{},{:.2e},{:.4f},{}", field(pathCase.deck().title),
                     order > 0 ? std::to_string(order) : "auto", delta, deck::wordOf(pade, deck::padeUses()),
                     outcome, end.steps, end.factorizations, end.orders, end.corrections, judge.points,
                     reference.points, judge.worstResidual, end.seconds.total, field(reason));
}

}  // namespace

void writeMap(const std::vector<std::unique_ptr<PathCase>>& cases, const MapOptions& options) {
  for (const auto& pathCase : cases)
    if (!pathCase->deck().path.series())
      deck::failAt(pathCase->deck(), "path/method", "the map varies the settings of series; expected series");
  std::vector<std::string> decks;
  for (const auto& pathCase : cases) decks.push_back(pathCase->deck().file);
  requireOwn(options.file, Made::map, decks);
  Table table(
      options.file,
      "problem,order,delta,pade,outcome,steps,factorizations,orders,corrections,points,points_expected,"
      "worst_residual,seconds,reason");
  for (const auto& pathCase : cases) {
    const Reference reference = referenceOf(*pathCase);
    std::map<std::string, int> counts;
    for (const int order : options.orders)
      for (const double delta : options.deltas)
        for (const path::PadeUse pade : options.pades) {
          std::string outcome;
          table.append(row(*pathCase, reference, order, delta, pade, outcome));
          ++counts[outcome];
        }
    if (!options.progress) continue;
    *options.progress << pathCase->deck().title << ':';
    for (const auto& [outcome, count] : counts) *options.progress << fmt::format(" {} {}", count, outcome);
    *options.progress << std::endl;
  }
}

}  // namespace atrapos
