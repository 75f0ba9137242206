#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "Differences.hpp"
#include "Geometry.hpp"
#include "SeriesRun.hpp"
#include "atrapos/contact/Tools.hpp"

/// What holds for every tool whose unknowns are (h, n), from its surface given a second time by two
/// parameters.
namespace atrapos::contact::test {

struct SurfacePlace {
  Vector3 point, normal;
};

/// A surface by u in [u0, u1], v in [v0, v1]; the normal points to the free side.
struct Parametrised {
  std::string name;
  double u0, u1, v0, v1;
  std::function<SurfacePlace(double, double)> at;
  /// Range of gaps (below: inside the tool) in which every place of the surface is the nearest one.
  double deepest, farthest;
};

/// Distance to the nearest of many points of the surface, by a grid that closes in on the best one.
inline double sampledDistance(const Parametrised& s, const Vector3& x) {
  double u = (s.u0 + s.u1) / 2, v = (s.v0 + s.v1) / 2, halfU = (s.u1 - s.u0) / 2, halfV = (s.v1 - s.v0) / 2;
  double best = 1e300;
  constexpr int n = 60;
  for (int zoom = 0; zoom < 12; ++zoom) {
    const double um = u, vm = v;
    for (int i = -n; i <= n; ++i)
      for (int j = -n; j <= n; ++j) {
        const double ui = um + halfU * i / n, vj = vm + halfV * j / n;
        const double d = length(sum(x, -1, s.at(ui, vj).point));
        if (d < best) {
          best = d;
          u = ui;
          v = vj;
        }
      }
    halfU /= 8;
    halfV /= 8;
  }
  return best;
}

struct OverSurface {
  Vector3 x;
  double gap;
  Vector3 normal;
};

/// Points far off, near and under the surface, at random places and at corners of the parameters' ranges.
inline std::vector<OverSurface> pointsOver(const Parametrised& s, Random& random) {
  std::vector<OverSurface> points;
  for (const double part : {0.9, 0.3, 1e-7, -1e-7, -0.5})
    for (int i = 0; i < 3; ++i) {
      const double gap = part > 0 ? part * s.farthest : part * s.deepest;
      const double q = i == 0 ? 1e-3 : random.between(0, 1), p = i == 1 ? 0.999 : random.between(0, 1);
      const auto place = s.at(s.u0 + q * (s.u1 - s.u0), s.v0 + p * (s.v1 - s.v0));
      points.push_back({sum(place.point, gap, place.normal), gap, place.normal});
    }
  return points;
}

template <class Tool>
void isTheNearestSurface(const Tool& tool, const Parametrised& s, Random& random, double size) {
  int i = 0;
  for (const OverSurface& p : pointsOver(s, random)) {
    const auto y = project(tool, p.x);
    EXPECT_NEAR(y[0], p.gap, 100 * size * eps) << s.name;  // about 20 operations on coordinates of this size
    // A normal turns by the rounding of coordinates over the radius of curvature; none here is below
    // size/100.
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(y[1 + k], p.normal[k], 1e4 * eps) << s.name << " gap " << p.gap;
    EXPECT_EQ(tool.ambiguity(p.x.data()), "") << s.name;
    // Near the surface the sampled distance is the place's own uncertainty, about 8^-11 of the range.
    if (i++ % 4 == 0) {
      EXPECT_NEAR(std::fabs(y[0]), sampledDistance(s, p.x),
                  std::fabs(p.gap) > 1e-3 ? 1e-11 * size : 1e-9 * size)
          << s.name;
    }
  }
}

/// Differences, Fad and order 1 of the sweep agree; n is the gradient of h where the tool says so.
template <class Tool>
void differentiates(const Tool& tool, const Parametrised& s, Random& random, double step, double size) {
  const Projection<Tool> law{tool};
  for (const OverSurface& p : pointsOver(s, random)) {
    double y[4], jacobian[12];
    taylor::tangent(law, p.x.data(), nullptr, y, jacobian);
    if (Tool::symmetric) {
      for (int j = 0; j < 3; ++j) EXPECT_NEAR(jacobian[j], y[1 + j], 1e4 * eps) << s.name;
    }
    const Vector3 d = random.direction();
    std::array<double, 4> slope{};
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 3; ++j) slope[i] += jacobian[3 * i + j] * d[j];
    const auto f = [&](double t) { return project(tool, sum(p.x, t, d)); };
    expectDerivative(f, slope, step, 100 * size * eps, s.name);
    Coefficients x(3, std::vector<Values>(2));
    for (int i = 0; i < 3; ++i) {
      x[i][0] = p.x[i];
      x[i][1] = d[i];
    }
    const auto r = runSeries(law, x, Mode::AsASolver);
    double largest = 1;
    for (const double c : slope) largest = std::max(largest, std::fabs(c));
    for (int i = 0; i < 4; ++i) EXPECT_NEAR(r.out[i][1][0], slope[i], 1e5 * eps * largest) << s.name;
  }
}

/// The series of (h, n), put with that of x into the tool's equation in long double arithmetic, leaves
/// nothing at any order up to 20; dg/dy is not singular, so no other series does. `pace`: how far the points
/// go.
template <class Tool>
void solvesItsEquationToOrder20(const Tool& tool, const Parametrised& s, Random& random, double pace) {
  const auto points = pointsOver(s, random);
  for (std::size_t first = 0; first + L <= points.size(); first += 7) {
    Coefficients x(3, std::vector<Values>(21));
    for (int l = 0; l < L; ++l)
      for (int k = 0; k <= 20; ++k) {
        const Vector3 c =
            k == 0 ? points[first + l].x : scaled(pace * std::pow(0.4, k - 1), random.direction());
        for (int i = 0; i < 3; ++i) x[i][k][l] = c[i];
      }
    for (const Mode mode : {Mode::Direct, Mode::AsASolver}) {
      const auto r = runSeries(Projection<Tool>{tool}, x, mode);
      for (int l = 0; l < L; ++l) {
        LongSeries in[3], y[4], g[4];
        for (int i = 0; i < 3; ++i) in[i] = lane(x[i], l);
        for (int i = 0; i < 4; ++i) y[i] = lane(r.out[i], l);
        tool(in, y, g);
        double size = 0;
        for (const auto& q : in) size += static_cast<double>(std::fabs(q.at(0)));
        // Orders of such points decay at least as 0.7^k; the sums of 20 orders carry some 100 roundings.
        for (int i = 0; i < 4; ++i)
          for (int k = 0; k <= 20; ++k)
            ASSERT_NEAR(static_cast<double>(g[i].at(k)), 0.0, 1000 * eps * (1 + size) * std::pow(0.7, k))
                << s.name << " equation " << i << " order " << k << " lane " << l;
        EXPECT_GT(std::fabs(r.out[0][20][l]) + std::fabs(r.out[1][20][l]), 0.0);
      }
    }
  }
}

}  // namespace atrapos::contact::test
