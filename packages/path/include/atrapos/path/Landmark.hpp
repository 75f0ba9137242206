#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <utility>
#include <vector>

namespace atrapos::path {

/// A step in a few numbers, by which a path is known again that comes back: the load, and two sums over the
/// unknowns with weights that look like random numbers, the same on every distribution over ranks.
struct Landmark {
  using Place = std::array<double, 3>;
  int step = 0;
  Place place{}, direction{};  ///< at the step's start, and their derivatives by a
  Place end{};                 ///< at its end
};

/// The landmarks of all steps of a path so far. Each step's report has such a trail, which shares all but its
/// last landmark with that of the step before: n reports hold n landmarks, not n^2/2.
class Trail {
 public:
  bool empty() const { return !last_; }

  /// Not of an empty one.
  const Landmark& last() const { return last_->mark; }

  void add(const Landmark& mark) { last_ = std::make_shared<Link>(mark, std::move(last_)); }

  /// In the order of the path.
  std::vector<Landmark> all() const {
    std::vector<Landmark> marks;
    for (const Link* link = last_.get(); link; link = link->before.get()) marks.push_back(link->mark);
    std::reverse(marks.begin(), marks.end());
    return marks;
  }

 private:
  struct Link {
    Landmark mark;
    std::shared_ptr<Link> before;

    Link(const Landmark& m, std::shared_ptr<Link> b) : mark(m), before(std::move(b)) {}
    Link(const Link&) = delete;
    Link& operator=(const Link&) = delete;
    /// One after another: if each destroyed the one before, calls would be as deep as the path has steps.
    ~Link() {
      while (before && before.use_count() == 1) {
        std::shared_ptr<Link> next = std::move(before->before);
        before = std::move(next);
      }
    }
  };

  std::shared_ptr<Link> last_;
};

}  // namespace atrapos::path
