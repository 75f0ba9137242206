#pragma once

#include "atrapos/path/PathFollower.hpp"
#include "commands/PathCase.hpp"
#include "output/Recorder.hpp"

namespace atrapos {

/// A path without branches as the branch of a diagram that is under way (path::BranchProgress::current).
class OnePath final : public path::Observer {
 public:
  /// `keepsPoints`: its bifurcation points become those of the diagram.
  OnePath(PathCase& pathCase, Recorder& recorder, path::BranchProgress& progress, bool keepsPoints)
      : case_(pathCase), recorder_(recorder), progress_(progress), keepsPoints_(keepsPoints) {}

  /// Follows it from where it stands; where the case has become another one on a step, again from the step's
  /// start. The branch has the outcome then.
  template <class Follower>
  void follow(Follower& follower) {
    path::Outcome total;
    do {
      changed_ = false;
      const path::Start from = *progress_.path;
      const path::Outcome part = follower.runFrom(from, *this);
      total = total.final.u ? sum(total, part) : part;
    } while (changed_);
    progress_.diagram.branches[progress_.current].outcome = total;
  }

  void onSearch(int found, int wanted) override { recorder_.onSearch(progress_.current, found, wanted); }
  bool onStep(const path::StepReport& report, const path::Series& series) override;

 private:
  /// The costs of both; all else is that of the last part.
  static path::Outcome sum(const path::Outcome& first, path::Outcome last);

  PathCase& case_;
  Recorder& recorder_;
  path::BranchProgress& progress_;
  bool keepsPoints_;
  bool changed_ = false;
};

/// The same by the deck's method with the settings of the case: from progress.path on.
void followOne(PathCase& pathCase, path::Problem& problem, linear::TangentSolver& solver, Recorder& recorder,
               path::BranchProgress& progress, bool keepsPoints = true);

}  // namespace atrapos
