#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace atrapos::fem {

using Vec3 = std::array<double, 3>;

inline Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

inline double dot(const Vec3& a, const Vec3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

inline double norm(const Vec3& a) { return std::sqrt(dot(a, a)); }

/// y += factor x
inline void add(double factor, const Vec3& x, Vec3& y) {
  for (int i = 0; i < 3; ++i) y[i] += factor * x[i];
}

/// to - from
inline Vec3 between(const Vec3& from, const Vec3& to) {
  Vec3 a = to;
  add(-1, from, a);
  return a;
}

inline Vec3 scaled(double factor, const Vec3& x) { return {factor * x[0], factor * x[1], factor * x[2]}; }

/// Vector n of a list, [vector][component].
inline Vec3 vectorAt(const std::vector<double>& values, int n) {
  const double* v = &values[3 * static_cast<std::size_t>(n)];
  return {v[0], v[1], v[2]};
}

}  // namespace atrapos::fem
