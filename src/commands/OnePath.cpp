#include "commands/OnePath.hpp"

#include "atrapos/path/NewtonFollower.hpp"
#include "commands/RunSettings.hpp"

namespace atrapos {

bool OnePath::onStep(const path::StepReport& report, const path::Series& series) {
  const int branch = progress_.current;
  if (keepsPoints_)
    for (const auto& point : report.criticalPoints)
      progress_.diagram.points.push_back({point, branch, report.step});
  progress_.path = report.next;
  const bool more = recorder_.onStep(branch, report, series);
  recorder_.onProgress(progress_);
  return more;
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
