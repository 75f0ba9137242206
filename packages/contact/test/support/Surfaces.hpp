#pragma once

#include "ToolChecks.hpp"

/// The analytic tools' surfaces by angle and place, independent of their equations.
namespace atrapos::contact::test {

inline Vector3 turned(const Vector3& axis, double angle) {
  const auto [s, t] = normalsTo(axis);
  return sum(scaled(std::cos(angle), s), std::sin(angle), t);
}

inline Parametrised surface(const Sphere& t) {
  const double r = t.radius, sign = t.inside ? -1 : 1;
  return {"sphere",
          0,
          6.28,
          0.1,
          3.0,
          [=](double u, double v) {
            const Vector3 d = {std::sin(v) * std::cos(u), std::sin(v) * std::sin(u), std::cos(v)};
            return SurfacePlace{sum(vector(t.center), r, d), scaled(sign, d)};
          },
          t.inside ? 5.0 : 0.6 * r,
          t.inside ? 0.6 * r : 5.0};
}

inline Parametrised surface(const Cylinder& t) {
  const double r = t.radius, sign = t.inside ? -1 : 1;
  return {"cylinder",
          0,
          6.28,
          -4,
          4,
          [=](double u, double v) {
            const Vector3 d = turned(vector(t.axis), u);
            return SurfacePlace{sum(sum(vector(t.center), v, vector(t.axis)), r, d), scaled(sign, d)};
          },
          t.inside ? 5.0 : 0.6 * r,
          t.inside ? 0.6 * r : 5.0};
}

/// Places away from the apex, so that neither the tip nor the axis comes into reach.
inline Parametrised surface(const Cone& t) {
  const double s = std::sin(t.halfAngle), c = std::cos(t.halfAngle), sign = t.inside ? -1 : 1;
  const double nearest = 4, reach = 0.5 * nearest * s / c;
  return {"cone",
          0,
          6.28,
          nearest,
          9,
          [=](double u, double v) {  // v along the generator
            const Vector3 d = turned(vector(t.axis), u), a = vector(t.axis);
            return SurfacePlace{sum(sum(vector(t.apex), v * c, a), v * s, d),
                                scaled(sign, sum(scaled(c, d), -s, a))};
          },
          t.inside ? 3.0 : reach,
          t.inside ? reach : 3.0};
}

inline Parametrised surface(const Torus& t) {
  const double sign = t.inside ? -1 : 1, hole = 0.7 * (t.radius - t.tubeRadius);
  return {"torus",
          0,
          6.28,
          0,
          6.28,
          [=](double u, double v) {
            const Vector3 e = turned(vector(t.axis), u);
            const Vector3 d = sum(scaled(std::cos(v), e), std::sin(v), vector(t.axis));
            return SurfacePlace{sum(sum(vector(t.center), t.radius, e), t.tubeRadius, d), scaled(sign, d)};
          },
          t.inside ? hole : 0.6 * t.tubeRadius,
          t.inside ? 0.6 * t.tubeRadius : hole};
}

template <class Profile>
Parametrised surface(const Roll<Profile>& t, double from, double to, double deepest, double farthest) {
  return {"roll",
          0,
          6.28,
          from,
          to,
          [=](double u, double v) {
            double r, slope;
            t.profile(v, r, slope);
            const Vector3 d = turned(vector(t.axis), u), a = vector(t.axis);
            return SurfacePlace{sum(sum(vector(t.center), v, a), r, d), unit(sum(d, -slope, a))};
          },
          deepest,
          farthest};
}

}  // namespace atrapos::contact::test
