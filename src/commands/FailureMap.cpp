#include "commands/FailureMap.hpp"

#include <fmt/format.h>

#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <deque>
#include <map>
#include <ostream>
#include <stdexcept>

#include "atrapos/path/PathFollower.hpp"
#include "commands/GrowingPath.hpp"
#include "commands/RunSettings.hpp"
#include "commands/Stages.hpp"
#include "deck/DeckTables.hpp"
#include "deck/Stages.hpp"
#include "output/Files.hpp"
#include "output/PathTable.hpp"
#include "output/ReferencePath.hpp"

namespace atrapos {
namespace {

constexpr int kReferenceSamples = 20, kRunSamples = 8;  // of each step

/// Part of the reference path's extent that a state may be away from it: far above the error of the runs with
/// the loosest bound and of the chain's chords, far below the distance of branches where they end.
constexpr double kOnPath = 0.03;

/// Of a path or a stage of it.
struct MapReference {
  ReferencePath path{kReferenceSamples};
  double extent = 0;
  int points = 0;
};

class ReferenceObserver final : public path::Observer {
 public:
  explicit ReferenceObserver(MapReference& reference) : reference_(reference) {}
  bool onStep(const path::StepReport& report, const path::Series& series) override {
    reference_.path.append(report, series);
    reference_.points += static_cast<int>(report.criticalPoints.size());
    return true;
  }

 private:
  MapReference& reference_;
};

/// Watches one run of the map.
class Judge final : public path::Observer {
 public:
  Judge(const MapReference& reference, path::Problem& problem)
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

/// Follows the path, or its stages up to the one that comes to no stop. `change`: what is other than in the
/// deck; `observerOf`: who watches a stage.
path::Outcome follow(const MapProblem& of, const std::function<void(path::Options&)>& change,
                     const std::function<path::Observer&(std::size_t stage, path::Problem&)>& observerOf) {
  std::vector<double> ends;
  std::unique_ptr<StageCase> own;
  path::Start from;
  from.state = of.first->start();
  path::Outcome total;
  for (std::size_t stage = 0;; ++stage) {
    PathCase& pathCase = own ? own->pathCase() : *of.first;
    path::Problem& problem = own ? own->problem() : of.first->problem();
    path::Options options = pathOptions(pathCase);
    change(options);
    const auto solver = tangentSolver(pathCase);
    path::PathFollower follower(problem, *solver, options, pathCase.stops());
    const path::Outcome part = GrowingPath(pathCase, observerOf(stage, problem)).follow(follower, from);
    const int steps = total.steps + part.steps;
    total = sumOf(total, part);
    total.steps = steps;
    if (part.reason != path::EndReason::stopReached || stage + 1 >= of.deck.path.stages.size()) return total;
    ends.push_back(part.final.lambda);
    const int next = static_cast<int>(stage) + 1;
    from = {};
    from.state = startOfNext(part.final, pathCase.problem(), deck::beginOf(of.deck, next, ends));
    own = std::make_unique<StageCase>(of.deck, next, ends, pathCase, from.state);
  }
}

/// The reference path of every stage; throws std::runtime_error, one line.
std::vector<MapReference> referencesOf(const MapProblem& of) {
  std::string why;
  for (double delta = 1e-10; delta < 2e-6; delta *= 10) {
    std::vector<MapReference> references;
    std::unique_ptr<ReferenceObserver> observer;
    const path::Outcome outcome = follow(
        of,
        [&](path::Options& options) {
          options.order = 10;
          options.autoOrder = false;
          options.delta = options.residualBound = delta;
          options.pade = path::PadeUse::off;
          options.searchEveryStep = options.criticalPoints;
          options.maxSteps = 100000;
        },
        [&](std::size_t, path::Problem&) -> path::Observer& {
          references.emplace_back();
          observer = std::make_unique<ReferenceObserver>(references.back());
          return *observer;
        });
    if (outcome.reason == path::EndReason::stopReached) {
      for (MapReference& reference : references) reference.extent = reference.path.extent();
      return references;
    }
    why = outcome.text;
  }
  throw std::runtime_error(
      fmt::format("{}: the reference path does not reach a stop: {}", of.deck.file, why));
}

/// Text as one field of a table.
std::string field(std::string text) {
  std::replace(text.begin(), text.end(), ',', ';');
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

/// What one run is made with.
struct Setting {
  int order;  ///< 0: automatic
  double delta;
  path::PadeUse pade;
};

std::string row(const MapProblem& of, const std::vector<MapReference>& references, const Setting& setting,
                std::string& outcome) {
  std::deque<Judge> judges;  // of the stages
  const path::Outcome end = follow(
      of,
      [&](path::Options& options) {
        options.autoOrder = setting.order == 0;
        if (setting.order > 0) options.order = setting.order;
        options.delta = options.residualBound = setting.delta;
        options.pade = setting.pade;
      },
      [&](std::size_t stage, path::Problem& problem) -> path::Observer& {
        return judges.emplace_back(references[stage], problem);
      });
  std::string reason = end.text;
  double worstResidual = 0;
  int points = 0, expected = 0;
  const Judge* left = nullptr;  // the first stage that left its path
  for (const Judge& judge : judges) {
    if (!judge.outcome.empty() && left == nullptr) left = &judge;
    worstResidual = std::max(worstResidual, judge.worstResidual);
    points += judge.points;
  }
  for (const MapReference& reference : references) expected += reference.points;
  // Inside a step the bound is not asked for, only expected: the factor leaves room for that.
  constexpr double honest = 2;
  if (left != nullptr) {
    outcome = left->outcome;
    reason = left->where;
  } else if (end.reason == path::EndReason::stopReached && !judges.back().atEnd()) {
    outcome = "jumped";
    reason = "reached the stop on another branch";
  } else if (worstResidual > honest * setting.delta) {
    outcome = "residual";
  } else if (end.reason == path::EndReason::stopReached) {
    outcome = "end";
  } else {
    outcome = end.reason == path::EndReason::stepLimit ? "limit" : "ended";
  }
  return fmt::format("{},{},{:g},{},{},{},{},{},{},{},{},{:.2e},{:.4f},{},{}", field(of.deck.title),
                     setting.order > 0 ? std::to_string(setting.order) : "auto", setting.delta,
                     deck::wordOf(setting.pade, deck::padeUses()), outcome, end.steps, end.factorizations,
                     end.orders, end.corrections, points, expected, worstResidual, end.seconds.total,
                     field(of.values), field(reason));
}

void tell(std::ostream& out, const MapProblem& of, const std::map<std::string, int>& counts) {
  out << of.deck.title << (of.values.empty() ? "" : " " + of.values) << ':';
  for (const auto& [outcome, count] : counts) out << fmt::format(" {} {}", count, outcome);
  out << std::endl;
}

}  // namespace

void writeMap(const std::vector<MakeProblem>& problems, const std::vector<std::string>& decks,
              const MapOptions& options) {
  requireOwn(options.file, Made::map, decks);
  Table table(
      options.file,
      "problem,order,delta,pade,outcome,steps,factorizations,orders,corrections,points,points_expected,"
      "worst_residual,seconds,values,reason");
  for (const MakeProblem& make : problems) {
    const MapProblem problem = make();
    const std::vector<MapReference> references = referencesOf(problem);
    std::map<std::string, int> counts;
    for (const int order : options.orders)
      for (const double delta : options.deltas)
        for (const path::PadeUse pade : options.pades) {
          std::string outcome;
          table.append(row(problem, references, {order, delta, pade}, outcome));
          ++counts[outcome];
        }
    if (options.progress) tell(*options.progress, problem, counts);
  }
}

}  // namespace atrapos
