#pragma once

#include <string>
#include <vector>

#include "atrapos/path/Problem.hpp"

namespace atrapos::path {

class Series;

/// Where, on a series, the function that the series continues stops being the Problem's.
struct Break {
  double a = 0;
  int index = 0;  ///< for Problem::afterEvent; not below Problem::eventCount()
};

/// What path following asks of a Problem that is analytic piece by piece, where the pieces meet continuously
/// but not analytically: a contact point that goes from one patch of a surface to the next
/// (docs/theory/path.md, Pieces).
///
/// At a state every quantity is that of the piece that it lies on; a series continues those of its start. The
/// borders cost nothing until a step fails for them: it then ends at a border, and the next one begins on the
/// other side.
class Pieces {
 public:
  virtual ~Pieces() = default;

  /// R(state) by the pieces of the series under way, wherever the state lies.
  virtual ResidualNorm residualOfSeries(const State& state, Vector& r) = 0;

  /// Whether event functions of the series under way are wrong at a state on it, as it lies on another piece:
  /// one of `events` (those that fall to zero there) has no zero, or another one is below zero.
  virtual bool eventsAstray(const State& state, const std::vector<int>& events) const = 0;

  /// Borders that the series comes over on (0, end], ascending in a.
  virtual std::vector<Break> breaks(const Series& series, double end) const = 0;

  /// Whether the state, a little further along the series under way, lies on the piece that the series
  /// continues, as far as the point of this break is concerned.
  virtual bool continues(const State& state, int index) const = 0;

  /// What happens at the break, for a message: "contact point 3 of 40 ...".
  virtual std::string text(int index) const = 0;
};

}  // namespace atrapos::path
