#pragma once

#include <vector>

#include "atrapos/path/Calls.hpp"

namespace atrapos::path {

/// An eigenvalue of the tangent next to zero, its vector and its rate along the path.
struct Mode {
  RCP<Vector> x;  ///< Euclidean norm 1
  double mu = 0;  ///< eigenvalue
  /// d mu / d(path length) = x . D^2R(X', (x, 0)) / speedOf(X'); not a number where it was not wanted.
  double rate = 0;
};

/// |X'| = sqrt(w u' . u' + lambda'^2): the length that rates are by, whatever the path parameter measures.
double speedOf(const PathTangent& t, double weight);

/// The eigenvalues of the factored, symmetric tangent at `state` that are nearest to zero: inverse iterations
/// on a block that starts with the vectors of `before`. `along` is X' there, of any length.
///
/// A rate costs two series of order 2, in which the loops over the Problem are most of a step's; `soon` wants
/// only those of eigenvalues that, going on as since `before`, vanish within four more such lengths.
enum class Rates { all, soon };
std::vector<Mode> nearestModes(Calls& calls, const State& state, const PathTangent& along, double weight,
                               const std::vector<Mode>& before, int count, Rates rates);

/// Where an eigenvalue may vanish.
struct ModeZero {
  double a = 0;   ///< on the step's series
  RCP<Vector> x;  ///< its vector, roughly
};

/// The eigenvalues followed at one place of a step.
struct ModeSample {
  double a = 0;
  double speed = 1;  ///< speedOf(X') there
  std::vector<Mode> modes;
};

/// What the eigenvalues followed say of a step.
struct ModeEvidence {
  std::vector<ModeZero> zeros;
  bool suspect = false;  ///< one comes near zero and turns back
};

/// Eigenvalues between neighbouring samples (ascending in a), paired by their vectors, each the cubic in
/// between with the rates at both, or less where a rate is not known.
ModeEvidence zerosOf(const std::vector<ModeSample>& samples);

}  // namespace atrapos::path
