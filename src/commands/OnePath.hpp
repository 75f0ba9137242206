#pragma once

#include "atrapos/path/PathFollower.hpp"
#include "commands/GrowingPath.hpp"
#include "commands/PathCase.hpp"
#include "output/Recorder.hpp"

namespace atrapos {

/// A path without branches as the branch of a diagram that is under way (path::BranchProgress::current).
class OnePath final : public path::Observer {
 public:
  /// `keepsPoints`: its bifurcation points become those of the diagram.
  OnePath(PathCase& pathCase, Recorder& recorder, path::BranchProgress& progress, bool keepsPoints)
      : case_(pathCase), recorder_(recorder), progress_(progress), keepsPoints_(keepsPoints) {}

  /// Follows it from where it stands. The branch has the outcome then.
  template <class Follower>
  void follow(Follower& follower) {
    progress_.diagram.branches[progress_.current].outcome =
        GrowingPath(case_, *this).follow(follower, *progress_.path);
  }

  void onSearch(int found, int wanted) override { recorder_.onSearch(progress_.current, found, wanted); }
  bool onStep(const path::StepReport& report, const path::Series& series) override;

 private:
  PathCase& case_;
  Recorder& recorder_;
  path::BranchProgress& progress_;
  bool keepsPoints_;
};

/// The same by the deck's method with the settings of the case: from progress.path on.
void followOne(PathCase& pathCase, path::Problem& problem, linear::TangentSolver& solver, Recorder& recorder,
               path::BranchProgress& progress, bool keepsPoints = true);

}  // namespace atrapos
