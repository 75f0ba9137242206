#pragma once

#include "EndTangent.hpp"
#include "PathUnderWay.hpp"
#include "Stability.hpp"

namespace atrapos::path {

/// Eigenvalues of the tangent at both ends of steps, and what follows for the steps.
class StepStability {
 public:
  StepStability(PathUnderWay& path, const Start& start);

  /// What the tangent at the position, which the solver's factorization belongs to, tells; `along` is X'
  /// there, of any length. Without lambda1.
  EndTangent tangentHere(const PathTangent& along, double weight);

  /// The next step starts here.
  void begin(EndTangent tangent) { start_ = std::move(tangent); }
  /// At the start of the step under way, or pending.
  const EndTangent& start() const { return start_; }
  /// Start::eigenvalues and Start::expectedNegative of a path that goes on behind that step.
  void tell(Start& next) const;

  /// Bifurcation and Hopf points inside the pending step with this end. The solver's factorization is another
  /// one afterwards.
  void explain(StepReport& report, const EndTangent& end, Observer& observer);

 private:
  void count(EndTangent& tangent);
  EigenProblem problem() const {
    return path_.options.hopfEigenvalues > 0 ? EigenProblem::ofRates : EigenProblem::ofTangent;
  }
  std::vector<Mode> modes(const PathTangent& along, double weight) const;
  void locateBifurcations(StepReport& report, const EndTangent& end, Observer& observer);
  void locateHopfPoints(StepReport& report, const EndTangent& end);

  PathUnderWay& path_;
  EndTangent start_;
  int counted_ = 0;   ///< eigenvalues with negative real part when they were counted last
  int expected_ = 0;  ///< counted_ before that
};

}  // namespace atrapos::path
