#pragma once

#include <Kokkos_Macros.hpp>
#include <string>

#include "atrapos/contact/Axis.hpp"
#include "atrapos/contact/Requirements.hpp"
#include "atrapos/taylor/Implicit.hpp"

namespace atrapos::contact {

/// Sphere touched from outside (s = 1) or, hollow, from inside (s = -1); paper (11):
///
///     (h + s r) n - (x - center) = 0,   <n, n> - 1 = 0
///
/// The centre has no projection: NaN.
struct Sphere {
  static constexpr int numUnknowns = 4;
  static constexpr bool symmetric = true;
  double center[3] = {0, 0, 0};
  double radius = 1;
  bool inside = false;  ///< the body is inside the sphere

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* x, const T* y, T* g) const {
    const T distance = y[0] + signedRadius();
    for (int i = 0; i < 3; ++i) g[i] = distance * y[1 + i] - (x[i] - center[i]);
    g[3] = y[1] * y[1] + y[2] * y[2] + y[3] * y[3] - 1.0;
  }

  KOKKOS_INLINE_FUNCTION void start(const double* x, double* y) const {
    for (int i = 0; i < 3; ++i) y[1 + i] = x[i] - center[i];
    const double distance = detail::norm(y + 1), sign = inside ? -1 : 1;
    y[0] = sign * (distance - radius);
    for (int i = 0; i < 3; ++i) y[1 + i] *= sign / distance;
  }

  void validate() const {
    detail::requireFinite("sphere", "center", center);
    detail::requirePositive("sphere", "radius", radius);
  }

  std::string ambiguity(const double* x) const {
    const double d[3] = {x[0] - center[0], x[1] - center[1], x[2] - center[2]};
    return detail::vanishes(detail::norm(d), x, center) ? "lies at the centre of the sphere" : "";
  }

 private:
  KOKKOS_INLINE_FUNCTION double signedRadius() const { return inside ? -radius : radius; }
};

}  // namespace atrapos::contact
