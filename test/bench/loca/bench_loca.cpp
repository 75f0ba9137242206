// LOCA on a deck, held against the reference of a chart: a table for `atrapos chart` (docs/chart.md, LOCA).
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "LocaRun.hpp"
#include "atrapos/linear/MakeTangentSolver.hpp"
#include "chart/Chart.hpp"
#include "chart/PathError.hpp"
#include "deck/Deck.hpp"
#include "machine/Runtime.hpp"
#include "scene/Scene.hpp"

namespace {

using namespace atrapos;

struct Options {
  std::string chart, deck, reference, table;
  std::vector<double> longest{1e3, 0.5, 0.2, 0.1, 0.05, 0.02, 0.01};
  double residual = 1e-8;
  int threads = 1;
};

/// What the chart calls `over` and `monitor`, at LOCA's points.
class Columns {
 public:
  Columns(const Scene& scene, const chart::Chart& chart)
      : scene_(scene), over_(find(chart.over)), monitor_(find(chart.monitors.front())) {}

  chart::PathRows of(const std::vector<path::State>& points) const {
    chart::PathRows rows;
    for (const path::State& point : points) {
      const auto values = scene_.monitors(scene_.at(point));
      rows.over.push_back(over_ < 0 ? point.lambda : values[over_]);
      rows.monitor.push_back(monitor_ < 0 ? point.lambda : values[monitor_]);
    }
    return rows;
  }

 private:
  /// -1: the load factor.
  int find(const std::string& name) const {
    const auto names = scene_.monitorNames();
    for (std::size_t i = 0; i < names.size(); ++i)
      if (names[i] == name) return static_cast<int>(i);
    if (name == "load_factor") return -1;
    throw std::invalid_argument("the deck has no monitor " + name);
  }

  const Scene& scene_;
  int over_, monitor_;
};

void run(const Options& options) {
  const chart::Chart chart = chart::readChart(options.chart);
  const deck::Deck deck = deck::readDeck(options.deck);
  if (chart.monitors.size() > 1)
    throw std::invalid_argument("error/monitor: LOCA's errors are those of one; expected a chart of one");
  if (chart.reference.own && options.reference.empty())
    throw std::invalid_argument("--reference: the path.csv of the chart's reference is needed");
  const auto reference = chart::ReferenceCurve::of(chart, options.reference, 0);
  Scene scene(deck, readDeckMesh(deck));
  if (scene.contactsGrow())
    throw std::invalid_argument("contacts whose points come along the path are not for LOCA: carried: all");
  const auto isPast = thyra::test::pastFirst(scene.stops());
  const Columns columns(scene, chart);
  std::string table = "longest,seconds,factorizations,solves,steps,failed_steps,error\n";
  for (const double longest : options.longest) {
    thyra::test::LocaOptions loca;
    loca.firstStep = std::min(1e-3, longest);
    loca.maxStep = longest;
    loca.residualBound = options.residual;
    loca.maxSteps = 20000;
    loca.stop = isPast;
    linear::TangentSolverOptions solverOptions;
    solverOptions.symmetric = scene.problem().symmetric();
    const auto solver = linear::makeTangentSolver(solverOptions);
    thyra::test::LocaRun run;
    try {
      run = thyra::test::followWithLoca(scene.problem(), *solver, {scene.problem().initialState(0.0), 0.0},
                                        loca);
    } catch (const std::exception& error) {  // a step too long for the problem
      fmt::print(stderr, "longest step {:g}: {}\n", longest, error.what());
      continue;
    }
    if (!run.stopped) {
      fmt::print(stderr, "longest step {:g}: no stop of the deck reached after {} steps\n", longest,
                 run.steps);
      continue;
    }
    const auto error = chart::errorOf(columns.of(run.points), options.deck, chart, *reference);
    table += fmt::format("{:g},{:.4g},{},{},{},{},{:.4g}\n", longest, run.seconds, run.factorizations,
                         run.solves, run.steps, run.failedSteps, error.largest);
    fmt::print("longest step {:g}: error {:.3g} at {:g}, {} factorizations, {:.3g} s\n", longest,
               error.largest, error.at, run.factorizations, run.seconds);
    std::fflush(stdout);
  }
  std::ofstream file(options.table);
  file << table;
  if (!file.flush()) throw std::runtime_error(options.table + ": cannot be written");
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("LOCA on a deck: a table for a chart");
  app.add_option("CHART", options.chart, "whose reference, monitor and places count")->required();
  app.add_option("DECK", options.deck, "deck with its mesh beside it, for instance of a run of the chart")
      ->required();
  app.add_option("TABLE", options.table, "file to write")->required();
  app.add_option("--reference", options.reference, "path.csv of the chart's reference, where that is a run");
  app.add_option("--longest", options.longest, "longest steps, one run each")->delimiter(',');
  app.add_option("--residual", options.residual, "bound of the relative residual");
  app.add_option("-t,--threads", options.threads, "of the element loops");
  CLI11_PARSE(app, argc, argv);
  const Runtime runtime(options.threads);
  try {
    run(options);
  } catch (const std::exception& error) {
    std::cerr << "bench_loca: " << error.what() << '\n';
    return 2;
  }
  return 0;
}
