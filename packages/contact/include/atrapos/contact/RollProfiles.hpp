#pragma once

#include <Kokkos_Macros.hpp>
#include <cmath>
#include <vector>

#include "atrapos/contact/Requirements.hpp"
#include "atrapos/contact/Roll.hpp"

/// Profiles r(z) of rolls: radius and slope dr/dz at the place z along the axis. All are analytic in z, the
/// condition for series that cross the place where they change (docs/theory/contact.md).
namespace atrapos::contact {

/// Cylinder that turns into a cone at z = flat; paper (37) in consistent units:
///
///     r = radius - (tan p / 2) t (1 + tanh(t/width)),   t = z - flat
///
/// p > 0 narrows (a convex roll, paper 4.2), p < 0 widens (the sign printed in (37)). The paper's epsilon =
/// 23 is 1/width, per mm. The vertex differs from the sharp one by less than 0.14 width tan p.
struct TaperedProfile {
  double radius = 1;
  double flat = 1;        ///< l1, where the cone begins
  double angle = 0.1;     ///< p, radians
  double width = 0.1;     ///< of the smoothed vertex, a length
  bool bothEnds = false;  ///< the same cone at z = -flat

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T& z, T& r, T& slope) const {
    r = T(radius);
    slope = T(0.0);
    addCone(z, 1, r, slope);
    if (bothEnds) addCone(z, -1, r, slope);
  }

  void validate() const {
    detail::requirePositive("tapered roll", "radius", radius);
    detail::requireFinite("tapered roll", "flat length", flat);
    if (bothEnds && flat < 0)
      detail::refuse("tapered roll", "flat length must be >= 0 where both ends taper");
    detail::requireBetween("tapered roll", "angle", angle, -std::acos(0.0), std::acos(0.0));
    detail::requirePositive("tapered roll", "smoothing width", width);
  }

 private:
  template <class T>
  KOKKOS_INLINE_FUNCTION void addCone(const T& z, double end, T& r, T& slope) const {
    using std::tanh;
    const double half = std::tan(angle) / 2;
    const T t = end * z - flat;
    const T s = tanh(t / width);
    r -= half * (t * (s + 1.0));
    slope -= (end * half) * (s + 1.0 + t * (1.0 - s * s) / width);
  }
};
using TaperedRoll = Roll<TaperedProfile>;

/// r = sum of coefficient[i] z^i: a crown given by a formula.
struct PolynomialProfile {
  static constexpr int maxDegree = 8;
  int degree = 0;
  double coefficient[maxDegree + 1] = {1};  ///< of z^i, unit length^(1-i)

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T& z, T& r, T& slope) const {
    r = T(coefficient[degree]);
    slope = T(0.0);
    for (int i = degree - 1; i >= 0; --i) {
      slope = slope * z + r;
      r = r * z + coefficient[i];
    }
  }

  void validate() const {
    if (degree < 0 || degree > maxDegree)
      detail::refuse("crowned roll",
                     "needs 1 to 9 polynomial coefficients, got " + std::to_string(degree + 1));
    for (int i = 0; i <= degree; ++i)
      detail::requireFinite("crowned roll", "polynomial coefficient", coefficient[i]);
    detail::requirePositive("crowned roll", "radius at the center", coefficient[0]);
  }

  /// Throws std::invalid_argument for none or more than 9 coefficients.
  static PolynomialProfile of(const std::vector<double>& coefficients) {
    PolynomialProfile profile;
    profile.degree = static_cast<int>(coefficients.size()) - 1;
    for (int i = 0; i <= profile.degree && i <= maxDegree; ++i) profile.coefficient[i] = coefficients[i];
    profile.validate();
    return profile;
  }
};
using CrownedRoll = Roll<PolynomialProfile>;

/// r through the points of a table, analytic between and at them:
///
///     r = a + b t + sum_i c_i (sqrt((t - t_i)^2 + e^2))^3,   sum c_i = sum c_i t_i = 0,  t = (z - z_m)/l
///
/// with e the smallest distance of two entries. For e -> 0 it is the natural cubic spline, whose kernel
/// |t - t_i|^3 has no series across t_i; beyond the table it continues with a slope that becomes constant.
struct TableProfile {
  static constexpr int maxEntries = 32;
  int entries = 0;
  double middle = 0, half = 1;  ///< z_m, l
  double smoothing = 1;         ///< e, of t
  double constant = 1, linear = 0;
  double place[maxEntries] = {}, factor[maxEntries] = {};  ///< t_i, c_i

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T& z, T& r, T& slope) const {
    using std::sqrt;
    const T t = (z - middle) / half;
    r = linear * t + constant;
    slope = T(linear / half);
    for (int i = 0; i < entries; ++i) {
      const T d = t - place[i];
      const T square = d * d + smoothing * smoothing;
      const T root = sqrt(square);
      r += factor[i] * (square * root);
      slope += (3 * factor[i] / half) * (d * root);
    }
  }

  void validate() const {
    if (entries < 2) detail::refuse("crowned roll", "a table needs at least 2 entries");
  }

  /// Interpolates radius[i] > 0 at place[i], which ascend; 2 to 32 entries. Throws std::invalid_argument.
  static TableProfile through(const std::vector<double>& places, const std::vector<double>& radii);
};
using TabulatedRoll = Roll<TableProfile>;

}  // namespace atrapos::contact
