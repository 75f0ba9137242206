// The force of a tool on a point: value, tangent and orders of ContactLaw against the closed forms of
// projection and pressure.
#include <gtest/gtest.h>

#include <cmath>

#include "SeriesRun.hpp"
#include "atrapos/contact/ContactLaw.hpp"
#include "support/Differences.hpp"
#include "support/Geometry.hpp"

using namespace atrapos;
using namespace atrapos::contact;
using namespace atrapos::contact::test;

namespace {

/// -R n in closed form.
template <class Tool, class T>
void closedForce(const ContactLaw<Tool>& law, bool open, const T* x, double Delta, T* out) {
  using std::sqrt;
  const double c = law.pressure.compliance;
  T y[4];
  closedForm(law.tool, x, y);
  const T load = law.pressure.eta * (T(Delta) - y[0]);
  const T root = sqrt(y[0] * y[0] + (4 * c) * load);
  T R = open ? 2.0 * load / (y[0] + root) : (1 / (2 * (c > 0 ? c : 1.0))) * (root - y[0]);
  for (int i = 0; i < 3; ++i) out[i] = -(R * y[1 + i]);
}

struct Place {
  double compliance, gap;
};
/// Pressed in, on both sides of h = 0, open, beyond Delta = 1; rigid contact open only.
const Place places[] = {{1e-3, -0.3}, {1e-3, -1e-3}, {1e-3, 1e-3}, {1e-3, 0.4},
                        {1e-3, 2.5},  {0, 0.02},     {0, 0.4},     {0, 2.5}};

template <class Tool>
void derivatives(const ContactLaw<Tool>& law, double gap, Random& random, const Vector3& axis,
                 double radius) {
  const Vector3 x = pointAt(law.tool, gap, random);
  const double Delta = 1;
  double force[3], jacobian[9], y[2];
  taylor::tangent(law, x.data(), &Delta, force, jacobian);
  law.observe(x.data(), &Delta, y);
  const auto projection = project(law.tool, x);
  const double h = y[0], R = y[1], *n = &projection[1];
  EXPECT_NEAR(h, gap, 20 * 20 * eps);  // coordinates up to 20
  EXPECT_NEAR(R * (law.pressure.compliance * R + h), law.pressure.eta * (Delta - h),
              10 * eps * (R * R * law.pressure.compliance + (R + law.pressure.eta) * (std::abs(h) + Delta)));

  // K = -R' n n^T - R grad n, R' = -(R + eta)/(2 R/alpha + h) < 0: stiff along n, and symmetric.
  const double slope = -(R + law.pressure.eta) / (2 * law.pressure.compliance * R + h);
  // The gap carries the rounding of coordinates; its effect on the tangent is R'' times that. With
  // b = 2 R/alpha + h, |R''| is about 2 |R'|/b.
  const double b = 2 * law.pressure.compliance * R + h;
  const double tolerance = 400 * eps * std::abs(slope) * (1 + 2 / b);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(force[i], -R * n[i], 10 * eps * std::abs(R));
    for (int j = 0; j < 3; ++j) {
      const double turning = radius > 0 ? ((i == j) - axis[i] * axis[j] - n[i] * n[j]) / (h + radius) : 0.0;
      EXPECT_NEAR(jacobian[3 * i + j], -slope * n[i] * n[j] - R * turning, tolerance);
      EXPECT_NEAR(jacobian[3 * i + j], jacobian[3 * j + i], tolerance);
    }
  }

  const Vector3 d = random.direction();
  const double nd = n[0] * d[0] + n[1] * d[1] + n[2] * d[2];
  std::array<double, 3> exact{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) exact[i] += jacobian[3 * i + j] * d[j];
  const auto f = [&](double step) {
    std::array<double, 3> out;
    taylor::value(law, sum(x, step, d).data(), &Delta, out.data());
    return out;
  };
  // Well inside the distance to the law's branch points, h = 2 eta/alpha +- 2i sqrt(eta Delta/alpha) or 0.
  const double reach = std::hypot(h, 2 * std::sqrt(law.pressure.compliance * law.pressure.eta * Delta));
  const double step = 0.03 * std::min(reach / std::max(std::abs(nd), 0.1), radius > 0 ? h + radius : 1e300);
  expectDerivative(f, exact, step, 20 * eps * (std::abs(R) + std::abs(slope)), "gap " + std::to_string(gap));
}

TEST(ContactLaw, PlaneDerivatives) {
  Random random(11);
  for (const Place& place : places)
    for (int i = 0; i < 5; ++i)
      derivatives(ContactLaw<Plane>{random.plane(), {place.compliance, 0.1}}, place.gap, random, {0, 0, 0},
                  0);
}

TEST(ContactLaw, CylinderDerivatives) {
  Random random(12);
  for (const Place& place : places)
    for (int i = 0; i < 5; ++i) {
      const Cylinder tool = random.cylinder();
      derivatives(ContactLaw<Cylinder>{tool, {place.compliance, 0.1}}, place.gap, random, vector(tool.axis),
                  tool.radius);
    }
}

// Orders to 20 of eight points over one tool, each on its own curve and with its own gap about `gap`.
template <class Tool>
void orders(const ContactLaw<Tool>& law, double gap, Random& random) {
  Coefficients x(3, std::vector<Values>(21));
  const double c = law.pressure.compliance, eta = law.pressure.eta, Delta = 1;
  // Gaps move by a quarter of the distance to the branch points for a unit of the parameter.
  const double reach = std::hypot(gap, 2 * std::sqrt(c * eta * Delta));
  for (int l = 0; l < L; ++l) {
    const Vector3 start = pointAt(law.tool, gap * (1 + 0.05 * l), random);
    for (int k = 0; k <= 20; ++k) {
      const Vector3 coefficient =
          k == 0 ? start : scaled(0.15 * std::min(reach, 0.5) * std::pow(0.4, k - 1), random.direction());
      for (int i = 0; i < 3; ++i) x[i][k][l] = coefficient[i];
    }
  }
  const Values data(Delta);
  for (const Mode mode : {Mode::Direct, Mode::AsASolver}) {
    const auto r = runSeries(law, x, mode, &data);
    for (int l = 0; l < L; ++l) {
      const LongSeries in[3] = {lane(x[0], l), lane(x[1], l), lane(x[2], l)};
      LongSeries out[3];
      closedForce(law, gap > 0, in, Delta, out);
      double R = 0;
      for (const auto& f : out) R = std::hypot(R, static_cast<double>(f.at(0)));
      // Rounding of coordinates up to 20, times the slope of R and its curvature (see above), carried along
      // by orders that decay at least as 0.6^k.
      const double b = std::sqrt(gap * gap + 4 * c * eta * std::abs(Delta - gap));
      const double size = R + (R + eta) / b * 20 * (1 + 1 / b);
      for (int i = 0; i < 3; ++i)
        for (int k = 0; k <= 20; ++k)
          ASSERT_NEAR(r.out[i][k][l], static_cast<double>(out[i].at(k)), 100 * eps * size * std::pow(0.6, k))
              << "entry " << i << " order " << k << " lane " << l << " gap " << gap;
    }
  }
}

TEST(ContactLaw, Orders) {
  Random random(13);
  for (const Place& place : places) {
    orders(ContactLaw<Plane>{random.plane(), {place.compliance, 0.1}}, place.gap, random);
    orders(ContactLaw<Cylinder>{random.cylinder(), {place.compliance, 0.1}}, place.gap, random);
  }
}

// Force scales as a pressure, tangent as a pressure per length.
TEST(ContactLaw, DoesNotDependOnUnits) {
  Random random(14);
  const double lengthUnit = 1e-3, pressureUnit = 1e6;
  for (const Place& place : places) {
    const Cylinder tool = random.cylinder();
    const Vector3 x = pointAt(tool, place.gap, random);
    Cylinder scaledTool = tool;
    for (double& c : scaledTool.center) c *= lengthUnit;
    scaledTool.radius *= lengthUnit;
    const ContactLaw<Cylinder> law{tool, {place.compliance, 0.1}};
    const ContactLaw<Cylinder> other{scaledTool,
                                     {place.compliance * lengthUnit / pressureUnit, 0.1 * pressureUnit}};
    const double Delta = 1, scaledDelta = lengthUnit;
    double f[3], K[9], g[3], M[9];
    taylor::tangent(law, x.data(), &Delta, f, K);
    taylor::tangent(other, scaled(lengthUnit, x).data(), &scaledDelta, g, M);
    double largest = 0;
    for (const double k : K) largest = std::max(largest, std::abs(k));
    // Rounding of scaled coordinates, up to 20, through the slope of the force and of the tangent.
    const double tolerance = 400 * eps * largest;  // the tangent: times 1/b, b = 2 R/alpha + h >= 0.019 here
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(g[i] / pressureUnit, f[i], tolerance);
    for (int i = 0; i < 9; ++i) EXPECT_NEAR(M[i] * lengthUnit / pressureUnit, K[i], tolerance / 0.019);
  }
}

}  // namespace
