#include "commands/RunSettings.hpp"

#include <Kokkos_Core.hpp>
#include <Tpetra_Map.hpp>
#include <algorithm>
#include <ostream>

#include "atrapos/linear/MakeTangentSolver.hpp"
#include "machine/Memory.hpp"

namespace atrapos {

path::Options pathOptions(const PathCase& pathCase) {
  const deck::Path& path = pathCase.deck().path;
  path::Options options;
  options.order = path.order;
  options.autoOrder = path.autoOrder;
  options.delta = path.accuracy;
  options.residualBound = path.residual;
  options.jumpBound = path.jump;
  options.direction = path.direction * pathCase.direction();
  options.weight = path.weight;
  options.pade = path.pade;
  options.criticalPoints = path.criticalPoints != deck::Path::Critical::Off;
  options.searchEveryStep = path.criticalPoints == deck::Path::Critical::EveryStep;
  if (path.hopf) options.hopfEigenvalues = path.hopfEigenvalues;
  options.maxSteps = path.stop.steps;
  return options;
}

path::NewtonOptions newtonOptions(const PathCase& pathCase) {
  const deck::Path& path = pathCase.deck().path;
  path::NewtonOptions options;
  options.kind =
      path.method == deck::Path::Method::Newton ? path::NewtonKind::full : path::NewtonKind::modified;
  options.residualBound = path.residual;
  if (path.cubicAccuracy) options.accuracy = *path.cubicAccuracy;
  options.direction = path.direction * pathCase.direction();
  options.weight = path.weight;
  options.maxSteps = path.stop.steps;
  return options;
}

namespace {

constexpr const char* uncounted =
    "negative eigenvalues are not counted (-1 in path.csv) and no bifurcation points are looked for";

/// Bytes that the deck allows, or that are free and not taken by histories and the two series.
double solverMemory(PathCase& pathCase) {
  const deck::Deck& deck = pathCase.deck();
  if (deck.solver.memory) return 1e9 * *deck.solver.memory;
  const double vector =
      sizeof(double) * static_cast<double>(pathCase.problem().map()->getGlobalNumElements());
  const double free = machineMemory().available;
  if (!(free > 0)) return 0;  // the system does not tell
  const double rest = free - pathCase.historyBytes() - 2 * (historyOrder(deck.path) + 1) * vector;
  return std::max(rest, 1.0);
}

}  // namespace

std::unique_ptr<linear::TangentSolver> tangentSolver(PathCase& pathCase, std::ostream* progress) {
  using Type = deck::Solver::Type;
  const deck::Deck& deck = pathCase.deck();
  linear::TangentSolverOptions options;
  options.type = deck.solver.spec();
  options.symmetric = pathCase.problem().symmetric();
  if (deck.solver.preconditioner == deck::Solver::Preconditioner::Ilu)
    options.krylov.preconditioner = linear::KrylovOptions::Preconditioner::ilu;
  options.krylov.lowRank = deck.solver.lowRank.value_or(0);
  options.krylov.tolerance = krylovTolerance(deck.path.residual);
  options.factorThreads = Kokkos::DefaultExecutionSpace::concurrency();
  if (deck.solver.type == Type::Auto) {
    options.memory = solverMemory(pathCase);
    if (progress)
      options.tell = [progress](const std::string& line) { *progress << "solver: " << line << '\n'; };
  }
  auto solver = linear::makeTangentSolver(options);
  if (progress && (deck.solver.type == Type::Belos || deck.solver.type == Type::Amesos2))
    *progress << "solver: " << solver->name() << ": " << uncounted << '\n';
  return solver;
}

double krylovTolerance(double residualBound) {
  constexpr double share = 1e-3;
  return share * residualBound;
}

path::BranchOptions branchOptions(const deck::Path& path) {
  path::BranchOptions options;
  options.follow = path.branches;
  options.maxDepth = path.branchDepth;
  options.maxBranches = path.branchCount;
  return options;
}

}  // namespace atrapos
