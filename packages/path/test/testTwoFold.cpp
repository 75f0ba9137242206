#include <cmath>

#include <gtest/gtest.h>

#include "../src/TwoFold.hpp"
#include "atrapos/path/Branches.hpp"
#include "problems/FollowedModel.hpp"
#include "problems/Galerkin.hpp"

using namespace atrapos;
using namespace atrapos::path;

namespace {

/// (c_0 - 2 c_1) c_0 c_1 (c_0 + c_1) has four directions; c_0^2 + c_1^2 none; c_1^2 one.
TEST(TwoFold, RootsOfBinaryForms) {
  const auto has = [](const std::vector<std::array<double, 2>>& roots, double x, double y) {
    for (const auto& c : roots)
      if (std::abs(c[0] * y - c[1] * x) < 1e-12 * std::hypot(x, y)) return true;
    return false;
  };
  const auto four = rootsOfForm({0, 1, -1, -2, 0});
  EXPECT_EQ(four.size(), 4u);
  EXPECT_TRUE(has(four, 2, 1) && has(four, 0, 1) && has(four, 1, 0) && has(four, 1, -1));
  EXPECT_TRUE(rootsOfForm({1, 0, 1}).empty());
  EXPECT_EQ(rootsOfForm({0, 0, 1}).size(), 1u);
  EXPECT_TRUE(rootsOfForm({0, 0, 0}).empty());
}

/// The tangents at the only bifurcation point of a model, that of the path left out.
std::vector<PathTangent> otherTangents(const std::string& name, const models::Parameters& parameters,
                                       CriticalPoint* point = nullptr) {
  FollowedModel f(name, parameters);
  EXPECT_EQ(f.outcome.reason, EndReason::stopReached) << f.outcome.text;
  EXPECT_LE(f.outcome.criticalFactorizations, 2);
  const auto points = criticalPoints(f.record);
  EXPECT_EQ(points.size(), 1u);
  if (points.size() != 1) return {};
  EXPECT_EQ(points[0].kind, CriticalKind::multiple);
  EXPECT_EQ(points[0].nullity, 2);
  if (point) *point = points[0];
  auto t = points[0].tangents;
  if (!t.empty()) t.erase(t.begin());
  return t;
}

/// Symmetry of the square: no quadratic terms; x y (x^2 - y^2) = 0 gives four branches whatever a and b.
TEST(TwoFold, ASquareHasFourBranches) {
  for (const double other : {0.5, 2.0, -0.3}) {
    CriticalPoint point;
    const auto tangents = otherTangents("square_plate", {{"other", other}}, &point);
    EXPECT_NEAR(point.state.lambda, 0.575, 1e-7);  // on the path's series: the residual bound over the slope
    ASSERT_EQ(tangents.size(), 4u);
    int pure = 0, diagonal = 0;
    for (const auto& t : tangents) {
      const auto u = t.x.u->getData();
      EXPECT_NEAR(t.lambda, 0, 1e-6);
      EXPECT_NEAR(u[0], 0, 1e-6);
      const double x = std::abs(u[1]), y = std::abs(u[2]), size = std::hypot(x, y);
      // Directions are as good as the null vectors, a straight line's zero away from the point.
      pure += std::min(x, y) < 1e-4 * size;
      diagonal += std::abs(x - y) < 1e-4 * size;
    }
    EXPECT_EQ(pure, 2);
    EXPECT_EQ(diagonal, 2);
  }
}

/// All eight half-branches of the square, each once, each on its closed form.
TEST(TwoFold, TheSquaresBranchesAreFollowed) {
  const SquareModes law;
  const auto problem = models::make("square_plate");
  auto setup = models::setup("square_plate", {}, *problem);
  SymmetricDenseSolver solver;
  struct Watch : BranchObserver {
    bool onStep(int, const StepReport&, const Series&) override { return true; }
  } watch;
  Options options;
  options.maxSteps = 60;
  BranchFollower follower(*problem, solver, options, setup.stops, {});
  const auto diagram = follower.run(setup.start, watch);
  ASSERT_EQ(diagram.branches.size(), 9u);
  EXPECT_LE(diagram.switchFactorizations, 2 * 8);
  int pure = 0, diagonal = 0;
  for (std::size_t i = 1; i < diagram.branches.size(); ++i) {
    const auto& branch = diagram.branches[i];
    ASSERT_EQ(branch.outcome.reason, EndReason::stopReached) << branch.outcome.text;
    const auto u = branch.outcome.final.u->getData();
    const double x = u[1], y = u[2], v = u[0] - law.crossing;
    // (x, 0): x^2 = v / a; (x, +-x): x^2 = v / (a + b); to the residual bound over the smallest stiffness.
    const bool onAxis = std::min(std::abs(x), std::abs(y)) < 1e-4;
    pure += onAxis;
    diagonal += !onAxis;
    EXPECT_NEAR(x * x + y * y, onAxis ? v / law.a : 2 * v / (law.a + law.b), 1e-5);
  }
  EXPECT_EQ(pure, 4);
  EXPECT_EQ(diagonal, 4);
}

/// Equal buckling loads of two modes on a foundation. With a cubic foundation w^4 couples the modes as
/// (q_1^4 + q_2^4) 3/8 + q_1^2 q_2^2 3/2: a_1 q_1^2 + 2 a_1 q_2^2 = n^2 tau has no mixed solution, two
/// branches. With a quadratic one the branches q_1 /= 0 follow from the integrals of sin^3 x and sin x sin^2
/// 2x.
TEST(TwoFold, AStrutWithEqualBucklingLoads) {
  CriticalPoint point;
  const auto cubic = otherTangents("strut_on_foundation", {}, &point);
  EXPECT_NEAR(point.state.lambda, 5, 1e-7);
  ASSERT_EQ(cubic.size(), 2u);
  for (const auto& t : cubic) {
    const auto u = t.x.u->getData();
    EXPECT_LT(std::min(std::abs(u[1]), std::abs(u[2])), 1e-4 * std::hypot(u[1], u[2]));
  }

  const double k2 = 1;
  const auto quadratic = otherTangents("strut_on_foundation", {{"quadratic", k2}}, &point);
  // Residual: (1 - lambda') q_1 .. : -thrust' q_1 + c_1 q_1^2 + c_2 q_2^2 = 0, -4 thrust' q_2 + 2 c_2 q_1 q_2
  // = 0 with c_1, c_2 those of the midpoint rule; q_2 = 0 or q_1 = 2 thrust' / c_2.
  const StrutOnFoundation law;
  const int points = 2 * law.modes + 2;
  double c1 = 0, c2 = 0;
  for (int j = 0; j < points; ++j) {
    const double x = M_PI * (j + 0.5) / points;
    c1 += 2.0 / points * k2 * std::pow(std::sin(x), 3);
    c2 += 2.0 / points * k2 * std::sin(x) * std::pow(std::sin(2 * x), 2);
  }
  // q_1 = thrust'/c_1, q_2 = 0; and q_1 = 2 thrust'/c_2, c_2 q_2^2 = q_1 (thrust' - c_1 q_1) where positive.
  const double square = (2 / c2) * (1 - 2 * c1 / c2) / c2;
  ASSERT_EQ(quadratic.size(), square > 0 ? 3u : 1u);
  for (const auto& t : quadratic) {
    const auto u = t.x.u->getData();
    const double thrust = t.lambda;  // EA (s - D) = lambda
    const bool single = std::abs(u[2]) < 1e-4 * std::abs(u[1]);
    EXPECT_NEAR(u[1] / thrust, single ? 1 / c1 : 2 / c2, 1e-3);  // null vectors 5e-5 of a step aside
    if (!single) {
      EXPECT_NEAR(u[2] * u[2] / (thrust * thrust), square, 1e-3);
    }
  }
}

/// More null vectors than two: the point is told with all of them, the path goes on along its own branch, and
/// none of the others is followed.
TEST(TwoFold, ThreeModesAtOnceArePassed) {
  FollowedModel f("three_modes", {});
  EXPECT_EQ(f.outcome.reason, EndReason::stopReached) << f.outcome.text;
  const auto points = criticalPoints(f.record);
  ASSERT_EQ(points.size(), 1u);
  EXPECT_EQ(points[0].kind, CriticalKind::multiple);
  EXPECT_EQ(points[0].nullity, 3);
  EXPECT_EQ(points[0].negativeChange, 3);
  EXPECT_TRUE(points[0].tangents.empty());
  // On the path's series: the residual bound over the slope.
  EXPECT_NEAR(points[0].state.lambda, 0.575, 1e-7);
  EXPECT_LE(f.outcome.criticalFactorizations, 2);
  for (const auto& step : f.record.steps) EXPECT_EQ(step.unexplained, 0);
  for (int i = 1; i <= 3; ++i) EXPECT_NEAR(f.outcome.final.u->getData()[i], 0, 1e-6);
  EXPECT_EQ(f.record.steps.back().inertiaEnd->negative, 3);
  // The null vectors span the three modes.
  double common = 0;
  for (const auto& phi : points[0].nullVectors)
    for (int i = 1; i <= 3; ++i) common += std::pow(phi->getData()[i], 2);
  EXPECT_NEAR(common, 3, 1e-6);  // as good as inverse iterations at 5e-5 of the step from the point
}

}  // namespace
