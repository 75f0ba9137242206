// Time and memory of a step over the size of the problem, by part: shells and solids, each size in a process
// of its own. docs/bench/scaling.md says what the columns mean.
//
//     bench_scaling --csv scaling.csv
//     bench_scaling --families shell --sizes 5000 15000 --threads 1 --csv small.csv
//     bench_scaling --threads 1 --ranks 1 2 --csv ranks.csv

#include <fmt/format.h>
#include <sys/wait.h>

#include <CLI/CLI.hpp>
#include <Kokkos_Core.hpp>
#include <Tpetra_Vector.hpp>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <thread>

#include "CsvCells.hpp"
#include "Families.hpp"
#include "commands/MeshCommand.hpp"
#include "commands/Run.hpp"
#include "commands/RunSettings.hpp"
#include "commands/SceneCase.hpp"
#include "machine/Memory.hpp"
#include "machine/Ranks.hpp"
#include "machine/Runtime.hpp"

namespace {

using namespace atrapos;

struct Options {
  std::vector<std::string> families = bench::families();
  std::vector<double> sizes{5000, 15000, 50000, 150000, 500000};
  std::vector<int> threads{1, 2}, ranks{1};
  int steps = 2, repeats = 3;
  double longest = 1800;
  std::string csv, folder;
  bool oversubscribe = false;
  bool row = false;  ///< this process makes one row
};

constexpr const char* header =
    "family,asked,unknowns,ranks,threads,elements,contact_points,steps,factorizations,solves,orders,setup_s,"
    "tangent_s,analysis_s,factor_s,solve_s,order_s,contact_s,residual_s,output_s,total_s,matrix_bytes,factor_"
    "bytes,factor_entries,"
    "factor_operations,history_bytes,foreseen_bytes,peak_bytes,rank_peak_bytes,end";

using Clock = std::chrono::steady_clock;
double since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// Seconds of the contact terms in the orders of one series: their share of the sums, on their own, on the
/// rank that takes longest.
double contactSeconds(Scene& scene, int order) {
  const fem::ConstDofView u = scene.problem().onRank({scene.problem().initialState(0.0), 0.0});
  const fem::DofView force("force", u.size()), coefficient("coefficient", u.size());
  // Any coefficients do: the work does not depend on them.
  Kokkos::deep_copy(coefficient, 1e-6);
  Kokkos::fence();
  const auto start = Clock::now();
  for (const ContactPoints& contact : scene.contacts())
    for (const int t : contact.terms) {
      fem::Term& term = *scene.problem().model().terms[t];
      term.beginSeries(u, 0, order);
      for (int k = 1; k <= order; ++k) term.addOrder(k, coefficient, 0, force);
    }
  Kokkos::fence();
  const double own = since(start);
  double slowest = 0;
  MPI_Allreduce(&own, &slowest, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
  return slowest;
}

/// Bytes that the rank with the most had at most.
double largestPeak() {
  const double own = residentMemory().peak;
  double largest = 0;
  MPI_Allreduce(&own, &largest, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
  return largest;
}

/// One run, by this process and the ranks that work with it; the first one prints its row.
int makeRow(const Options& options) {
  const auto begin = Clock::now();
  const std::string folder = options.folder;
  const auto deck = deck::readDeckText(
      bench::familyDeck(options.families.at(0), options.sizes.at(0), options.steps), folder + "/deck.yaml");
  const Runtime runtime(options.threads.at(0));
  std::string line;
  {
    Scene scene(deck, generateMesh(deck));
    SceneCase pathCase(scene);
    const double setup = since(begin);
    const int order = historyOrder(deck.path);
    const double histories = static_cast<double>(scene.problem().historyBytes(order));  // collective
    MemoryEstimate foreseen;
    linear::FactorCost factor;
    {
      const auto solver = tangentSolver(pathCase);
      foreseen = estimateMemory(scene.problem(), pathCase.start(), deck.path, *solver, histories);
      factor = linear::estimate(*solver).value_or(linear::FactorCost{});
    }
    const MachineMemory machines = allMachines();
    const double room = machines.available + residentOfAll().now;
    const bool fits = !(machines.available > 0) || foreseen.total() < room;
    const auto format = [&](const nlohmann::json& s, double contact, double largest, const std::string& end) {
      const auto seconds = s.value("seconds", nlohmann::json::object());
      const auto of = [&](const char* part) { return seconds.value(part, 0.0); };
      const auto count = [&](const char* name) { return s.value(name, 0LL); };
      const auto memory = s.value("memory_bytes", nlohmann::json::object());
      return fmt::format(
          "{},{:g},{},{},{},{},{},{},{},{},{},{:.4g},{:.4g},{:.4g},{:.4g},{:.4g},{:.4g},{:.4g},{:.4g},{:.4g},"
          "{:.4g},{:.4g},{:.4g},{:.4g},{:.4g},{:.4g},{:.4g},{:.4g},{:.4g},{}",
          options.families[0], options.sizes[0], scene.problem().numFreeDofs(), ranks::count(),
          options.threads[0], scene.mesh().numElements(), scene.numContactPoints(), count("steps"),
          count("factorizations"), count("solves"), count("orders_computed"), setup, of("tangent"),
          of("analysis"), of("factorization"), of("solves"), of("order_rhs"),
          contact * static_cast<double>(count("orders_computed")) / order, of("residual"), of("output"),
          of("total"), foreseen.matrix, memory.value("factor", 0.0), factor.entries, factor.operations,
          histories, foreseen.total(), memory.value("peak", 0.0), largest, end);
    };
    if (fits) {
      RunOptions run;
      run.directory = folder + "/results";
      const RunResult result = runPath(scene.deck(), pathCase, run);
      const double contact = contactSeconds(scene, order);
      const double largest = largestPeak();
      if (ranks::isFirst()) {
        std::ifstream file(run.directory + "/summary.json");
        const auto summary = nlohmann::json::parse(file);
        line = format(summary, contact, largest, result.reachedStop ? "done" : result.text);
      }
    } else {
      line = format(nlohmann::json::object(), 0, 0, "does not fit");
    }
  }
  if (ranks::isFirst()) std::cout << line << std::endl;
  return 0;
}

/// A row by other processes, so that its memory is their own.
std::string rowOf(const std::string& program, const std::string& family, double size, int ranks, int threads,
                  int steps) {
  std::string folder = (std::filesystem::temp_directory_path() / "bench_scaling_XXXXXX").string();
  if (!mkdtemp(folder.data())) throw std::runtime_error("bench_scaling: no temporary folder");
  const std::string command =
      (ranks > 1 ? fmt::format("'{}' --oversubscribe --bind-to none -np {} ", ATRAPOS_MPIEXEC, ranks) : "") +
      fmt::format("'{}' --row --families {} --sizes {:g} --threads {} --steps {} --folder {}", program,
                  family, size, threads, steps, folder);
  std::string out;
  FILE* pipe = popen(command.c_str(), "r");
  if (!pipe) throw std::runtime_error("bench_scaling: cannot start " + command);
  char buffer[4096];
  while (fgets(buffer, sizeof buffer, pipe)) out += buffer;
  const int status = pclose(pipe);
  std::filesystem::remove_all(folder);
  while (!out.empty() && out.back() == '\n') out.pop_back();
  const auto last = out.rfind('\n');
  if (last != std::string::npos) out = out.substr(last + 1);
  if (status == 0 && out.rfind(family + ",", 0) == 0) return out;
  // Killed, by the memory's end perhaps.
  return fmt::format("{},{:g},,{},{}{}{}", family, size, ranks, threads, std::string(23, ','),
                     fmt::format(",ended with status {}", status));
}

/// The row whose seconds, column by column, are the least of all: what else the machine did only adds to
/// them.
std::string fastest(const std::vector<std::string>& rows) {
  const auto names = bench::csvCells(header);
  auto best = bench::csvCells(rows.front());
  for (const auto& row : rows) {
    const auto cells = bench::csvCells(row);
    if (cells.size() != names.size() || cells.back() != "done") return row;
    for (std::size_t i = 0; i < names.size(); ++i)
      if (names[i].substr(names[i].size() - 2) == "_s" && std::stod(cells[i]) < std::stod(best[i]))
        best[i] = cells[i];
  }
  return fmt::format("{}", fmt::join(best, ","));
}

int measure(const Options& options, const std::string& program) {
  std::ofstream file;
  if (!options.csv.empty()) {
    file.open(options.csv);
    file << header << std::endl;
    if (!file) throw std::runtime_error("bench_scaling: " + options.csv + " cannot be written");
  }
  fmt::print("{}\n", header);
  // (ranks, threads); those that do not fit the machine would measure each other.
  const int processors = static_cast<int>(std::thread::hardware_concurrency());
  std::vector<std::pair<int, int>> ways;
  for (const int ranks : options.ranks)
    for (const int threads : options.threads)
      if (options.oversubscribe || ranks * threads <= processors || ranks * threads == 1)
        ways.emplace_back(ranks, threads);
      else
        fmt::print(stderr, "bench_scaling: left out: {} ranks with {} threads on {} processors\n", ranks,
                   threads, processors);
  for (const auto& family : options.families)
    for (const auto& [ranks, threads] : ways) {
      double last = 0, before = 0;
      for (const double size : options.sizes) {
        // Solids grow like the square of the size at worst.
        if (before > 0 && last * (size / before) * (size / before) > 3 * options.longest) break;
        std::vector<std::string> rows;
        last = 0;
        for (double all = 0; static_cast<int>(rows.size()) < options.repeats && all + last < 300;
             all += last) {
          const auto start = Clock::now();
          rows.push_back(rowOf(program, family, size, ranks, threads, options.steps));
          last = since(start);
        }
        const std::string row = fastest(rows);
        before = size;
        fmt::print("{}\n", row);
        std::fflush(stdout);
        if (file.is_open()) file << row << std::endl;
        if (last > options.longest) break;
      }
    }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("Time and memory of a step over the size of the problem");
  app.add_option("--families", options.families, "of shell, solid")
      ->check(CLI::IsMember(bench::families()))
      ->capture_default_str();
  app.add_option("--sizes", options.sizes, "numbers of unknowns, about, ascending")
      ->check(CLI::Range(1000.0, 1e8))
      ->capture_default_str();
  app.add_option("--ranks", options.ranks, "numbers of ranks, by mpirun")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  app.add_option("--threads", options.threads, "threads of the element loops, a rank")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  app.add_option("--steps", options.steps, "steps of each path")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option(
         "--repeats", options.repeats,
         "runs of each size, of which the least seconds count; fewer where they take more than five minutes")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_flag("--oversubscribe", options.oversubscribe,
               "runs with more ranks and threads than there are processors too, for their memory");
  app.add_option("--longest", options.longest,
                 "seconds of a run beyond which a family's larger sizes are left out")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--csv", options.csv, "file to write");
  app.add_flag("--row", options.row, "one row, in this process")->group("");
  app.add_option("--folder", options.folder, "of its results")->group("");
  CLI11_PARSE(app, argc, argv);
  try {
    if (options.row) return makeRow(options);
    return measure(options, std::filesystem::canonical("/proc/self/exe").string());
  } catch (const std::exception& error) {
    fmt::print(stderr, "bench_scaling: {}\n", error.what());
    return 1;
  }
}
