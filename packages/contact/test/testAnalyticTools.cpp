// Sphere, cylinder, cone, torus and rolls: nearest surface, derivatives three ways, orders to 20, bad tools.
#include <gtest/gtest.h>

#include <cmath>

#include "support/Refusals.hpp"
#include "support/Surfaces.hpp"

using namespace atrapos;
using namespace atrapos::contact;
using namespace atrapos::contact::test;

namespace {

void set(double (&to)[3], const Vector3& from) {
  for (int i = 0; i < 3; ++i) to[i] = from[i];
}

TaperedProfile tapered(bool bothEnds) { return {5, 1.5, 0.1, 0.4, bothEnds}; }
PolynomialProfile crowned() { return PolynomialProfile::of({5, 0.02, -0.03, 0, 2e-4}); }
TableProfile tabulated() {
  return TableProfile::through({-4, -2.5, -1, 0, 1, 2, 4}, {4.5, 4.8, 4.95, 5, 4.97, 4.8, 4.4});
}

/// Calls f(tool, surface, step, pace) for every kind of tool at random places and axes. step: of differences,
/// small against the radii of curvature; pace: of series, within half the distance to the nearest
/// singularity.
template <class F>
void forTools(const F& f) {
  Random random(31);
  for (int i = 0; i < 3; ++i) {
    const Vector3 c = random.inCube(3), a = random.direction();
    for (const bool inside : {false, true}) {
      Sphere sphere;
      set(sphere.center, c);
      sphere.radius = random.between(2, 4);
      sphere.inside = inside;
      f(sphere, surface(sphere), 0.05, 0.1);
      Cylinder cylinder;
      set(cylinder.center, c);
      set(cylinder.axis, a);
      cylinder.radius = random.between(2, 4);
      cylinder.inside = inside;
      f(cylinder, surface(cylinder), 0.05, 0.1);
      Cone cone;
      set(cone.apex, c);
      set(cone.axis, a);
      cone.halfAngle = random.between(0.5, 1.2);
      cone.inside = inside;
      f(cone, surface(cone), 0.05, 0.1);
      Torus torus;
      set(torus.center, c);
      set(torus.axis, a);
      torus.radius = random.between(4, 6);
      torus.tubeRadius = random.between(1.5, 2);
      torus.inside = inside;
      f(torus, surface(torus), 0.03, 0.06);
    }
    const auto roll = [&](auto profile, double from, double to, double pace) {
      Roll<decltype(profile)> tool;
      set(tool.center, c);
      set(tool.axis, a);
      tool.profile = profile;
      f(tool, surface(tool, from, to, 2, 2), 0.5 * pace, pace);
    };
    roll(tapered(false), -2, 4, 0.06);  // tanh has poles at pi/2 * 0.4 from the real axis
    roll(tapered(true), -4, 4, 0.06);
    roll(crowned(), -4, 4, 0.1);
    roll(tabulated(), -4, 4, 0.1);  // branch points 1 from the real axis
  }
}

TEST(AnalyticTools, AreTheNearestSurface) {
  Random random(32);
  forTools([&](const auto& tool, const Parametrised& s, double, double) {
    isTheNearestSurface(tool, s, random, 20);
  });
}

TEST(AnalyticTools, DerivativesThreeWays) {
  Random random(33);
  forTools([&](const auto& tool, const Parametrised& s, double step, double) {
    differentiates(tool, s, random, step, 20);
  });
}

TEST(AnalyticTools, OrdersTo20) {
  Random random(34);
  forTools([&](const auto& tool, const Parametrised& s, double, double pace) {
    solvesItsEquationToOrder20(tool, s, random, pace);
  });
}

// A cone is a roll with the profile z tan(theta), and a sphere of radius 5 nearly one with a parabola.
TEST(AnalyticTools, ConeIsARollWithALinearProfile) {
  Cone cone;
  cone.halfAngle = 0.4;
  CrownedRoll roll;
  roll.profile.degree = 1;
  roll.profile.coefficient[0] = 0;
  roll.profile.coefficient[1] = std::tan(0.4);
  Random random(35);
  for (const OverSurface& p : pointsOver(surface(cone), random)) {
    const auto y = project(cone, p.x), z = project(roll, p.x);
    for (int i = 0; i < 4; ++i) EXPECT_NEAR(y[i], z[i], 100 * eps * 10);  // coordinates up to 10
  }
}

// Paper (37): r falls from the cylinder to the cone of angle p; the vertex is within 0.14 width tan p.
TEST(AnalyticTools, TaperTendsToCylinderAndCone) {
  for (const double width : {0.4, 0.1, 1.0 / 23}) {
    const TaperedProfile profile{50, 15, 0.1, width, false};
    double worst = 0;
    for (double z = 0; z < 30; z += width / 50) {
      double r, slope;
      profile(z, r, slope);
      worst = std::max(worst, std::fabs(r - (50 - std::tan(0.1) * std::max(z - 15, 0.0))));
    }
    EXPECT_LT(worst, 0.1393 * width * std::tan(0.1));  // max of t (1 - tanh t)/2 = 0.13923
    EXPECT_GT(worst, 0.139 * width * std::tan(0.1));
    double r, slope;
    profile(35.0, r, slope);  // 50 widths beyond the vertex at least: tanh is 1
    EXPECT_NEAR(r, 50 - 20 * std::tan(0.1), 50 * eps);
    EXPECT_NEAR(slope, -std::tan(0.1), 4 * eps);
  }
}

// Paper (37) as printed: h and n across the axis. Same surface, gaps longer by 1/cos p over the cone, to the
// first order of the gap; and a tangent that is unsymmetric.
TEST(AnalyticTools, RadialRollHasTheSameSurface) {
  RadialRoll<TaperedProfile> radial;
  radial.profile = tapered(false);
  TaperedRoll roll;
  roll.profile = radial.profile;
  const Parametrised s = surface(roll, -2, 4, 2, 2);
  Random random(36);
  for (int i = 0; i < 20; ++i) {
    const auto place = s.at(random.between(0, 6), random.between(-2, 4));
    EXPECT_NEAR(project(radial, place.point)[0], 0.0, 100 * eps * 10);
  }
  const double z = 3.9;  // on the cone: 6 widths beyond the vertex
  const auto place = s.at(1, z);
  const Vector3 x = sum(place.point, 1e-3, place.normal);
  EXPECT_NEAR(project(radial, x)[0], 1e-3 / std::cos(0.1), 1e-3 * 1e-4);  // tanh differs from 1 by e^-12
  double y[4], jacobian[12];
  taylor::tangent(Projection<RadialRoll<TaperedProfile>>{radial}, x.data(), nullptr, y, jacobian);
  EXPECT_NEAR(jacobian[1], std::tan(0.1), 1e-3);  // dh along the axis (y), where n has nothing
  EXPECT_NEAR(y[2], 0.0, 10 * eps);
}

TEST(AnalyticTools, RadialRollDerivatives) {
  RadialRoll<TaperedProfile> radial;
  radial.profile = tapered(true);
  TaperedRoll roll;
  roll.profile = radial.profile;
  Random random(37);
  const Parametrised s = surface(roll, -4, 4, 2, 2);
  differentiates(radial, s, random, 0.03, 20);
  solvesItsEquationToOrder20(radial, s, random, 0.06);
}

// A table of a smooth function: error falls at least with the fourth power of the spacing, inside the table.
TEST(AnalyticTools, TableConvergesToASmoothProfile) {
  const auto crown = [](double z) { return 5 + 0.3 * std::cos(0.7 * z); };
  double before = 0;
  for (const int n : {7, 13, 25}) {
    std::vector<double> places, radii;
    for (int i = 0; i < n; ++i) {
      places.push_back(-6 + 12.0 * i / (n - 1));
      radii.push_back(crown(places.back()));
    }
    const TableProfile table = TableProfile::through(places, radii);
    for (int i = 0; i < n; ++i) {
      double r, slope;
      table(places[i], r, slope);
      EXPECT_NEAR(r, radii[i], 1e-11);  // a linear system of condition 1e4 to 1e5
    }
    double worst = 0;
    for (double z = -3; z <= 3; z += 0.01) {  // at the table's ends natural conditions cost order
      double r, slope;
      table(z, r, slope);
      worst = std::max(worst, std::fabs(r - crown(z)));
    }
    if (before > 0) {
      EXPECT_GT(before / worst, 14.0) << n;
    }
    before = worst;
  }
}

template <class Tool>
void expectAmbiguous(const Tool& tool, const Vector3& x, const std::string& words) {
  EXPECT_NE(tool.ambiguity(x.data()).find(words), std::string::npos) << tool.ambiguity(x.data());
}

TEST(AnalyticTools, LossOfUniquenessIsSaidInWords) {
  Sphere sphere{{1, 2, 3}, 2};
  expectAmbiguous(sphere, {1, 2, 3}, "centre of the sphere");
  EXPECT_TRUE(std::isnan(project(sphere, {1, 2, 3})[0]));
  Cylinder cylinder{{1, 2, 3}, {0, 1, 0}, 2};
  expectAmbiguous(cylinder, {1, 9, 3}, "axis of the cylinder");
  Cone cone;
  expectAmbiguous(cone, {0, 2, 0}, "axis of the cone");
  expectAmbiguous(cone, {0.1, -2, 0}, "behind the apex");
  EXPECT_TRUE(std::isnan(project(cone, {0, 2, 0})[0]));
  Torus torus;
  expectAmbiguous(torus, {0, 2, 0}, "axis of the torus");
  expectAmbiguous(torus, {2, 0, 0}, "centre line");
  EXPECT_TRUE(std::isnan(project(torus, {2, 0, 0})[0]));
  EXPECT_TRUE(std::isnan(project(torus, {0, 1, 0})[0]));
  TaperedRoll roll;
  roll.profile = tapered(false);
  expectAmbiguous(roll, {0, 2, 0}, "axis of the roll");
  expectAmbiguous(roll, {0.1, 60, 0}, "beyond the end");
  EXPECT_TRUE(std::isnan(project(roll, {0, 2, 0})[0]));
  // A waist r = 5 + z^2/4: radius of curvature 2 at z = 0.
  CrownedRoll waist;
  waist.profile = PolynomialProfile::of({5, 0, 0.25});
  expectAmbiguous(waist, {7.0, 0, 0}, "centre of curvature");
  EXPECT_EQ(waist.ambiguity(Vector3{6.9, 0, 0}.data()), "");
}

TEST(AnalyticTools, BadToolsAreRefused) {
  const double nan = std::nan("");
  expectRefused([] { Sphere{{0, 0, 0}, -1}.validate(); }, "sphere: radius must be > 0 and finite, got -1");
  expectRefused([&] { Sphere{{0, nan, 0}, 1}.validate(); }, "sphere: center must be finite");
  expectRefused([] { Cylinder{{0, 0, 0}, {0, 1, 0}, 0}.validate(); }, "cylinder: radius must be > 0");
  expectRefused(
      [] {
        Cylinder{{0, 0, 0}, {0, 2, 0}, 1}.validate();
      },
      "cylinder: axis must be a unit vector, got one of length 2");
  expectRefused([] { Plane{{0, 0, 0}, {0, 0, 0}}.validate(); }, "plane: normal must be a unit vector");
  expectRefused(
      [] {
        Cone{{0, 0, 0}, {0, 1, 0}, 1.6}.validate();
      },
      "cone: half angle must be between 0 and 1.5708, got 1.6");
  expectRefused(
      [] {
        Torus{{0, 0, 0}, {0, 1, 0}, 1, 1}.validate();
      },
      "torus: radius must be above the tube radius 1, got 1");
  expectRefused([] { TaperedProfile{50, 15, 2, 0.1}.validate(); }, "tapered roll: angle must be between");
  expectRefused(
      [] {
        TaperedProfile{50, 15, 0.1, 0}.validate();
      },
      "tapered roll: smoothing width must be > 0");
  expectRefused([] { TaperedProfile{-50, 15, 0.1, 0.1}.validate(); }, "tapered roll: radius must be > 0");
  expectRefused([] { PolynomialProfile::of({}); }, "needs 1 to 9 polynomial coefficients, got 0");
  expectRefused([] { PolynomialProfile::of({-1, 0}); }, "radius at the center must be > 0");
  expectRefused([] { TableProfile::through({0, 1}, {1}); }, "2 places but 1 radii");
  expectRefused([] { TableProfile::through({0}, {1}); }, "2 to 32 entries, got 1");
  expectRefused([] { TableProfile::through({0, 1, 1}, {1, 1, 1}); }, "places must ascend, got 1 after 1");
  expectRefused([] { TableProfile::through({0, 1, 2}, {1, -1, 1}); }, "radius in the table must be > 0");
  forTools([](const auto& tool, const Parametrised&, double, double) { EXPECT_NO_THROW(tool.validate()); });
}

}  // namespace
