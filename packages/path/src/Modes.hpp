#pragma once

#include <vector>

#include "atrapos/path/Calls.hpp"

namespace atrapos::path {

/// An eigenvalue of the tangent next to zero, its vector and its rate along the path.
struct Mode {
  RCP<Vector> x;    ///< Euclidean norm 1
  double mu = 0;    ///< eigenvalue
  double rate = 0;  ///< d mu / d(path length) = x . D^2R(X', (x, 0)) / |X'|
};

/// The eigenvalues of the factored, symmetric tangent at `state` that are nearest to zero: inverse iterations
/// on a block that starts with the vectors of `before`. `along` is X' there, of any length.
std::vector<Mode> nearestModes(Calls& calls, const State& state, const PathTangent& along, double weight,
                               const std::vector<Mode>& before, int count);

/// Where an eigenvalue may vanish.
struct ModeZero {
  double a = 0;   ///< on the step's series
  RCP<Vector> x;  ///< its vector, roughly
};

/// The eigenvalues followed at one place of a step.
struct ModeSample {
  double a = 0;
  double speed = 1;  ///< |X'| there
  std::vector<Mode> modes;
};

/// What the eigenvalues followed say of a step.
struct ModeEvidence {
  std::vector<ModeZero> zeros;
  bool suspect = false;  ///< one comes near zero and turns back
};

/// Eigenvalues between neighbouring samples (ascending in a), paired by their vectors, each the cubic in
/// between with the rates at both.
ModeEvidence zerosOf(const std::vector<ModeSample>& samples);

}  // namespace atrapos::path
