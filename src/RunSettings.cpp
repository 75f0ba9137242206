#include "RunSettings.hpp"

namespace atrapos {

path::Options pathOptions(const deck::Path& path) {
  path::Options options;
  options.order = path.order;
  options.autoOrder = path.autoOrder;
  options.delta = path.accuracy;
  options.residualBound = path.residual;
  options.direction = path.direction;
  options.weight = path.weight;
  options.pade = path.pade;
  options.criticalPoints = path.criticalPoints != deck::Path::Critical::Off;
  options.searchEveryStep = path.criticalPoints == deck::Path::Critical::EveryStep;
  options.maxSteps = path.stop.steps;
  return options;
}

path::BranchOptions branchOptions(const deck::Path& path) {
  path::BranchOptions options;
  options.follow = path.branches;
  options.maxDepth = path.branchDepth;
  options.maxBranches = path.branchCount;
  return options;
}

}  // namespace atrapos
