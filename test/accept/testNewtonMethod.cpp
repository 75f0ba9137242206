// `method: newton` and `method: modified_newton` go along the curve that the series have, in points.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/ExampleRun.hpp"

namespace atrapos::test {
namespace {

struct Curve {
  std::vector<double> x, y;
};

/// The largest distance of b's points from the curve a, along y.
double distance(const Curve& a, const Curve& b) {
  double worst = 0;
  for (std::size_t i = 0; i < b.x.size(); ++i)
    worst = std::max(worst, std::abs(interpolate(a.x, a.y, b.x[i]) - b.y[i]));
  return worst;
}

class NewtonMethod : public testing::TestWithParam<const char*> {
 protected:
  /// Of the series, whose points are interpolated: an error far below the tolerances.
  static constexpr const char* kPoints = "points_per_step: 30";
  std::string method() const { return std::string("path:\n  method: ") + GetParam(); }
};

/// Through both limit points of the load: it is a function of the deflection.
TEST_P(NewtonMethod, HingedRoof) {
  const std::string name = "shells/hinged_roof_12.7.yaml";
  const ExampleRun series(name, {{"output:", std::string("output:\n  ") + kPoints}});
  const ExampleRun newton(name, {{"path:", method()}});
  const auto curve = [](const ExampleRun& run) {
    Curve c{run.column("centre_uz"), run.column("load_factor")};
    for (double& x : c.x) x = -x;
    return c;
  };
  EXPECT_EQ(newton.summary.at("limit_points"), 2);
  // Residual bounds of 1e-6, and some room: 6e-8 and 3e-7 as measured, of loads up to 1.2.
  EXPECT_LT(distance(curve(series), curve(newton)), 2e-5);
}

/// With contact that opens and closes: all monitors are functions of the load.
TEST_P(NewtonMethod, StripOnRoll) {
  const std::string name = "strip_roll/shell.yaml";
  // Output is most of the work, and not the subject.
  const Edits fewer{{"load_factor: 2", "load_factor: 0.5"}, {"stress, nodal_stress, ", ""}};
  Edits dense = fewer, steps = fewer;
  dense.push_back({"points_per_step: 10", kPoints});
  steps.push_back({"points_per_step: 10", "points_per_step: 1"});
  steps.push_back({"path:", method()});
  const ExampleRun series(name, dense), newton(name, steps);
  EXPECT_GE(newton.summary.at("steps"), 20);
  const auto load = series.column("load_factor"), at = newton.column("load_factor");
  for (const char* monitor : {"tip_ux", "tip_uz", "force"}) {
    // mm and N, of 150 mm and 40 N: where contact moves between two stations the strip is soft, and the bound
    // of the residual, 1e-6, leaves up to 9e-4 mm open (modified Newton, whose points are near that bound).
    EXPECT_LT(distance({load, series.column(monitor)}, {at, newton.column(monitor)}), 3e-3) << monitor;
  }
}

/// A ball that comes down through a gap: nothing moves until it touches.
TEST_P(NewtonMethod, BallFromAfar) {
  const ExampleRun series("contact/hertz.yaml", {{"output:", "output:\n  points_per_step: 8"}});
  const ExampleRun newton("contact/hertz.yaml", {{"path:", method()}});
  EXPECT_EQ(newton.column("load_factor").back(), 0.1125);
  EXPECT_EQ(newton.column("force")[1], 0);
  // Of 14.5 N; 9e-6 is seen, with bounds of 1e-6. Cubics do not know the corner at the first touch.
  const Curve known{series.column("load_factor"), series.column("force")};
  const auto load = newton.column("load_factor"), force = newton.column("force");
  for (std::size_t i = 0; i < load.size(); ++i) {
    if (load[i] < 0.1001) continue;
    EXPECT_NEAR(force[i], interpolate(known.x, known.y, load[i]), 5e-5) << load[i];
  }
}

TEST_P(NewtonMethod, LoadWithoutEffect) {
  const ExampleFolder folder("contact/hertz.yaml",
                             {{"path:", method()}, {"load_factor: 0.1125", "load_factor: 0.09"}});
  const CommandResult r = runAtrapos(ExampleFolder::run(), folder.path());
  EXPECT_EQ(r.exitCode, 3);
  EXPECT_NE(r.err.find("the load parameter does not move the unknowns"), std::string::npos) << r.err;
}

/// The thermistor in volts and kelvins, and in thousandths of both: as many steps, and the same path.
TEST_P(NewtonMethod, UnitsOfFieldsDoNotMatter) {
  const std::string name = "heat/thermistor.yaml";
  const ExampleRun known(name, {{"path:", method() + "\n  accuracy: 1e-4"}});
  const ExampleRun other(name, {{"path:", method() + "\n  accuracy: 1e-4"},
                                {"sigma0: 2, B: 4000, T0: 300, k: 2, h: 5.0e5",
                                 "sigma0: 2, B: 4.0e6, T0: 3.0e5, k: 2.0e-3, h: 500"}});
  EXPECT_NEAR(other.column("temperature").back(), 1e3 * known.column("temperature").back(), 1);
  const int steps = known.summary.at("steps"), others = other.summary.at("steps");
  EXPECT_GT(steps, 10);
  EXPECT_LE(std::abs(steps - others), 2) << others;
}

INSTANTIATE_TEST_SUITE_P(Kinds, NewtonMethod, testing::Values("newton", "modified_newton"),
                         [](const auto& info) { return std::string(info.param); });

}  // namespace
}  // namespace atrapos::test
