#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "atrapos/path/Series.hpp"

namespace atrapos::path {

/// End of the path where a linear functional of the unknowns, weights . U, takes a value.
struct StopFunctional {
  std::string name;  ///< for reports, e.g. "tip displacement"
  RCP<const Vector> weights;
  double value = 0;
};

/// Where a path ends, whichever comes first along it. The number of steps is bounded by Options::maxSteps.
struct Stops {
  std::vector<double> loadFactors;
  std::vector<StopFunctional> functionals;
  /// Length of the path from its start: the sum of the steps' lengths in a.
  double pathLength = std::numeric_limits<double>::infinity();
  /// The path ends with the step on which it passes its n-th limit point of the load, or its n-th bifurcation
  /// point (a multiple one counts once); 0: it goes on.
  int limitPoints = 0, bifurcations = 0;

  /// Throws std::invalid_argument, one line, on a value that is not a number or missing weights.
  void validate() const;

  /// Whether one of these is the stop that StopHit::text names.
  bool have(const std::string& text) const;

  /// Why a path ends that has passed so many of these points, e.g. "limit point 2 passed"; empty: it goes on.
  std::string passed(int limits, int bifurcationPoints) const;
};

/// A stop inside a step.
struct StopHit {
  enum class Kind { loadFactor, functional, pathLength };
  double a = 0;  ///< where, on the step's series
  Kind kind = Kind::loadFactor;
  int index = 0;     ///< into the list of its kind
  std::string text;  ///< e.g. "load factor 1.5 reached"
};

/// The first stop with a in (0, end], each found as a root of its polynomial. `atStart`: the series starts
/// the path; a stop that the start itself satisfies is then passed over until the path comes back to its
/// value.
std::optional<StopHit> firstStop(const Stops& stops, const Series& series, double pathLengthSoFar, double end,
                                 bool atStart);

}  // namespace atrapos::path
