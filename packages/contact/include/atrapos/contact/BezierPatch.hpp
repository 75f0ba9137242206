#pragma once

#include <array>
#include <vector>

namespace atrapos::contact {

/// A rational Bezier patch of degree (p, q): control points [i][j], i = 0..p, j = 0..q, in user's units of
/// length, and their weights.
struct BezierPatch {
  std::array<int, 2> degree{1, 1};
  std::vector<std::array<double, 3>> points;
  std::vector<double> weights;  ///< empty: all 1

  /// Throws std::invalid_argument for a degree outside 1..20, a wrong number of points, weights <= 0.
  void validate() const;

  /// Coefficients of t1^i t2^j over t in [-1, 1]^2 for degrees at least the patch's own, [i][j][4]:
  /// coordinates times weight, weight.
  std::vector<double> coefficients(std::array<int, 2> degrees) const;
};

/// A B-spline or NURBS surface: control points [i][j], i < count[0], j < count[1]. Knots count + degree + 1
/// in each direction, ascending, of any multiplicity up to the degree inside and degree + 1 at the ends; knot
/// vectors need not be clamped (the surface lies over [knot p, knot count]).
struct NurbsSurface {
  std::array<int, 2> degree{1, 1};
  std::array<int, 2> count{2, 2};
  std::array<std::vector<double>, 2> knots;
  std::vector<std::array<double, 3>> points;
  std::vector<double> weights;  ///< empty: all 1

  /// Throws std::invalid_argument, one line, for what makes no surface.
  void validate() const;

  /// The same surface as one Bezier patch for every pair of knot spans that are not empty; validates.
  std::vector<BezierPatch> patches() const;
};

}  // namespace atrapos::contact
