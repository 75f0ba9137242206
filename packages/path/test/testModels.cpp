#include <cmath>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "problems/Ends.hpp"
#include "problems/FollowedModel.hpp"

using namespace atrapos;
using path::Options;

namespace {

/// Every model, with default settings: starts in equilibrium, goes to its end, keeps the bound inside the
/// steps, leaves nothing unexplained.
TEST(Models, AllRunToTheirEndWithDefaultSettings) {
  const auto names = models::names();
  EXPECT_GE(names.size(), 10u);
  for (const auto& name : names) {
    FollowedModel f(name);
    EXPECT_EQ(f.outcome.reason, path::EndReason::stopReached) << name << ": " << f.outcome.text;
    EXPECT_LE(f.worstInside(), 1.01e-6) << name;  // 1 %: samples inside, the bound is kept at the ends
    EXPECT_FALSE(f.setup.monitors.empty()) << name;
    EXPECT_FALSE(f.setup.about.empty()) << name;
    int unexplained = 0;
    for (const auto& s : f.record.steps) unexplained += s.unexplained;
    EXPECT_EQ(unexplained, 0) << name;
    RecordProperty(name, f.outcome.steps);
  }
}

TEST(Models, UnknownNamesAndParametersAreRefused) {
  EXPECT_THROW(models::make("pendulum"), std::invalid_argument);
  EXPECT_THROW(models::make("pitchfork", {{"bent", 1}}), std::invalid_argument);
  EXPECT_THROW(models::make("euler_column", {{"links", 2.5}}), std::invalid_argument);
  try {
    models::make("stvk_bar", {{"EA", 1}});
    FAIL() << "accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "model problem 'stvk_bar': no parameter 'EA', only ");
  }
}

/// Symmetric limit points and the antisymmetric bifurcation, all in closed form.
TEST(Models, ShallowArchLosesItsSymmetryBeforeItsLimitPoint) {
  const double e = 4;
  Options options;
  options.delta = options.residualBound = 1e-10;
  FollowedModel f("shallow_arch", {{"rise", e}}, options);
  const auto points = criticalPoints(f.record);
  ASSERT_EQ(points.size(), 2u);
  for (int i = 0; i < 2; ++i) {
    const double q = (i == 0 ? 1 : -1) * std::sqrt(e * e - 8);
    EXPECT_EQ(points[i].kind, path::CriticalKind::pitchfork);
    EXPECT_NEAR(at(points[i].state, 0), q, 1e-10);  // rounding of stiffnesses up to 4^4
    EXPECT_NEAR(points[i].state.lambda, e - q - 0.5 * q * (q * q - e * e), 1e-10);
  }
  const auto limits = f.record.limitPoints();
  ASSERT_EQ(limits.size(), 2u);
  const double q = std::sqrt((e * e - 2) / 3);
  EXPECT_NEAR(limits[0].lambda, e - q - 0.5 * q * (q * q - e * e), 1e-8);  // residual bound over slopes
}

/// Reissner's frame from an independent shooting solution (reference table), all four folds.
TEST(Models, LeesFrameFollowsTheReference) {
  Options options;
  options.delta = options.residualBound = 1e-9;
  FollowedModel f("lee_frame", {{"elements", 20}}, options);
  EXPECT_EQ(f.outcome.reason, path::EndReason::stopReached) << f.outcome.text;
  const auto limits = f.record.limitPoints();
  ASSERT_EQ(limits.size(), 2u);
  // The reference prints seven digits.
  EXPECT_NEAR(limits[0].lambda, 1.855673, 1e-6);
  EXPECT_NEAR(limits[1].lambda, -0.941443, 1e-6);
  // Points of the table: at the same v (or u, where v folds) on the same part of the path.
  std::ifstream file(ATRAPOS_TEST_DATA "/lee_frame_axial.csv");
  std::vector<std::array<double, 3>> rows;
  for (std::string text; std::getline(file, text);) {
    for (char& c : text)
      if (c == ',') c = ' ';
    std::istringstream in(text);
    std::array<double, 3> row;
    if (in >> row[0] >> row[1] >> row[2] && row[0] != 0) rows.push_back(row);
  }
  ASSERT_GE(rows.size(), 20u);
  for (const auto& [P, u, v] : rows) {
    double best = 1e9;
    for (std::size_t s = 0; s < f.record.steps.size(); ++s) {
      const auto U = f.monitor(s, 0), V = f.monitor(s, 1);
      const auto lambda = f.record.series[s].lambdaFunction();
      for (const double a : U.minus(u).roots(f.record.steps[s].length))
        best = std::min(best, std::hypot(lambda(a) - P, V(a) - v));
    }
    EXPECT_LT(best, 2e-5) << P << ' ' << u << ' ' << v;  // eight digits of displacements up to 100
  }
}

}  // namespace
