#pragma once

#include <vector>

#include "atrapos/path/Report.hpp"

namespace atrapos {

/// A path as a chain of close states, which says whether other runs of the same problem stay on it. Distances
/// and lengths are those of w <U, U> + lambda^2.
class ReferencePath {
 public:
  /// `samplesPerStep`: states kept of each step, its end included.
  explicit ReferencePath(int samplesPerStep) : samples_(samplesPerStep) {}

  /// The next step of the path.
  void append(const path::StepReport& report, const path::Series& series);

  /// The largest distance of a state of the path from its start.
  double extent() const;

  /// Goes along the path with another run.
  class Walker {
   public:
    /// `tolerance`: the distance that still counts as on the path.
    Walker(const ReferencePath& path, double tolerance) : path_(path), tolerance_(tolerance) {}

    enum class Place { on, behind, off };
    /// Where the next state of the run is, which must be close to the last one: on the path and about as far
    /// ahead as the run has gone; on it but before the last one by more than the tolerance; or not on it, a
    /// far part of the path included.
    Place go(const path::Vector& u, double lambda);
    /// Whether the last state is at the path's end.
    bool atEnd() const { return reached_ >= path_.at_.back() - 4 * tolerance_ && nearEnd(); }

   private:
    bool nearEnd() const;

    const ReferencePath& path_;
    double tolerance_;
    double reached_ = 0;        ///< length of the path up to the last state that was on it
    std::vector<double> last_;  ///< that state
  };

 private:
  using Point = std::vector<double>;  ///< sqrt(w) U and lambda

  Point point(const path::Vector& u, double lambda) const;
  void append(Point point);

  int samples_;
  double weight_ = 0;
  std::vector<Point> points_;
  std::vector<double> at_;  ///< length of the chain up to each
};

}  // namespace atrapos
