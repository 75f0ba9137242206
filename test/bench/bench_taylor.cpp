// Speed of Taylor sweeps: one table in one run. docs/bench/taylor.md says what the columns mean.
//
//     bench_taylor --csv taylor.csv
//     bench_taylor --laws saint_venant_kirchhoff --orders 20 --points 1000000 --methods atrapos hand

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <stdexcept>

#include "Inputs.hpp"
#include "Jobs.hpp"

namespace {

using namespace atrapos::bench;

struct Options {
  Selection selection;
  double memoryGB = 0;  ///< 0: 80 % of what is available
  int repetitions = 3;
  bool quick = false;
  std::string csv;
};

/// Takes the best repetition of every benchmark, in the order of the jobs, and prints its line.
class TableReporter : public benchmark::BenchmarkReporter {
 public:
  TableReporter(const std::vector<Job>& jobs, const Peaks& peaks) : jobs_(jobs), peaks_(peaks) {}

  bool ReportContext(const Context&) override {
    fmt::print("{}\n", tableHeader());
    return true;
  }

  void ReportRuns(const std::vector<Run>& runs) override {
    double seconds = 0;
    for (const Run& run : runs) {
      if (run.run_type != Run::RT_Iteration || run.error_occurred) continue;
      // Time of the thread, not of the clock on the wall: the machine may be shared.
      const double s = run.cpu_accumulated_time / static_cast<double>(run.iterations);
      if (seconds == 0 || s < seconds) seconds = s;
    }
    if (seconds == 0) return;  // means and deviations come in a call of their own
    Row row = jobs_.at(rows.size()).row;
    row.usPerPoint = seconds * 1e6 / static_cast<double>(row.points);
    rows.push_back(row);
    fmt::print("{}\n", tableLine(row, rows, peaks_));
    std::fflush(stdout);
  }

  std::vector<Row> rows;

 private:
  const std::vector<Job>& jobs_;
  const Peaks& peaks_;
};

void addOptions(CLI::App& app, Options& o) {
  o.selection.orders = {10, 20, 30, 40};
  o.selection.points = {64, 4096, 65536, 1000000};
  app.add_option("--laws", o.selection.laws, "laws to measure (default: all)")
      ->check(CLI::IsMember(lawNames()));
  app.add_option("--methods", o.selection.methods, "methods to measure (default: all)")
      ->check(CLI::IsMember(methodNames()));
  app.add_option("--orders", o.selection.orders, "highest orders K")
      ->capture_default_str()
      ->check(CLI::Range(1, 200));
  app.add_option("--points", o.selection.points, "numbers of points, rounded up to whole batches")
      ->capture_default_str()
      ->check(CLI::Range(1, 100000000));
  app.add_option("--memory", o.memoryGB, "GB to use at most (default: 80 % of what is available)")
      ->check(CLI::PositiveNumber);
  app.add_option("--repetitions", o.repetitions, "the best of so many is reported")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000));
  app.add_option("--csv", o.csv, "write the table to this file");
  app.add_flag("--quick", o.quick, "every law and method at order 10 and 64 points, a few seconds");
}

int measure(Options& o) {
  if (o.quick) {
    o.selection.orders = {10};
    o.selection.points = {64};
    o.repetitions = 1;
  }
  if (!o.csv.empty()) writeCsv(o.csv, {});  // fails now rather than after the run
  for (std::size_t& p : o.selection.points) p = (p + kLanes - 1) / kLanes * kLanes;
  // Peers stream, too: twice the last cache.
  o.selection.peerBytes = o.quick ? 0 : 2 * lastCacheBytes();

  const double available = static_cast<double>(availableBytes());
  const double limit = o.memoryGB > 0 ? o.memoryGB * 1e9 : available > 0 ? 0.8 * available : 4e9;
  std::vector<Job> jobs;
  std::size_t doubles = peakDoubles();
  for (Job& job : makeJobs(o.selection)) {
    if (8.0 * static_cast<double>(job.doubles) > limit) {
      fmt::print("left out: {} order {} points {} {}: {:.1f} GB, limit {:.1f} GB (--memory)\n", job.row.law,
                 job.row.order, job.row.points, job.row.method, 8e-9 * static_cast<double>(job.doubles),
                 limit * 1e-9);
      continue;
    }
    doubles = std::max(doubles, job.doubles);
    jobs.push_back(std::move(job));
  }

  if (jobs.empty())
    throw std::runtime_error(
        "nothing to measure: no chosen law has a chosen method, or none fits into memory");
  Arena arena(doubles * sizeof(double));
  const Peaks peaks = measurePeaks(arena, o.quick ? 0.05 : 1.0);
  fmt::print(
      "one core, measured: {:.1f} GF/s FMA, {:.1f} GB/s read, {:.1f} GB/s triad; last cache {} MiB\n\n",
      peaks.gflops, peaks.readGBs, peaks.triadGBs, lastCacheBytes() >> 20);

  constexpr double inCache = 4e6;  // bytes below which a run takes so little that it is timed many times over
  for (const Job& job : jobs) {
    auto* b = benchmark::RegisterBenchmark(
        fmt::format("{}/{}/{}/{}", job.row.law, job.row.order, job.row.points, job.row.method).c_str(),
        [&arena, &job](benchmark::State& state) {
          double* memory = arena.get(job.doubles);
          for (auto _ : state) {
            job.run(memory);
            benchmark::ClobberMemory();
          }
        });
    if (job.slow && !o.quick)
      b->Iterations(1)->Repetitions(1);
    else if (job.row.footprint > inCache)
      b->Iterations(1)->Repetitions(o.repetitions);
    else
      b->MinTime(0.02)->Repetitions(o.quick ? 1 : 5 * o.repetitions);  // short ones dodge what else runs
  }
  TableReporter reporter(jobs, peaks);
  benchmark::RunSpecifiedBenchmarks(&reporter);
  if (!o.csv.empty()) writeCsv(o.csv, reporter.rows);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "Time of all Taylor coefficients 0..K of a law: this project, a hand-written kernel, Sacado, ADOL-C"};
  Options options;
  addOptions(app, options);
  CLI11_PARSE(app, argc, argv);
  try {
    return measure(options);
  } catch (const std::exception& e) {
    fmt::print(stderr, "bench_taylor: {}\n", e.what());
    return 1;
  }
}
