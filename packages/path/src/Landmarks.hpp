#pragma once

#include <array>
#include <optional>
#include <vector>

#include "atrapos/path/Series.hpp"

namespace atrapos::path {

/// Finds out that a path is closed: it passes a state where one of its steps began, in the same direction. A
/// solution curve through a state is one curve, so from there on it repeats itself.
///
/// Of states there are three numbers: the load and two sums over the unknowns with weights that look like
/// random numbers, the same on every distribution over ranks. Two states are taken for one where all three,
/// and the directions, agree; the chance that others do is that of the tolerance to the third power.
class Landmarks {
 public:
  explicit Landmarks(const Map& map);

  /// All that is known, for a path that goes on: finite numbers.
  std::vector<double> numbers() const;
  /// From these. Throws std::invalid_argument where they are none of numbers().
  void goOn(const std::vector<double>& numbers);

  /// Notes the start of an accepted step, and returns the number of the earlier step at whose start the
  /// path is again on this one; none where it is not.
  std::optional<int> pass(int step, const Series& series, double length);

 private:
  static constexpr std::size_t count = 3;
  using Place = std::array<double, count>;
  struct Mark {
    int step;
    Place place, direction;
    bool left;  ///< the path has been far from it since
  };

  bool isAt(const Mark& mark, const std::array<Rational, count>& path, double a) const;
  std::optional<int> meets(const std::array<Rational, count>& path, const Place& from, const Place& to,
                           double length) const;

  std::array<RCP<Vector>, count - 1> weights_;
  Place low_{}, high_{};  ///< of all ends of steps
  std::vector<Mark> marks_;
};

}  // namespace atrapos::path
