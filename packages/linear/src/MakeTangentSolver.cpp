#include "atrapos/linear/MakeTangentSolver.hpp"

#include <fmt/format.h>

#include "Amesos2Solver.hpp"
#include "AutoSolver.hpp"
#include "KrylovSolver.hpp"
#include "MumpsSolver.hpp"
#include "atrapos/linear/Error.hpp"

namespace atrapos::linear {
namespace {

std::unique_ptr<TangentSolver> mumpsSolver(const TangentSolverOptions& options) {
  MumpsOptions mumps;
  mumps.symmetric = options.symmetric;
  mumps.nullPivotTolerance = options.nullPivotTolerance;
  mumps.factorThreads = options.factorThreads;
  return std::make_unique<MumpsSolver>(mumps);
}

/// Direct while its factor fits, because it alone tells the inertia; then iterations with the better
/// preconditioner that fits.
std::unique_ptr<TangentSolver> autoSolver(const TangentSolverOptions& options) {
  using Preconditioner = KrylovOptions::Preconditioner;
  const auto iterative = [options](Preconditioner preconditioner) {
    return [options, preconditioner] {
      KrylovOptions krylov = options.krylov;
      krylov.preconditioner = preconditioner;
      return std::make_unique<KrylovSolver>(krylov, options.symmetric, options.factorThreads);
    };
  };
  std::vector<AutoSolver::Candidate> candidates{
      {"MUMPS", [options] { return mumpsSolver(options); }},
      {"Belos (negative eigenvalues not counted) with a factor in single precision",
       iterative(Preconditioner::singleFactor)},
      {"Belos (negative eigenvalues not counted) with an incomplete factor", iterative(Preconditioner::ilu)}};
  return std::make_unique<AutoSolver>(std::move(candidates), options.memory, options.tell);
}

}  // namespace

std::vector<std::string> availableTangentSolvers() {
  std::vector<std::string> names{"mumps", "auto", "belos"};
  for (const auto& solver : Amesos2Solver::available()) names.push_back("amesos2:" + solver);
  return names;
}

std::unique_ptr<TangentSolver> makeTangentSolver(const TangentSolverOptions& options) {
  if (options.type == "mumps") return mumpsSolver(options);
  if (options.type == "auto") return autoSolver(options);
  if (options.type == "belos")
    return std::make_unique<KrylovSolver>(options.krylov, options.symmetric, options.factorThreads);
  const std::string prefix = "amesos2:";
  if (options.type.compare(0, prefix.size(), prefix) == 0)
    return std::make_unique<Amesos2Solver>(
        Amesos2Options{options.type.substr(prefix.size()), options.symmetric});
  throw SolverError(fmt::format("no tangent solver \"{}\"; available: {}", options.type,
                                fmt::join(availableTangentSolvers(), ", ")));
}

}  // namespace atrapos::linear
