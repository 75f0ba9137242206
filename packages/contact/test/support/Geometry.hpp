#pragma once

#include <array>
#include <cmath>
#include <random>

#include "atrapos/contact/Tools.hpp"

/// Vectors in space and random tools, the same at every run.
namespace atrapos::contact::test {

using Vector3 = std::array<double, 3>;

inline double dot(const Vector3& a, const Vector3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Vector3 sum(const Vector3& a, double c, const Vector3& b) {
  return {a[0] + c * b[0], a[1] + c * b[1], a[2] + c * b[2]};
}
inline Vector3 scaled(double c, const Vector3& a) { return {c * a[0], c * a[1], c * a[2]}; }
inline Vector3 cross(const Vector3& a, const Vector3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline double length(const Vector3& a) { return std::sqrt(dot(a, a)); }
inline Vector3 unit(const Vector3& a) { return scaled(1 / length(a), a); }
inline Vector3 vector(const double (&a)[3]) { return {a[0], a[1], a[2]}; }

/// Two unit vectors normal to the unit vector a and to each other.
inline std::array<Vector3, 2> normalsTo(const Vector3& a) {
  const Vector3 b = unit(cross(a, std::abs(a[0]) < 0.5 ? Vector3{1, 0, 0} : Vector3{0, 1, 0}));
  return {b, cross(a, b)};
}

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double between(double least, double most) {
    return least + (most - least) * (engine_() / 4294967296.0);  // the engine's numbers are standardised
  }
  Vector3 inCube(double half) { return {between(-half, half), between(-half, half), between(-half, half)}; }
  Vector3 direction() {
    for (;;) {
      const Vector3 v = inCube(1);
      if (length(v) > 0.1 && length(v) < 1) return unit(v);
    }
  }
  Plane plane() {
    const Vector3 p = inCube(3), n = direction();
    return {{p[0], p[1], p[2]}, {n[0], n[1], n[2]}};
  }
  Cylinder cylinder() {
    const Vector3 c = inCube(3), a = direction();
    return {{c[0], c[1], c[2]}, {a[0], a[1], a[2]}, between(0.5, 5)};
  }

 private:
  std::mt19937 engine_;
};

/// A point at a given gap over a random place of the surface.
inline Vector3 pointAt(const Plane& plane, double gap, Random& random) {
  const auto [s, t] = normalsTo(vector(plane.normal));
  const Vector3 p = sum(vector(plane.point), gap, vector(plane.normal));
  return sum(sum(p, random.between(-4, 4), s), random.between(-4, 4), t);
}
inline Vector3 pointAt(const Cylinder& cylinder, double gap, Random& random) {
  const auto [s, t] = normalsTo(vector(cylinder.axis));
  const double angle = random.between(0, 6.28);
  const Vector3 p = sum(vector(cylinder.center), random.between(-4, 4), vector(cylinder.axis));
  return sum(sum(p, (cylinder.radius + gap) * std::cos(angle), s), (cylinder.radius + gap) * std::sin(angle),
             t);
}

/// The surface by two parameters.
inline Vector3 surfacePoint(const Plane& plane, double u, double v) {
  const auto [s, t] = normalsTo(vector(plane.normal));
  return sum(sum(vector(plane.point), u, s), v, t);
}
inline Vector3 surfacePoint(const Cylinder& cylinder, double u, double v) {
  const auto [s, t] = normalsTo(vector(cylinder.axis));
  const Vector3 p = sum(vector(cylinder.center), u, vector(cylinder.axis));
  return sum(sum(p, cylinder.radius * std::cos(v), s), cylinder.radius * std::sin(v), t);
}

/// Projection by the library: gap and normal. NaN where there is none.
template <class Tool>
std::array<double, 4> project(const Tool& tool, const Vector3& x) {
  double y[4];
  taylor::solveImplicit<3, 4>(tool, x.data(), y);
  return {y[0], y[1], y[2], y[3]};
}

/// A tool as a law: out = (h, n).
template <class Tool>
struct Projection {
  static constexpr int numInputs = 3, numOutputs = 4, numData = 0;
  Tool tool;
  template <class T>
  void operator()(const T* x, const taylor::Passive<T>*, T* y) const {
    for (int i = 0; i < 4; ++i) y[i] = T(0.0);
    taylor::solveImplicit<3, 4>(tool, x, y);
  }
};

/// The projection in closed form, for any scalar with sqrt.
template <class T>
void closedForm(const Plane& plane, const T* x, T* y) {
  y[0] = plane.normal[0] * (x[0] - plane.point[0]) + plane.normal[1] * (x[1] - plane.point[1]) +
         plane.normal[2] * (x[2] - plane.point[2]);
  for (int i = 0; i < 3; ++i) y[1 + i] = T(plane.normal[i]);
}
template <class T>
void closedForm(const Cylinder& cylinder, const T* x, T* y) {
  using std::sqrt;
  T d[3], along(0.0), square(0.0);
  for (int i = 0; i < 3; ++i) d[i] = x[i] - T(cylinder.center[i]);
  for (int i = 0; i < 3; ++i) along += cylinder.axis[i] * d[i];
  for (int i = 0; i < 3; ++i) d[i] -= cylinder.axis[i] * along;
  for (int i = 0; i < 3; ++i) square += d[i] * d[i];
  const T distance = sqrt(square);
  y[0] = distance - T(cylinder.radius);
  for (int i = 0; i < 3; ++i) y[1 + i] = d[i] / distance;
}

}  // namespace atrapos::contact::test
