#pragma once

#include <array>
#include <cmath>
#include <sstream>
#include <string>

namespace atrapos::test {

/// A roll as the `surfaces` of a deck: a NURBS surface of four quarters, exact. place(a, b, end): the point
/// whose place across the axis is (a, b) in radii, at its end 0 or 1; S_1 x S_2 points out of the roll where
/// a, b and the way from end 0 to 1 are right-handed.
template <class Place>
std::string nurbsRoll(const Place& place) {
  const double corner[9][2] = {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}, {1, 0}};
  std::ostringstream points, weights;
  points.precision(17);
  weights.precision(17);
  for (int i = 0; i < 9; ++i)
    for (const int end : {0, 1}) {
      const std::array<double, 3> x = place(corner[i][0], corner[i][1], end);
      const char* const comma = i == 0 && end == 0 ? "" : ", ";
      points << comma << "[" << x[0] << ", " << x[1] << ", " << x[2] << "]";
      weights << comma << (i % 2 == 0 ? 1.0 : std::sqrt(0.5));
    }
  return "{roll: {degree: [2, 1], points: [" + points.str() + "], weights: [" + weights.str() +
         "], knots_1: [0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4], knots_2: [0, 0, 1, 1]}}";
}

}  // namespace atrapos::test
