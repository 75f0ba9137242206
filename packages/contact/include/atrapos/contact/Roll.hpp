#pragma once

#include <Kokkos_Macros.hpp>
#include <Sacado_Fad_SFad.hpp>
#include <cmath>
#include <string>

#include "atrapos/contact/Axis.hpp"
#include "atrapos/contact/Requirements.hpp"
#include "atrapos/taylor/Implicit.hpp"

namespace atrapos::contact {

/// Surface of revolution about an axis, touched from outside: its radius is profile(z) at the place z along
/// the axis (z = 0 at `center`). The projection is that along the surface's normal: with the place of the
/// foot z = axis.(x - center - h n), the slope r' = dr/dz there and W = sqrt(1 + r'^2),
///
///     (h + r W)(n + axis r'/W) - (I - axis axis^T)(x - center) = 0,   <n, n> - 1 = 0
///
/// (derivation: docs/theory/contact.md; paper (37) measures h and n across the axis, see RadialRoll).
/// A point of the axis, or at a centre of curvature of a hollow profile, has no projection.
///
/// Profile: `template <class T> void operator()(const T& z, T& r, T& slope) const` and `void validate()
/// const`. r must be a series in z: no branch on z.
template <class Profile>
struct Roll {
  static constexpr int numUnknowns = 4;
  static constexpr bool symmetric = true;
  double center[3] = {0, 0, 0};
  double axis[3] = {0, 1, 0};  ///< unit vector
  Profile profile;

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* x, const T* y, T* g) const {
    using std::sqrt;
    T across[3], r, slope;
    const T along = detail::splitAlong(center, axis, x, across);
    const T tilt = axis[0] * y[1] + axis[1] * y[2] + axis[2] * y[3];
    const T foot = along - y[0] * tilt;
    profile(foot, r, slope);
    const T W = sqrt(slope * slope + 1.0);
    const T reach = y[0] + r * W, lean = slope / W;
    for (int i = 0; i < 3; ++i) g[i] = reach * (y[1 + i] + axis[i] * lean) - across[i];
    g[3] = y[1] * y[1] + y[2] * y[2] + y[3] * y[3] - 1.0;
  }

  /// Global search along the profile: the foot is no farther along the axis than the radial distance.
  KOKKOS_INLINE_FUNCTION void start(const double* x, double* y) const {
    double across[3], r, slope;
    const double along = detail::splitAlong(center, axis, x, across), distance = detail::norm(across);
    profile(along, r, slope);
    const double half = std::fabs(distance - r);
    double foot = along, least = half * half;
    constexpr int samples = 32;
    for (int i = -samples; i <= samples; ++i)
      approach(along + half * i / samples, along, distance, foot, least);
    double step = half / samples;
    for (int i = 0; i < 24; ++i) {  // far inside the range of Newton's method, which follows
      const double middle = foot;
      step *= 0.6;
      approach(middle - step, along, distance, foot, least);
      approach(middle + step, along, distance, foot, least);
    }
    profile(foot, r, slope);
    const double W = std::sqrt(1 + slope * slope);
    y[0] = (distance - r - slope * (along - foot)) / W;
    for (int i = 0; i < 3; ++i) y[1 + i] = (across[i] / distance - slope * axis[i]) / W;
  }

  void validate() const {
    detail::requireFinite("roll", "center", center);
    detail::requireUnit("roll", "axis", axis);
    profile.validate();
  }

  std::string ambiguity(const double* x) const {
    double across[3], y[4];
    const double along = detail::splitAlong(center, axis, x, across);
    if (detail::vanishes(detail::norm(across), x, center)) return "lies on the axis of the roll";
    start(x, y);
    using Fad = Sacado::Fad::SFad<double, 1>;
    const Fad foot(1, 0, along - y[0] * (axis[0] * y[1] + axis[1] * y[2] + axis[2] * y[3]));
    Fad r, slope;
    profile(foot, r, slope);
    if (!(r.val() > 0)) return "lies beyond the end of the roll, where its radius vanishes";
    const double W2 = 1 + slope.val() * slope.val();
    // The distance has a minimum at the foot while 1 - h r''/W^3 > 0.
    if (1 - y[0] * slope.dx(0) / (W2 * std::sqrt(W2)) < 1e-8)
      return "lies at or beyond a centre of curvature of the roll's profile";
    return {};
  }

 private:
  KOKKOS_INLINE_FUNCTION void approach(double candidate, double along, double distance, double& foot,
                                       double& least) const {
    double r, slope;
    profile(candidate, r, slope);
    const double square = (distance - r) * (distance - r) + (along - candidate) * (along - candidate);
    if (square < least) {
      least = square;
      foot = candidate;
    }
  }
};

/// The same surface with the gap measured across the axis and the normal taken there, as paper (37) does:
///
///     (h + r(z)) n - (I - axis axis^T)(x - center) = 0,   <n, n> - 1 = 0,   z = axis.(x - center)
///
/// It has the zero gap of Roll, but its n leans by the angle of the slope and is not the gradient of h: the
/// tangent is unsymmetric. To compare with the paper; Roll is the tool to use.
template <class Profile>
struct RadialRoll {
  static constexpr int numUnknowns = 4;
  static constexpr bool symmetric = false;
  double center[3] = {0, 0, 0};
  double axis[3] = {0, 1, 0};  ///< unit vector
  Profile profile;

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* x, const T* y, T* g) const {
    T across[3], r, slope;
    const T along = detail::splitAlong(center, axis, x, across);
    profile(along, r, slope);
    const T reach = y[0] + r;
    for (int i = 0; i < 3; ++i) g[i] = reach * y[1 + i] - across[i];
    g[3] = y[1] * y[1] + y[2] * y[2] + y[3] * y[3] - 1.0;
  }

  KOKKOS_INLINE_FUNCTION void start(const double* x, double* y) const {
    double r, slope;
    const double along = detail::splitAlong(center, axis, x, y + 1), distance = detail::norm(y + 1);
    profile(along, r, slope);
    y[0] = distance - r;
    for (int i = 0; i < 3; ++i) y[1 + i] /= distance;
  }

  void validate() const {
    Roll<Profile>{{center[0], center[1], center[2]}, {axis[0], axis[1], axis[2]}, profile}.validate();
  }

  std::string ambiguity(const double* x) const {
    double across[3];
    detail::splitAlong(center, axis, x, across);
    return detail::vanishes(detail::norm(across), x, center) ? "lies on the axis of the roll" : "";
  }
};

}  // namespace atrapos::contact
