#pragma once

#include <array>
#include <optional>
#include <vector>

#include "atrapos/path/Report.hpp"
#include "atrapos/path/Series.hpp"

namespace atrapos::path {

/// Finds out that a path is closed: it passes a state where one of its steps began, in the same direction. A
/// solution curve through a state is one curve, so from there on it repeats itself.
///
/// Two states are taken for one where their places (Landmark) and their directions agree; the chance that
/// others do is that of the tolerance to the third power.
class Landmarks {
 public:
  /// `known`: of a path that goes on.
  Landmarks(const Map& map, const Trail& known);

  const Trail& trail() const { return trail_; }

  /// Notes an accepted step, and returns the number of the earlier step at whose start the path is again on
  /// this one; none where it is not.
  std::optional<int> pass(int step, const Series& series, double length);

 private:
  using Place = Landmark::Place;
  using Curve = std::array<Rational, std::tuple_size_v<Place>>;

  void widen(const Landmark& mark);
  void add(const Landmark& mark);
  std::optional<int> meets(const Curve& path, const Landmark& here, double length) const;
  bool isAt(const Landmark& mark, const Curve& path, double a) const;
  Place scale() const;

  std::array<RCP<Vector>, std::tuple_size_v<Place> - 1> weights_;
  Place low_{}, high_{};  ///< of all ends of steps
  std::vector<Landmark> marks_;
  Trail trail_;  ///< the same
  std::vector<char> left_;  ///< [mark] the path has been far from it since
};

}  // namespace atrapos::path
