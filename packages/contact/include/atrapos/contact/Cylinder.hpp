#pragma once

#include <Kokkos_Macros.hpp>
#include <string>

#include "atrapos/contact/Axis.hpp"
#include "atrapos/contact/Requirements.hpp"
#include "atrapos/taylor/Implicit.hpp"

namespace atrapos::contact {

/// Circular cylinder with any axis, touched from outside (s = 1) or, hollow, from inside (s = -1); paper (12)
/// with (Oy) replaced by the unit `axis`:
///
///     (h + s r) n - (I - axis axis^T)(x - center) = 0,   <n, n> - 1 = 0
///
/// (n has no axial part because h + s r is not 0). A point on the axis has no projection: NaN.
struct Cylinder {
  static constexpr int numUnknowns = 4;
  static constexpr bool symmetric = true;
  double center[3] = {0, 0, 0};  ///< any point of the axis
  double axis[3] = {0, 1, 0};    ///< unit vector
  double radius = 1;
  bool inside = false;  ///< the body is inside the cylinder

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* x, const T* y, T* g) const {
    T across[3];
    detail::splitAlong(center, axis, x, across);
    const T distance = y[0] + (inside ? -radius : radius);
    for (int i = 0; i < 3; ++i) g[i] = distance * y[1 + i] - across[i];
    g[3] = y[1] * y[1] + y[2] * y[2] + y[3] * y[3] - 1.0;
  }

  KOKKOS_INLINE_FUNCTION void start(const double* x, double* y) const {
    detail::splitAlong(center, axis, x, y + 1);
    const double distance = detail::norm(y + 1), sign = inside ? -1 : 1;
    y[0] = sign * (distance - radius);
    for (int i = 0; i < 3; ++i) y[1 + i] *= sign / distance;
  }

  void validate() const {
    detail::requireFinite("cylinder", "center", center);
    detail::requireUnit("cylinder", "axis", axis);
    detail::requirePositive("cylinder", "radius", radius);
  }

  std::string ambiguity(const double* x) const {
    double across[3];
    detail::splitAlong(center, axis, x, across);
    return detail::vanishes(detail::norm(across), x, center) ? "lies on the axis of the cylinder" : "";
  }
};

}  // namespace atrapos::contact
