#include "Run.hpp"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <Kokkos_Core.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <ostream>
#include <sstream>

#include "Files.hpp"
#include "PathTable.hpp"
#include "Version.hpp"
#include "atrapos/exodus/ResultWriter.hpp"
#include "atrapos/linear/MakeTangentSolver.hpp"
#include "atrapos/path/PathFollower.hpp"

namespace atrapos {
namespace {

const std::vector<std::string> kGlobals = {"load_factor",  "path_parameter",  "series_radius",
                                           "series_order", "negative_pivots", "active_contacts",
                                           "residual_norm"};

std::atomic<bool> interrupted{false};
void onSignal(int) { interrupted = true; }

/// A SIGINT or SIGTERM ends the path after the step under way, with all results in order.
class SignalGuard {
 public:
  SignalGuard() : interrupt_(std::signal(SIGINT, onSignal)), terminate_(std::signal(SIGTERM, onSignal)) {}
  ~SignalGuard() {
    std::signal(SIGINT, interrupt_);
    std::signal(SIGTERM, terminate_);
  }

 private:
  void (*interrupt_)(int);
  void (*terminate_)(int);
};

class Recorder final : public path::Observer {
 public:
  Recorder(Scene& scene, const RunOptions& options)
      : scene_(scene),
        options_(options),
        table_(options.directory + "/path.csv", scene.monitorNames()),
        results_(options.directory + "/results.exo", scene.resultMesh(), names(scene)),
        work_(Teuchos::rcp(new path::Vector(scene.problem().map()))),
        residual_(Teuchos::rcp(new path::Vector(scene.problem().map()))),
        start_(std::chrono::steady_clock::now()) {
    if (options_.progress) {
      *options_.progress << fmt::format(
          "{:>5} {:>5} {:>10} {:>13} {:>10} {:>10} {:>4} {:>4} {:>8} {:>8}  {}\n", "step", "order", "radius",
          "load factor", "length", "residual", "cut", "corr", "contacts", "time s", "events");
    }
  }

  /// The state before the first step.
  void writeStart(const path::State& state) {
    const path::ResidualNorm r = scene_.problem().residual(*state.u, state.lambda, *residual_);
    table_.append(0, 0.0, state.lambda, scene_.monitors(*state.u, state.lambda), r.relative());
    writeFields(*state.u, state.lambda, 0.0,
                {state.lambda, 0, 0, 0, 0, double(activeContacts(*state.u, state.lambda)), r.relative()});
  }

  bool onStep(const path::StepReport& report, const path::Series& series) override {
    const double before = seconds();
    const int points = scene_.deck().output.pointsPerStep;
    worstResidual_ = std::max(worstResidual_, report.residual);
    for (int j = 1; j <= points; ++j) {
      const double a = report.length * j / points;
      const double length = report.pathLengthStart + a;
      if (j == points) {
        append(report.step, report.pathLengthEnd, *report.end.u, report.end.lambda);
      } else {
        const double lambda = series.evaluate(a, *work_);
        append(report.step, length, *work_, lambda);
      }
    }
    const int active = activeContacts(*report.end.u, report.end.lambda);
    writeFields(*report.end.u, report.end.lambda, report.pathLengthEnd,
                {report.lambdaEnd, report.pathLengthEnd, report.radius, double(report.order),
                 negativePivots(report), double(active), report.residual});
    printStep(report, active);
    outputSeconds_ += seconds() - before;
    return !interrupted;
  }

  double outputSeconds() const { return outputSeconds_; }
  double worstResidual() const { return worstResidual_; }
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  static exodus::ResultNames names(const Scene& scene) {
    exodus::ResultNames names;
    names.nodal = scene.nodalNames();
    names.element = scene.elementNames();
    names.global = kGlobals;
    std::istringstream deck(scene.deck().text);
    for (std::string line; std::getline(deck, line);) names.info.push_back(line);
    return names;
  }

  void append(int step, double pathLength, const path::Vector& u, double lambda) {
    const path::ResidualNorm r = scene_.problem().residual(u, lambda, *residual_);
    worstResidual_ = std::max(worstResidual_, r.relative());
    table_.append(step, pathLength, lambda, scene_.monitors(u, lambda), r.relative());
  }

  void writeFields(const path::Vector& u, double lambda, double time, const std::vector<double>& globals) {
    const auto flat = [](const std::vector<std::vector<double>>& variables) {
      std::vector<double> all;
      for (const auto& v : variables) all.insert(all.end(), v.begin(), v.end());
      return all;
    };
    results_.writeStep(time, flat(scene_.nodalValues(u, lambda)), flat(scene_.elementValues(u, lambda)),
                       globals);
  }

  /// Negative eigenvalues of the tangent at the step's end; at its start where the end is not known; -1:
  /// unknown.
  static double negativePivots(const path::StepReport& report) {
    const auto& inertia = report.inertiaEnd ? report.inertiaEnd : report.inertia;
    return inertia ? double(inertia->negative) : -1.0;
  }

  int activeContacts(const path::Vector& u, double lambda) const {
    int active = 0;
    for (const ContactPoints& contact : scene_.contacts())
      active += scene_.contactState(contact, u, lambda).active;
    return active;
  }

  void printStep(const path::StepReport& r, int active) const {
    if (!options_.progress) return;
    std::string events;
    for (const path::LimitPoint& p : r.limitPoints)
      events += fmt::format("limit point ({}) at load factor {:.8g}; ", p.maximum ? "maximum" : "minimum",
                            p.lambda);
    for (const path::CriticalPoint& p : r.criticalPoints)
      events += fmt::format("bifurcation point ({}) at load factor {:.10g}; ", path::toString(p.kind),
                            p.state.lambda);
    if (r.unexplained > 0)
      events += fmt::format("{} eigenvalue(s) changed sign at a place not found; ", r.unexplained);
    if (!events.empty()) events.resize(events.size() - 2);
    *options_.progress
        << fmt::format("{:>5} {:>5} {:>10.3e} {:>13.6g} {:>10.3e} {:>10.2e} {:>4} {:>4} {:>8} {:>8.2f}  {}",
                       r.step, r.order, r.radius, r.lambdaEnd, r.length, r.residual, r.cutBacks,
                       r.corrections, active, seconds(), events)
        << std::endl;
  }

  Scene& scene_;
  const RunOptions& options_;
  PathTable table_;
  exodus::ResultWriter results_;
  Teuchos::RCP<path::Vector> work_, residual_;
  std::chrono::steady_clock::time_point start_;
  double worstResidual_ = 0, outputSeconds_ = 0;
};

nlohmann::ordered_json summary(const Scene& scene, const path::Outcome& outcome,
                               const linear::TangentSolver& solver, const Recorder& recorder) {
  const auto& w = outcome.seconds;
  nlohmann::ordered_json json;
  json["program"] = "atrapos " + std::string(kVersion);
  json["deck"] = scene.deck().file;
  json["title"] = scene.deck().title;
  json["ended"] = path::toString(outcome.reason);
  json["why"] = outcome.text;
  json["reached_stop"] = outcome.reason == path::EndReason::stopReached;
  json["load_factor"] = outcome.final.lambda;
  json["path_length"] = outcome.pathLength;
  json["path_weight"] = outcome.weight;
  json["steps"] = outcome.steps;
  json["order"] = scene.deck().path.order;
  json["orders_computed"] = outcome.orders;
  json["factorizations"] = outcome.factorizations;
  json["solves"] = outcome.solves;
  json["corrections"] = outcome.corrections;
  json["start_iterations"] = outcome.startIterations;
  json["restarts"] = outcome.restarts;
  json["retreats"] = outcome.retreats;
  json["critical_factorizations"] = outcome.criticalFactorizations;
  json["closings"] = outcome.closings;
  json["cut_backs"] = outcome.cutBacks;
  json["residual_bound"] = scene.deck().path.residual;
  json["worst_residual"] = recorder.worstResidual();
  json["worst_residual_at_step_ends"] = outcome.worstResidual;
  json["nodes"] = scene.mesh().numNodes();
  json["elements"] = scene.mesh().numElements();
  json["unknowns"] = scene.numUnknowns();
  json["free_unknowns"] = scene.problem().numFreeDofs();
  json["contact_points"] = scene.numContactPoints();
  json["solver"] = solver.name();
  json["execution_space"] = Kokkos::DefaultExecutionSpace::name();
  json["threads"] = Kokkos::DefaultExecutionSpace::concurrency();
  json["series_bytes"] = scene.problem().historyBytes(scene.deck().path.order);
  json["seconds"] = {{"tangent", w.tangent},       {"factorization", w.factor},
                     {"solves", w.solve},          {"order_rhs", w.orderRhs},
                     {"residual", w.residual},     {"output", recorder.outputSeconds()},
                     {"total", recorder.seconds()}};
  return json;
}

}  // namespace

RunResult runScene(Scene& scene, const RunOptions& options) {
  const deck::Deck& deck = scene.deck();
  fem::FeProblem& problem = scene.problem();
  linear::TangentSolverOptions solverOptions;
  solverOptions.type = deck.solver.spec();
  solverOptions.symmetric = problem.symmetric();
  const auto solver = linear::makeTangentSolver(solverOptions);

  path::Options pathOptions;
  pathOptions.order = deck.path.order;
  pathOptions.delta = deck.path.accuracy;
  pathOptions.residualBound = deck.path.residual;
  pathOptions.direction = deck.path.direction;
  pathOptions.maxSteps = deck.path.stop.steps;
  path::PathFollower follower(problem, *solver, pathOptions, scene.stops());

  prepareFolder(options.directory, {"path.csv", "results.exo", "summary.json", "path.png"});
  // A run that is killed must not leave an earlier run's summary and picture beside its own table.
  for (const char* old : {"summary.json", "path.png"}) std::filesystem::remove(options.directory + "/" + old);
  interrupted = false;
  SignalGuard signals;
  Recorder recorder(scene, options);
  const path::State start{problem.initialState(0.0), 0.0};
  recorder.writeStart(start);
  const path::Outcome outcome = follower.run(start, recorder);
  replaceFile(options.directory + "/summary.json", summary(scene, outcome, *solver, recorder).dump(2) + "\n");
  const std::string plot = plotPath(options.directory, deck.title, scene.monitorNames());

  RunResult result;
  result.reachedStop =
      outcome.reason == path::EndReason::stopReached || outcome.reason == path::EndReason::stepLimit;
  result.text = interrupted ? "interrupted; every finished step is on disk" : outcome.text;
  if (options.progress) {
    *options.progress << fmt::format(
        "{} steps, {} factorizations, {} solves, {:.2f} s; worst residual {:.2e}\n", outcome.steps,
        outcome.factorizations, outcome.solves, recorder.seconds(), recorder.worstResidual());
    if (!plot.empty()) *options.progress << plot << '\n';
  }
  return result;
}

}  // namespace atrapos
