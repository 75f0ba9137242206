#pragma once

#include <string>
#include <vector>

#include "atrapos/linear/FactorCost.hpp"
#include "atrapos/linear/TangentSolver.hpp"
#include "atrapos/path/Problem.hpp"
#include "deck/Deck.hpp"

namespace atrapos {

/// Bytes of this process: resident now, and at most so far; 0 where the system does not tell.
struct ResidentMemory {
  double now = 0, peak = 0;
};
ResidentMemory residentMemory();
/// The same of all ranks together. Collective.
ResidentMemory residentOfAll();

/// Bytes of the machine, or of the control group that the process is in where that has fewer: all, and those
/// that are free for it now (what it has itself not counted); 0 where the system does not tell.
struct MachineMemory {
  double total = 0, available = 0;
};
MachineMemory machineMemory();
/// The same of all machines that ranks run on. Collective.
MachineMemory allMachines();

/// The highest order whose histories a run may need.
int historyOrder(const deck::Path& path);

/// What a run will have in memory at the same time.
struct MemoryEstimate {
  struct Part {
    std::string name, what;
    double bytes = 0;
  };
  std::vector<Part> parts;
  double analysisPeak = 0;  ///< most that the processes had during the estimate, analysis included
  double matrix = 0;        ///< of the matrix, which is among what is there already

  /// The larger of the parts' sum and of what the analysis takes in passing.
  double total() const;
};

/// Assembles the tangent at rest and lets the solver analyse it: the factor by that analysis, histories as
/// the terms will allocate them, what is there already as the system counts it. `historyBytes`: of the
/// path's order. All sizes are those of all ranks together. Collective.
MemoryEstimate estimateMemory(path::Problem& problem, const path::State& start, const deck::Path& path,
                              linear::TangentSolver& solver, double historyBytes);

/// Lines for the user: the parts, and a warning where they do not fit into `machine`, which names the part
/// from which on they do not and what could be done.
std::vector<std::string> describe(const MemoryEstimate& estimate, const MachineMemory& machine);

/// "1.23 GB" and so on.
std::string inBytes(double bytes);

}  // namespace atrapos
