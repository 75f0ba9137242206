#pragma once

#include <Kokkos_Macros.hpp>
#include <cmath>
#include <string>

#include "atrapos/contact/Axis.hpp"
#include "atrapos/contact/Requirements.hpp"
#include "atrapos/taylor/Implicit.hpp"

namespace atrapos::contact {

/// Circular cone, one nappe that opens from `apex` along the unit `axis`, touched from outside (s = 1) or, a
/// funnel, from inside (s = -1). With z the place along the axis and theta the half angle:
///
///     (s h + z sin theta)(s n + axis sin theta) - cos^2 theta (I - axis axis^T)(x - apex) = 0
///     <n, n> - 1 = 0
///
/// (derivation: docs/theory/contact.md). A point on the axis has no projection: NaN. Behind the apex, where
/// its tip would be nearest, the law continues the nappe; `ambiguity` says so.
struct Cone {
  static constexpr int numUnknowns = 4;
  static constexpr bool symmetric = true;
  double apex[3] = {0, 0, 0};
  double axis[3] = {0, 1, 0};  ///< unit vector, from the apex into the cone
  double halfAngle = 0.5;      ///< theta in (0, pi/2), radians
  bool inside = false;         ///< the body is inside the cone

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* x, const T* y, T* g) const {
    const double s = inside ? -1 : 1, sine = std::sin(halfAngle), cosine = std::cos(halfAngle);
    T across[3];
    const T along = detail::splitAlong(apex, axis, x, across);
    const T reach = s * y[0] + sine * along;
    for (int i = 0; i < 3; ++i)
      g[i] = reach * (s * y[1 + i] + sine * axis[i]) - (cosine * cosine) * across[i];
    g[3] = y[1] * y[1] + y[2] * y[2] + y[3] * y[3] - 1.0;
  }

  KOKKOS_INLINE_FUNCTION void start(const double* x, double* y) const {
    const double s = inside ? -1 : 1, sine = std::sin(halfAngle), cosine = std::cos(halfAngle);
    const double along = detail::splitAlong(apex, axis, x, y + 1);
    const double distance = detail::norm(y + 1);
    y[0] = s * (cosine * distance - sine * along);
    for (int i = 0; i < 3; ++i) y[1 + i] = s * (cosine * y[1 + i] / distance - sine * axis[i]);
  }

  void validate() const {
    detail::requireFinite("cone", "apex", apex);
    detail::requireUnit("cone", "axis", axis);
    detail::requireBetween("cone", "half angle", halfAngle, 0, std::acos(0.0));
  }

  std::string ambiguity(const double* x) const {
    double across[3];
    const double along = detail::splitAlong(apex, axis, x, across), distance = detail::norm(across);
    if (along * std::cos(halfAngle) + distance * std::sin(halfAngle) <= 0)
      return "lies behind the apex of the cone";
    return detail::vanishes(distance, x, apex) ? "lies on the axis of the cone" : "";
  }
};

}  // namespace atrapos::contact
