#pragma once

#include <Kokkos_Macros.hpp>
#include <cmath>

namespace atrapos::contact::detail {

/// x - center = along * axis + across with across normal to the unit axis; returns along.
template <class T>
KOKKOS_INLINE_FUNCTION T splitAlong(const double* center, const double* axis, const T* x, T* across) {
  for (int i = 0; i < 3; ++i) across[i] = x[i] - center[i];
  const T along = axis[0] * across[0] + axis[1] * across[1] + axis[2] * across[2];
  for (int i = 0; i < 3; ++i) across[i] -= axis[i] * along;
  return along;
}

KOKKOS_INLINE_FUNCTION double norm(const double* v) {
  return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

/// Whether a distance from an axis or a centre is zero up to the rounding of the place's coordinates.
inline bool vanishes(double distance, const double* x, const double* center) {
  double size = 0;
  for (int i = 0; i < 3; ++i) size += std::fabs(x[i]) + std::fabs(center[i]);
  return distance <= 1e-13 * size;
}

}  // namespace atrapos::contact::detail
