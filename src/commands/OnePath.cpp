#include "commands/OnePath.hpp"

#include <algorithm>

#include "atrapos/path/NewtonFollower.hpp"
#include "commands/RunSettings.hpp"

namespace atrapos {

bool OnePath::onStep(const path::StepReport& report, const path::Series& series) {
  changed_ = case_.changedOn(report.length, series);
  if (changed_) return false;
  const int branch = progress_.current;
  if (keepsPoints_)
    for (const auto& point : report.criticalPoints)
      progress_.diagram.points.push_back({point, branch, report.step});
  progress_.path = report.next;
  const bool more = recorder_.onStep(branch, report, series);
  recorder_.onProgress(progress_);
  return more;
}

path::Outcome OnePath::sum(const path::Outcome& first, path::Outcome last) {
  last.factorizations += first.factorizations;
  last.events += first.events;
  last.eventTrials += first.eventTrials;
  last.solves += first.solves;
  last.orders += first.orders;
  last.startIterations += first.startIterations;
  last.corrections += first.corrections;
  last.restarts += first.restarts;
  last.retreats += first.retreats;
  last.criticalFactorizations += first.criticalFactorizations;
  last.closings += first.closings;
  last.cutBacks += first.cutBacks;
  last.jumps += first.jumps;
  last.worstResidual = std::max(last.worstResidual, first.worstResidual);
  last.worstJump = std::max(last.worstJump, first.worstJump);
  last.seconds.tangent += first.seconds.tangent;
  last.seconds.analysis += first.seconds.analysis;
  last.seconds.factor += first.seconds.factor;
  last.seconds.solve += first.seconds.solve;
  last.seconds.orderRhs += first.seconds.orderRhs;
  last.seconds.residual += first.seconds.residual;
  last.seconds.total += first.seconds.total;
  return last;
}

void followOne(PathCase& pathCase, path::Problem& problem, linear::TangentSolver& solver, Recorder& recorder,
               path::BranchProgress& progress, bool keepsPoints) {
  OnePath path(pathCase, recorder, progress, keepsPoints);
  if (pathCase.deck().path.series()) {
    path::PathFollower follower(problem, solver, pathOptions(pathCase), pathCase.stops());
    follower.watch(pathCase.functionals());
    path.follow(follower);
  } else {
    path::NewtonFollower newton(problem, solver, newtonOptions(pathCase), pathCase.stops());
    path.follow(newton);
  }
}

}  // namespace atrapos
