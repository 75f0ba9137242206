#pragma once

#include <stdexcept>
#include <string>

namespace atrapos::linear {

/// A linear solver could not do what was asked; what() is one line that says why. Thrown on all ranks.
class SolverError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The tangent is singular to working precision (a critical point was hit, or a rigid motion is free).
class SingularTangentError : public SolverError {
 public:
  SingularTangentError(const std::string& what, long long nullPivots)
      : SolverError(what), nullPivots_(nullPivots) {}

  /// Number of null pivots, i.e. the numerical rank deficiency; 0 where the solver does not count them.
  long long nullPivots() const { return nullPivots_; }

 private:
  long long nullPivots_;
};

}  // namespace atrapos::linear
