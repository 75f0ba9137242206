#include "RunSettings.hpp"

#include "atrapos/linear/MakeTangentSolver.hpp"

namespace atrapos {

path::Options pathOptions(const PathCase& pathCase) {
  const deck::Path& path = pathCase.deck().path;
  path::Options options;
  options.order = path.order;
  options.autoOrder = path.autoOrder;
  options.delta = path.accuracy;
  options.residualBound = path.residual;
  options.direction = path.direction * pathCase.direction();
  options.weight = path.weight;
  options.pade = path.pade;
  options.criticalPoints = path.criticalPoints != deck::Path::Critical::Off;
  options.searchEveryStep = path.criticalPoints == deck::Path::Critical::EveryStep;
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

std::unique_ptr<linear::TangentSolver> tangentSolver(PathCase& pathCase) {
  linear::TangentSolverOptions options;
  options.type = pathCase.deck().solver.spec();
  options.symmetric = pathCase.problem().symmetric();
  return linear::makeTangentSolver(options);
}

path::BranchOptions branchOptions(const deck::Path& path) {
  path::BranchOptions options;
  options.follow = path.branches;
  options.maxDepth = path.branchDepth;
  options.maxBranches = path.branchCount;
  return options;
}

}  // namespace atrapos
