#pragma once

#include <Kokkos_Macros.hpp>
#include <cmath>

#include "atrapos/taylor/Implicit.hpp"

/// Rigid tools. A tool is one struct whose templated operator is proj(h, n, x) = 0, paper (10)-(13): the gap
/// h (a length, positive when free) and the unit normal n (from the tool to the body) of a material point
/// that is now at x. Unknowns y = (h, n_x, n_y, n_z); x and h in the user's unit of length.
///
///     static constexpr int numUnknowns;
///     static constexpr bool symmetric;   // n = grad h: the contact tangent is symmetric
///
///     // g = proj, numUnknowns entries
///     template <class T> void operator()(const T* x, const T* y, T* g) const;
///
///     // guess for Newton's method
///     void start(const double* x, double* y) const;
namespace atrapos::contact {

/// Plane through `point` with unit `normal` pointing to the free side; paper (10).
struct Plane {
  static constexpr int numUnknowns = 4;
  static constexpr bool symmetric = true;
  double point[3] = {0, 0, 0};
  double normal[3] = {0, 0, 1};

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* x, const T* y, T* g) const {
    g[0] = y[0] -
           (normal[0] * (x[0] - point[0]) + normal[1] * (x[1] - point[1]) + normal[2] * (x[2] - point[2]));
    for (int i = 0; i < 3; ++i) g[1 + i] = y[1 + i] - normal[i];
  }

  KOKKOS_INLINE_FUNCTION void start(const double* x, double* y) const {
    y[0] = 0;
    for (int i = 0; i < 3; ++i) {
      y[0] += normal[i] * (x[i] - point[i]);
      y[1 + i] = normal[i];
    }
  }
};

/// Circular cylinder with any axis, touched from outside; paper (12) with (Oy) replaced by the unit `axis`:
///
///     (h + r) n - (I - axis axis^T)(x - center) = 0,   <n, n> - 1 = 0
///
/// (n has no axial part because h + r > 0). A point on the axis has no projection: NaN.
struct Cylinder {
  static constexpr int numUnknowns = 4;
  static constexpr bool symmetric = true;
  double center[3] = {0, 0, 0};  ///< any point of the axis
  double axis[3] = {0, 1, 0};    ///< unit vector
  double radius = 1;

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* x, const T* y, T* g) const {
    const T dx = x[0] - center[0], dy = x[1] - center[1], dz = x[2] - center[2];
    const T along = axis[0] * dx + axis[1] * dy + axis[2] * dz;
    const T distance = y[0] + radius;
    g[0] = distance * y[1] - (dx - axis[0] * along);
    g[1] = distance * y[2] - (dy - axis[1] * along);
    g[2] = distance * y[3] - (dz - axis[2] * along);
    g[3] = y[1] * y[1] + y[2] * y[2] + y[3] * y[3] - 1.0;
  }

  KOKKOS_INLINE_FUNCTION void start(const double* x, double* y) const {
    double along = 0, length = 0;
    for (int i = 0; i < 3; ++i) along += axis[i] * (x[i] - center[i]);
    for (int i = 0; i < 3; ++i) {
      y[1 + i] = x[i] - center[i] - axis[i] * along;
      length += y[1 + i] * y[1 + i];
    }
    length = std::sqrt(length);
    y[0] = length - radius;
    for (int i = 0; i < 3; ++i) y[1 + i] /= length;
  }
};

}  // namespace atrapos::contact
