// Work against precision of whole paths: by series and by Newton arc-length steps over their tolerances, and
// the points of LOCA where the Trilinos at hand has it. One CSV; docs/bench/path.md says what the columns
// mean.
//
//     bench_path --csv path.csv
//     bench_path --cases roof --refinement 2 --methods series newton

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <Kokkos_Core.hpp>
#include <Tpetra_Core.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <fstream>

#include "PathCase.hpp"
#include "PathSamples.hpp"
#include "atrapos/linear/BlasThreads.hpp"
#include "atrapos/linear/MakeTangentSolver.hpp"
#include "atrapos/path/NewtonFollower.hpp"
#include "atrapos/path/PathFollower.hpp"
#ifdef ATRAPOS_BENCH_LOCA
#include "LocaRun.hpp"
#endif

namespace {

using namespace atrapos;

struct Options {
  std::vector<std::string> cases = bench::pathCases();
  std::vector<std::string> methods{"series", "newton", "modified", "points", "loca"};
  int refinement = 1, samples = 100;
  double unknowns = 0;             ///< 0: by the refinement
  std::vector<double> accuracies;  ///< of Newton steps; empty: those of the whole picture
  bool quick = false;
  std::string csv;
};

struct Row {
  std::string name, method;
  int unknowns = 0;
  double tolerance = 0, residualBound = 0, setting = 0;
  int steps = 0;
  long long factorizations = 0, solves = 0, orders = 0;
  double error = -1;  ///< -1: not known, or the method gives points and nothing between them
  double pathLength = 0;
  path::Timings seconds;
  std::string end;
};

constexpr const char* header =
    "case,unknowns,method,tolerance,residual_bound,setting,steps,factorizations,solves,orders,error,path_"
    "length,"
    "tangent_s,factor_s,solve_s,order_s,residual_s,total_s,end";

std::string csvLine(const Row& r) {
  const auto& s = r.seconds;
  return fmt::format(
      "{},{},{},{:g},{:g},{:g},{},{},{},{},{},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{}", r.name,
      r.unknowns, r.method, r.tolerance, r.residualBound, r.setting, r.steps, r.factorizations, r.solves,
      r.orders, r.error < 0 ? "" : fmt::format("{:.4g}", r.error), r.pathLength, s.tangent, s.factor, s.solve,
      s.orderRhs, s.residual, s.total, r.end);
}

class Bench {
 public:
  explicit Bench(const Options& options) : options_(options) {}

  void run() {
    fmt::print("{}\n", header);
    for (const auto& name : options_.cases) {
      case_ = bench::makePathCase(
          name, options_.unknowns > 0 ? bench::refinementFor(name, options_.unknowns) : options_.refinement);
      judge_ = linear::makeTangentSolver({});
      judged_ = false;
      findLength();
      for (const auto& method : options_.methods) {
        if (method == "series") series();
        if (method == "newton") newton(path::NewtonKind::full, method);
        if (method == "modified") newton(path::NewtonKind::modified, method);
        if (method == "points") points();
        if (method == "loca") loca();
      }
    }
    if (options_.csv.empty()) return;
    std::ofstream file(options_.csv);
    file << header << '\n';
    for (const Row& r : rows_) file << csvLine(r) << '\n';
    if (!file.flush()) throw std::runtime_error("bench_path: " + options_.csv + " cannot be written");
  }

 private:
  path::State start() const { return {case_.problem->initialState(0.0), 0.0}; }

  /// The path's length, for samples at equal distances.
  void findLength() {
    const auto solver = linear::makeTangentSolver({});
    bench::PathSamples none(1e300);
    const auto outcome = path::PathFollower(*case_.problem, *solver, {}, case_.stops).run(start(), none);
    if (outcome.reason != path::EndReason::stopReached)
      throw std::runtime_error(case_.name + ": " + outcome.text);
    spacing_ = outcome.pathLength / options_.samples;
  }

  std::vector<double> tolerances(std::vector<double> all) const {
    if (options_.quick) all.resize(1);
    return all;
  }

  void add(Row row, const path::Outcome& outcome, const bench::PathSamples* samples) {
    row.name = case_.name;
    row.unknowns = case_.problem->numFreeDofs();
    row.steps = outcome.steps;
    row.factorizations = outcome.factorizations;
    row.solves = outcome.solves;
    row.orders = outcome.orders;
    row.pathLength = outcome.pathLength;
    row.seconds = outcome.seconds;
    row.end = path::toString(outcome.reason);
    if (samples && outcome.reason == path::EndReason::stopReached) {
      if (!judged_) {  // the judge's factorizations are nobody's cost
        path::Vector F(case_.problem->map());
        judge_->analyze(case_.problem->tangent({start().u, 0}, F));
        judged_ = true;
      }
      try {
        row.error = bench::worstDistance(*case_.problem, *judge_, *samples, outcome.weight);
      } catch (const std::runtime_error& error) {
        fmt::print(stderr, "bench_path: {} {}: {}\n", row.name, row.method, error.what());
      }
    }
    finish(row);
  }

  void finish(const Row& row) {
    rows_.push_back(row);
    fmt::print("{}\n", csvLine(row));
    std::fflush(stdout);
  }

  void series() {
    for (const int order : options_.quick ? std::vector<int>{20} : std::vector<int>{10, 20, 30})
      for (const double tolerance : tolerances({1e-6, 1e-2, 1e-3, 1e-4, 1e-5, 1e-7, 1e-8})) {
        path::Options options;
        options.order = order;
        options.delta = options.residualBound = tolerance;
        options.criticalPoints = options.closeEnd = false;  // Newton steps do not look for them either
        const auto solver = linear::makeTangentSolver({});
        bench::PathSamples samples(spacing_);
        const auto outcome =
            path::PathFollower(*case_.problem, *solver, options, case_.stops).run(start(), samples);
        Row row;
        row.method = fmt::format("series{}", order);
        row.tolerance = tolerance;
        row.residualBound = tolerance;
        row.setting = order;
        add(row, outcome, &samples);
      }
  }

  void newton(path::NewtonKind kind, const std::string& name) {
    for (const double residual : tolerances({1e-6, 1e-3}))
      for (const double accuracy :
           options_.accuracies.empty() ? tolerances({1e-3, 1e-2, 1e-4, 1e-5, 1e-6}) : options_.accuracies) {
        path::NewtonOptions options;
        options.kind = kind;
        options.accuracy = accuracy;
        options.residualBound = residual;
        const auto solver = linear::makeTangentSolver({});
        bench::PathSamples samples(spacing_);
        const auto outcome =
            path::NewtonFollower(*case_.problem, *solver, options, case_.stops).run(start(), samples);
        Row row;
        row.method = name;
        row.tolerance = accuracy;
        row.residualBound = residual;
        row.setting = 0;
        add(row, outcome, &samples);
      }
  }

  /// What Newton steps cost where only points are wanted, over their one knob.
  void points() {
    for (const auto kind : {path::NewtonKind::full, path::NewtonKind::modified})
      for (const double desired : tolerances({4, 2, 3, 6, 8})) {
        path::NewtonOptions options;
        options.kind = kind;
        options.desiredIterations = desired;
        const auto solver = linear::makeTangentSolver({});
        bench::PathSamples samples(1e300);
        const auto outcome =
            path::NewtonFollower(*case_.problem, *solver, options, case_.stops).run(start(), samples);
        Row row;
        row.method = kind == path::NewtonKind::full ? "points_newton" : "points_modified";
        row.residualBound = options.residualBound;
        row.setting = desired;
        add(row, outcome, nullptr);
      }
  }

  /// The same by LOCA, over the aggressiveness of its step lengths.
  void loca() {
#ifdef ATRAPOS_BENCH_LOCA
    for (const double aggressiveness : tolerances({0.5, 0.1, 1.0, 2.0})) {
      thyra::test::LocaOptions options;
      options.aggressiveness = aggressiveness;
      options.firstStep = 1e-3;  // of the load factor: the strip leaves its path with longer ones
      options.stop = thyra::test::pastFirst(case_.stops);
      const auto solver = linear::makeTangentSolver({});
      const auto run = thyra::test::followWithLoca(*case_.problem, *solver, start(), options);
      Row row;
      row.name = case_.name;
      row.unknowns = case_.problem->numFreeDofs();
      row.method = "points_loca";
      row.residualBound = options.residualBound;
      row.setting = aggressiveness;
      row.steps = run.steps;
      row.factorizations = run.factorizations;
      row.solves = run.solves;
      row.seconds.total = run.seconds;
      row.seconds.factor = solver->counters().factorSeconds;
      row.seconds.solve = solver->counters().solveSeconds;
      row.end = run.stopped ? "stopReached" : "notReached";
      finish(row);
    }
#endif
  }

  const Options& options_;
  bench::PathCase case_;
  std::unique_ptr<linear::TangentSolver> judge_;
  bool judged_ = false;
  double spacing_ = 0;
  std::vector<Row> rows_;
};

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("Work against precision of whole paths: series and Newton arc-length steps");
  app.add_option("--cases", options.cases, "of roof, roof_thin, strip")
      ->check(CLI::IsMember(bench::pathCases()))
      ->capture_default_str();
  app.add_option("--methods", options.methods, "of series, newton, modified, points, loca")
      ->check(CLI::IsMember({"series", "newton", "modified", "points", "loca"}))
      ->capture_default_str();
  app.add_option("--refinement", options.refinement, "multiplies the divisions of the meshes")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--unknowns", options.unknowns, "about so many, by the refinement")
      ->check(CLI::PositiveNumber)
      ->excludes("--refinement");
  app.add_option("--samples", options.samples, "places along a path where its error is measured")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--accuracies", options.accuracies, "of the paths of Newton steps, in place of 1e-2 to 1e-6")
      ->check(CLI::PositiveNumber);
  app.add_flag("--quick", options.quick, "one tolerance of each method");
  app.add_option("--csv", options.csv, "file to write");
  CLI11_PARSE(app, argc, argv);
  const Tpetra::ScopeGuard guard(&argc, &argv);
  try {
    linear::setBlasThreads(1);
    Bench(options).run();
  } catch (const std::exception& error) {
    fmt::print(stderr, "bench_path: {}\n", error.what());
    return 1;
  }
  return 0;
}
