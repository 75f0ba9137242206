#pragma once

#include <Kokkos_Macros.hpp>
#include <cmath>
#include <string>

#include "atrapos/contact/Axis.hpp"
#include "atrapos/contact/Requirements.hpp"
#include "atrapos/taylor/Implicit.hpp"

namespace atrapos::contact {

/// Torus: a tube of radius r about the circle of radius R around `center` normal to the unit `axis`, touched
/// from outside the tube (s = 1) or from inside (s = -1). With d = (I - axis axis^T)(x - center):
///
///     (h + s r) n - (x - center - R d/|d|) = 0,   <n, n> - 1 = 0
///
/// Points of the axis (nearest to a whole circle) and of the tube's centre line have no projection: NaN.
struct Torus {
  static constexpr int numUnknowns = 4;
  static constexpr bool symmetric = true;
  double center[3] = {0, 0, 0};
  double axis[3] = {0, 1, 0};  ///< unit vector
  double radius = 2;           ///< R, of the tube's centre line
  double tubeRadius = 1;       ///< r < R
  bool inside = false;         ///< the body is inside the tube

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* x, const T* y, T* g) const {
    using std::sqrt;
    T across[3];
    const T along = detail::splitAlong(center, axis, x, across);
    const T distance = sqrt(across[0] * across[0] + across[1] * across[1] + across[2] * across[2]);
    const T part = 1.0 - radius / distance;
    const T reach = y[0] + (inside ? -tubeRadius : tubeRadius);
    for (int i = 0; i < 3; ++i) g[i] = reach * y[1 + i] - (part * across[i] + axis[i] * along);
    g[3] = y[1] * y[1] + y[2] * y[2] + y[3] * y[3] - 1.0;
  }

  KOKKOS_INLINE_FUNCTION void start(const double* x, double* y) const {
    const double along = detail::splitAlong(center, axis, x, y + 1);
    const double part = 1 - radius / detail::norm(y + 1), sign = inside ? -1 : 1;
    for (int i = 0; i < 3; ++i) y[1 + i] = part * y[1 + i] + axis[i] * along;
    const double reach = detail::norm(y + 1);
    y[0] = sign * (reach - tubeRadius);
    for (int i = 0; i < 3; ++i) y[1 + i] *= sign / reach;
  }

  void validate() const {
    detail::requireFinite("torus", "center", center);
    detail::requireUnit("torus", "axis", axis);
    detail::requirePositive("torus", "tube radius", tubeRadius);
    if (!(radius > tubeRadius) || !std::isfinite(radius))
      detail::refuse("torus", "radius must be above the tube radius " + detail::shown(tubeRadius) + ", got " +
                                  detail::shown(radius));
  }

  std::string ambiguity(const double* x) const {
    double across[3];
    const double along = detail::splitAlong(center, axis, x, across), distance = detail::norm(across);
    if (detail::vanishes(distance, x, center)) return "lies on the axis of the torus";
    if (detail::vanishes(std::hypot(distance - radius, along), x, center))
      return "lies on the centre line of the torus' tube";
    return {};
  }
};

}  // namespace atrapos::contact
