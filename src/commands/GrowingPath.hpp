#pragma once

#include <optional>

#include "atrapos/path/Report.hpp"
#include "commands/PathCase.hpp"

namespace atrapos {

/// The costs of both outcomes; all else is that of the last one.
path::Outcome sumOf(const path::Outcome& first, path::Outcome last);

/// Follows a path whose case may become another one on the way (PathCase::changedOn): the step that led there
/// is not shown to the observer, and the path goes on from its start.
class GrowingPath final : public path::Observer {
 public:
  GrowingPath(PathCase& pathCase, path::Observer& observer) : case_(pathCase), observer_(observer) {}

  template <class Follower>
  path::Outcome follow(Follower& follower, path::Start from) {
    path::Outcome total;
    do {
      changed_ = false;
      const path::Outcome part = follower.runFrom(from, *this);
      total = sumOf(total, part);
      if (next_) from = *next_;
    } while (changed_);
    return total;
  }

  void onSearch(int found, int wanted) override { observer_.onSearch(found, wanted); }
  bool onStep(const path::StepReport& report, const path::Series& series) override;

 private:
  PathCase& case_;
  path::Observer& observer_;
  std::optional<path::Start> next_;  ///< behind the last step that was shown
  bool changed_ = false;
};

}  // namespace atrapos
