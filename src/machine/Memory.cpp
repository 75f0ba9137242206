#include "machine/Memory.hpp"

#include <fmt/format.h>

#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <fstream>

#include "machine/Ranks.hpp"
#include "machine/Threads.hpp"

namespace atrapos {
namespace {

/// A number of kB behind a name in a file of /proc; 0 where there is none.
double procKilobytes(const char* file, const std::string& name) {
  std::ifstream in(file);
  for (std::string word; in >> word;) {
    double value = 0;
    if (word == name && in >> value) return 1024 * value;
  }
  return 0;
}

double numberIn(const char* file) {
  std::ifstream in(file);
  double value = 0;
  return in >> value ? value : 0;  // "max": no limit
}

}  // namespace

ResidentMemory residentMemory() {
  return {procKilobytes("/proc/self/status", "VmRSS:"), procKilobytes("/proc/self/status", "VmHWM:")};
}

MachineMemory machineMemory() {
  MachineMemory memory{procKilobytes("/proc/meminfo", "MemTotal:"),
                       procKilobytes("/proc/meminfo", "MemAvailable:")};
  const double limit = numberIn("/sys/fs/cgroup/memory.max");
  if (limit > 0 && (memory.total == 0 || limit < memory.total)) {
    memory.total = limit;
    const double left = std::max(0.0, limit - numberIn("/sys/fs/cgroup/memory.current"));
    memory.available = memory.available > 0 ? std::min(memory.available, left) : left;
  }
  return memory;
}

ResidentMemory residentOfAll() {
  const ResidentMemory own = residentMemory();
  return {ranks::sum(own.now), ranks::sum(own.peak)};
}

MachineMemory allMachines() {
  const MachineMemory here = machineMemory();
  const double share = 1.0 / threads::machine(ranks::communicator()).ranks;
  return {ranks::sum(share * here.total), ranks::sum(share * here.available)};
}

int historyOrder(const deck::Path& path) {
  constexpr int mostOfAuto = 40;
  return !path.series() ? 0 : path.autoOrder ? mostOfAuto : path.order;
}

double MemoryEstimate::total() const {
  double sum = 0;
  for (const Part& part : parts) sum += part.bytes;
  return std::max(sum, analysisPeak);
}

MemoryEstimate estimateMemory(path::Problem& problem, const path::State& start, const deck::Path& path,
                              linear::TangentSolver& solver, double historyBytes) {
  MemoryEstimate estimate;
  path::Vector F(problem.map());
  const auto K = problem.tangent(start, F);
  const double rows = static_cast<double>(K->getGlobalNumRows());
  const double entries = static_cast<double>(K->getGlobalNumEntries());
  estimate.matrix = entries * (sizeof(double) + sizeof(linear::LocalIndex)) + rows * sizeof(std::size_t);
  estimate.parts.push_back(
      {"set up", fmt::format("program, mesh, elements, matrix ({} of it)", inBytes(estimate.matrix)),
       residentOfAll().now});
  solver.analyze(K);
  const auto factor = linear::estimate(solver);
  estimate.parts.push_back({"factor",
                            factor ? fmt::format("by {}'s analysis: {:.3g} entries, {:.3g} operations",
                                                 solver.name(), factor->entries, factor->operations)
                                   : fmt::format("{} does not tell before", solver.name()),
                            factor ? factor->bytes : 0});
  const double vector = rows * sizeof(double);
  if (path.series()) {
    const int order = historyOrder(path);
    estimate.parts.push_back({"histories", fmt::format("of order {}", order), historyBytes});
    // The series under way and the one before it, which output still reads.
    estimate.parts.push_back({"series", fmt::format("2 of {} vectors", order + 1), 2 * (order + 1) * vector});
  } else {
    estimate.parts.push_back({"points", "cubic, states and corrections, 16 vectors", 16 * vector});
  }
  estimate.analysisPeak = residentOfAll().peak;
  return estimate;
}

std::string inBytes(double bytes) {
  const char* const units[] = {"kB", "MB", "GB", "TB"};
  double value = bytes / 1e3;
  int unit = 0;
  for (; value >= 1000 && unit < 3; ++unit) value /= 1000;
  return fmt::format("{:.3g} {}", value, units[unit]);
}

std::vector<std::string> describe(const MemoryEstimate& estimate, const MachineMemory& machine) {
  std::vector<std::string> lines;
  // What the process has already is not free any more, but its own.
  const double own = estimate.parts.empty() ? 0 : estimate.parts.front().bytes;
  const double room = machine.available > 0 ? machine.available + own : 0;
  lines.push_back(fmt::format(
      "memory    {} in all{}", inBytes(estimate.total()),
      room > 0 ? fmt::format(", the machine has {} for it (of {})", inBytes(room), inBytes(machine.total))
               : ""));
  double sum = 0;
  const MemoryEstimate::Part* first = nullptr;
  for (const auto& part : estimate.parts) {
    sum += part.bytes;
    if (room > 0 && sum > room && !first) first = &part;
    lines.push_back(fmt::format("  {:<10}{:>8}  {}", part.name, inBytes(part.bytes), part.what));
  }
  if (first) {
    const bool ofSeries = first->name == "histories" || first->name == "series";
    lines.push_back(fmt::format(
        "warning   memory: {} are needed, {} are there: from '{}' on it does not fit; a coarser mesh{}",
        inBytes(sum), inBytes(room), first->name,
        ofSeries ? ", a lower path/order or path/method: newton" : ""));
  }
  return lines;
}

}  // namespace atrapos
