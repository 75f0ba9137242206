// Projections on rigid tools, paper (10)-(12), against sampling of the surface, closed forms and a reference.
#include <gtest/gtest.h>

#include <cmath>

#include "SeriesRun.hpp"
#include "support/Differences.hpp"
#include "support/Geometry.hpp"

using namespace atrapos;
using namespace atrapos::contact;
using namespace atrapos::contact::test;

namespace {

/// Random tools with points far off, near the surface and a little inside.
template <class F>
void forPlanes(const F& f) {
  Random random(1);
  for (int i = 0; i < 20; ++i) {
    const Plane tool = random.plane();
    for (const double gap : {7.0, 0.3, 1e-6, -1e-6, -0.2}) f(tool, pointAt(tool, gap, random), gap, random);
  }
}
template <class F>
void forCylinders(const F& f) {
  Random random(2);
  for (int i = 0; i < 20; ++i) {
    const Cylinder tool = random.cylinder();
    for (const double gap : {7.0, 0.3, 1e-6, -1e-6, -0.2}) f(tool, pointAt(tool, gap, random), gap, random);
  }
}

/// The nearest of many points of the surface, by a grid that closes in on the best one.
template <class Tool>
Vector3 nearestSample(const Tool& tool, const Vector3& x) {
  double u = 0, v = 0, halfU = 20, halfV = 20, best = 1e300;  // every place that the random points lie over
  constexpr int n = 60;
  for (int zoom = 0; zoom < 12; ++zoom) {
    const double u0 = u, v0 = v;
    for (int i = -n; i <= n; ++i)
      for (int j = -n; j <= n; ++j) {
        const double ui = u0 + halfU * i / n, vj = v0 + halfV * j / n;
        const double d = length(sum(x, -1, surfacePoint(tool, ui, vj)));
        if (d < best) {
          best = d;
          u = ui;
          v = vj;
        }
      }
    halfU /= 8;
    halfV /= 8;
  }
  return surfacePoint(tool, u, v);
}

template <class Tool>
void againstSampling(const Tool& tool, const Vector3& x, double gap) {
  const auto y = project(tool, x);
  const Vector3 foot = nearestSample(tool, x), n{y[1], y[2], y[3]};
  // The distance is second order in the place, which the zoom finds to 1e-8 where rounding of the distance
  // (1e-15 of about 10) hides smaller differences, and to the last grid's 20/60/8^11 otherwise.
  const double sampled = length(sum(x, -1, foot)), tolerance = std::abs(gap) > 1e-3 ? 1e-12 : 1e-9;
  EXPECT_NEAR(std::abs(y[0]), sampled, tolerance);
  EXPECT_EQ(y[0] > 0, gap > 0);
  EXPECT_NEAR(y[0], gap, 1e-14 * 20);  // coordinates up to 20
  EXPECT_NEAR(length(n), 1.0, 4 * eps);
  if (std::abs(gap) > 0.1) {  // foot = x - h n; its place is known to sqrt(1e-15 * 10 * gap)
    EXPECT_LT(length(sum(sum(x, -y[0], n), -1, foot)), 1e-6);
  }
}

TEST(Tools, PlaneIsTheNearestSurface) {
  int i = 0;
  forPlanes([&](const Plane& tool, const Vector3& x, double gap, Random&) {
    if (i++ % 3 == 0) againstSampling(tool, x, gap);
  });
}

TEST(Tools, CylinderIsTheNearestSurface) {
  int i = 0;
  forCylinders([&](const Cylinder& tool, const Vector3& x, double gap, Random&) {
    if (i++ % 3 == 0) againstSampling(tool, x, gap);
  });
}

/// Gradient of the gap = n (both tools say symmetric), gradient of n = (I - a a^T - n n^T)/(h + r), 0 for a
/// plane.
template <class Tool>
void derivatives(const Tool& tool, const Vector3& x, Random& random, double radius, const Vector3& axis) {
  static_assert(Tool::symmetric);
  const Projection<Tool> law{tool};
  double y[4], jacobian[12];
  taylor::tangent(law, x.data(), nullptr, y, jacobian);
  for (int j = 0; j < 3; ++j) {
    EXPECT_NEAR(jacobian[j], y[1 + j], 1e-14);  // a 4 x 4 solve of a well-conditioned matrix
    for (int i = 0; i < 3; ++i) {
      const double projector = (i == j) - axis[i] * axis[j] - y[1 + i] * y[1 + j];
      const double exact = radius > 0 ? projector / (y[0] + radius) : 0.0;
      EXPECT_NEAR(jacobian[3 * (1 + i) + j], exact, radius > 0 ? 1e-14 * (1 + 1 / (y[0] + radius)) : 0.0);
    }
  }
  const Vector3 d = random.direction();
  std::array<double, 4> slope{};
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 3; ++j) slope[i] += jacobian[3 * i + j] * d[j];
  const auto f = [&](double step) { return project(tool, sum(x, step, d)); };
  expectDerivative(f, slope, radius > 0 ? 0.05 * (y[0] + radius) : 0.1, 20 * 20 * eps, "projection");
}

TEST(Tools, PlaneDerivatives) {
  forPlanes([](const Plane& tool, const Vector3& x, double, Random& random) {
    derivatives(tool, x, random, 0, {0, 0, 0});
  });
}

TEST(Tools, CylinderDerivatives) {
  forCylinders([](const Cylinder& tool, const Vector3& x, double, Random& random) {
    derivatives(tool, x, random, tool.radius, vector(tool.axis));
  });
}

// Eight skew points, each moving along a curve of its own; orders to 20 against long double.
template <class Tool>
void orders(const Tool& tool, Random& random) {
  Coefficients x(3, std::vector<Values>(21));
  for (int l = 0; l < L; ++l) {
    const Vector3 start = pointAt(tool, l == 0 ? 1e-9 : random.between(-0.2, 3), random);
    for (int k = 0; k <= 20; ++k) {
      // Slower than half the distance to the axis a unit of the parameter: the series decays.
      const Vector3 c = k == 0 ? start : scaled(0.1 * std::pow(0.4, k - 1), random.direction());
      for (int i = 0; i < 3; ++i) x[i][k][l] = c[i];
    }
  }
  for (const Mode mode : {Mode::Direct, Mode::AsASolver}) {
    const auto r = runSeries(Projection<Tool>{tool}, x, mode);
    for (int l = 0; l < L; ++l) {
      const LongSeries in[3] = {lane(x[0], l), lane(x[1], l), lane(x[2], l)};
      LongSeries y[4];
      closedForm(tool, in, y);
      // Rounding of coordinates up to 20; the orders decay at least as 0.5^k.
      for (int i = 0; i < 4; ++i)
        for (int k = 0; k <= 20; ++k)
          ASSERT_NEAR(r.out[i][k][l], static_cast<double>(y[i].at(k)), 20 * 20 * eps * std::pow(0.5, k))
              << "entry " << i << " order " << k << " lane " << l;
    }
  }
}

TEST(Tools, OrdersOfProjections) {
  Random random(3);
  for (int i = 0; i < 10; ++i) {
    orders(random.plane(), random);
    orders(random.cylinder(), random);
  }
}

// The reference projection (taylor's tests run it on a law of their own) turned to a skew axis.
TEST(Tools, CylinderReferenceTurnedIntoSpace) {
  const auto rows = readColumns("projection_cylinder_taylor.csv");  // point (30, 50) + a (10, -20), r = 50
  Random random(4);
  const Vector3 axis = random.direction(), center = random.inCube(20);
  const auto [s, t] = normalsTo(axis);
  const Cylinder tool{{center[0], center[1], center[2]}, {axis[0], axis[1], axis[2]}, 50};
  Coefficients x(3, std::vector<Values>(rows.size(), Values(0.0)));
  for (int i = 0; i < 3; ++i) {
    x[i][0] = center[i] + 30 * s[i] + 50 * t[i] + 8 * axis[i];
    x[i][1] = 10 * s[i] - 20 * t[i] + 3 * axis[i];  // motion along the axis changes nothing
  }
  const auto r = runSeries(Projection<Cylinder>{tool}, x, Mode::AsASolver);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    // Rounding of coordinates of about 60; the series decays as 2.6^-k, 2^-k leaves room for the growth of
    // errors.
    const double tolerance = 100 * 60 * eps * std::pow(0.5, k);
    EXPECT_NEAR(r.out[0][k][0], rows[k][1], tolerance) << k;
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR(r.out[1 + i][k][0], rows[k][2] * s[i] + rows[k][3] * t[i], tolerance) << k;
  }
}

TEST(Tools, CylinderDoesNotDependOnUnits) {
  forCylinders([](const Cylinder& tool, const Vector3& x, double, Random&) {
    for (const double unit : {1e-9, 25.4e-3, 1e6}) {
      Cylinder other = tool;
      for (double& c : other.center) c *= unit;
      other.radius *= unit;
      const auto y = project(tool, x), z = project(other, scaled(unit, x));
      EXPECT_NEAR(z[0], unit * y[0], 1e-14 * 20 * unit);  // rounding of the scaled coordinates, up to 20
      for (int i = 1; i < 4; ++i) EXPECT_NEAR(z[i], y[i], 1e-13);  // the same over h + r >= 0.3
    }
  });
}

TEST(Tools, NoProjectionFromTheAxis) {
  const Cylinder tool{{1, 2, 3}, {0, 1, 0}, 0.5};
  const double x[3] = {1, 7, 3};
  double y[4];
  EXPECT_FALSE((taylor::solveImplicit<3, 4>(tool, x, y)));
  EXPECT_TRUE(std::isnan(y[0]));
}

}  // namespace
