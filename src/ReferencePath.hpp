#pragma once

#include <string>
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
  double length() const { return states_.empty() ? 0 : at_.back(); }

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
    /// Length of the path up to the last state that was on it.
    double reached() const { return reached_; }

   private:
    const ReferencePath& path_;
    double tolerance_;
    double reached_ = 0;
    path::State last_;
  };

 private:
  void append(const path::Vector& u, double lambda);
  double dot(const path::Vector& u, double lambda, const path::Vector& v, double mu) const;

  int samples_;
  double weight_ = 0;
  std::vector<path::State> states_;
  std::vector<double> at_;  ///< length of the chain up to each
};

}  // namespace atrapos
