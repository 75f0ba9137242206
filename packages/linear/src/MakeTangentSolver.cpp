#include "atrapos/linear/MakeTangentSolver.hpp"

#include <fmt/format.h>

#include "Amesos2Solver.hpp"
#include "MumpsSolver.hpp"
#include "atrapos/linear/Error.hpp"

namespace atrapos::linear {

std::vector<std::string> availableTangentSolvers() {
  std::vector<std::string> names{"mumps"};
  for (const auto& solver : Amesos2Solver::available()) names.push_back("amesos2:" + solver);
  return names;
}

std::unique_ptr<TangentSolver> makeTangentSolver(const TangentSolverOptions& options) {
  if (options.type == "mumps") {
    MumpsOptions mumps;
    mumps.symmetric = options.symmetric;
    mumps.nullPivotTolerance = options.nullPivotTolerance;
    return std::make_unique<MumpsSolver>(mumps);
  }
  const std::string prefix = "amesos2:";
  if (options.type.compare(0, prefix.size(), prefix) == 0)
    return std::make_unique<Amesos2Solver>(
        Amesos2Options{options.type.substr(prefix.size()), options.symmetric});
  throw SolverError(fmt::format("no tangent solver \"{}\"; available: {}", options.type,
                                fmt::join(availableTangentSolvers(), ", ")));
}

}  // namespace atrapos::linear
