#pragma once

#include <vector>

#include "atrapos/linear/TangentSolver.hpp"
#include "atrapos/path/Problem.hpp"
#include "atrapos/path/Report.hpp"

namespace atrapos::bench {

/// What a path method claims to be the path, at equal distances along it.
class PathSamples final : public path::Observer {
 public:
  /// `spacing` in units of the path parameter.
  explicit PathSamples(double spacing) : spacing_(spacing) {}

  bool onStep(const path::StepReport& report, const path::Series& series) override;

  struct Sample {
    path::State state;
    path::PathTangent tangent;
  };
  const std::vector<Sample>& samples() const { return samples_; }

 private:
  double spacing_;
  std::vector<Sample> samples_;
};

/// Distance sqrt(w <dX, dX> + dlambda^2) of a sample from the path, in the plane normal to its own tangent:
/// Newton's method to rounding. Throws std::runtime_error where it does not converge.
double distanceToPath(path::Problem& problem, linear::TangentSolver& solver,
                      const PathSamples::Sample& sample, double weight);

/// The largest of all samples.
double worstDistance(path::Problem& problem, linear::TangentSolver& solver, const PathSamples& samples,
                     double weight);

}  // namespace atrapos::bench
