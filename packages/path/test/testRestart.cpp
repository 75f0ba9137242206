#include <cmath>

#include <gtest/gtest.h>

#include "../src/BestOrder.hpp"
#include "../src/FieldSizes.hpp"
#include "../src/GeometricProgression.hpp"
#include "problems/Bifurcations.hpp"
#include "problems/Ends.hpp"
#include "problems/Record.hpp"

using namespace atrapos::path;

namespace {

/// A path that goes on from what a step left behind has the same bits as the one that was not interrupted.
TEST(Restart, GoesOnBitForBitFromEveryStep) {
  const TrussOnSpring law{0.3};
  JetProblem<TrussOnSpring> problem(law);
  Stops stops;
  stops.functionals.push_back({"x", problem.vector({1, 0}), 2.2});
  Followed<TrussOnSpring, SymmetricDenseSolver> whole(law, {0, 0}, 0, Options{}, stops);
  const auto& all = whole.record.steps;
  ASSERT_GT(all.size(), 8u);
  for (std::size_t s = 0; s + 1 < all.size(); s += 3) {
    JetProblem<TrussOnSpring> again(law);
    SymmetricDenseSolver solver;
    Record record;
    const Outcome outcome = PathFollower(again, solver, Options{}, stops).runFrom(all[s].next, record);
    EXPECT_EQ(outcome.reason, EndReason::stopReached);
    ASSERT_EQ(record.steps.size(), all.size() - s - 1);
    for (std::size_t i = 0; i < record.steps.size(); ++i) {
      const auto &a = record.steps[i], &b = all[s + 1 + i];
      EXPECT_EQ(a.step, b.step);
      EXPECT_EQ(a.length, b.length);
      EXPECT_EQ(a.lambdaEnd, b.lambdaEnd);
      EXPECT_EQ(a.pathLengthEnd, b.pathLengthEnd);
      EXPECT_EQ(a.residual, b.residual);
      for (int j = 0; j < 2; ++j) EXPECT_EQ(a.end.u->getData()[j], b.end.u->getData()[j]);
    }
  }
}

/// The order of least cost solves (K-1)^2 = ln(1/delta) (F/S + K), to the rounding of K.
TEST(BestOrder, IsTheOneOfTheFormula) {
  for (const double ratio : {1.0, 10.0, 30.0})
    for (const double delta : {1e-4, 1e-6, 1e-8}) {
      const int K = bestOrder(ratio, 1, delta);
      const auto balance = [&](double k) { return (k - 1) * (k - 1) - std::log(1 / delta) * (ratio + k); };
      if (K < 40) {
        EXPECT_LT(balance(K - 1), 0) << ratio;
        EXPECT_GT(balance(K + 1), 0) << ratio;
      }
    }
  EXPECT_EQ(bestOrder(1e6, 1, 1e-6), 40);
  EXPECT_GT(bestOrder(100, 1, 1e-6), bestOrder(1, 1, 1e-6));
}

TEST(BestOrder, IsUsedWhileRunning) {
  Options options;
  options.autoOrder = true;
  options.order = 7;
  options.fewerOrders =
      false;  // else a step with an end near, which the clock decides here, has fewer than 5
  JetProblem<TrussOnSpring> problem(TrussOnSpring{0.3});
  Stops stops;
  stops.functionals.push_back({"x", problem.vector({1, 0}), 2.2});
  Followed<TrussOnSpring> f(TrussOnSpring{0.3}, {0, 0}, 0, options, stops);
  EXPECT_EQ(f.outcome.reason, EndReason::stopReached);
  EXPECT_EQ(f.record.steps[0].order, 7);
  bool changed = false;
  for (const auto& s : f.record.steps) {
    EXPECT_GE(s.order, 5);
    EXPECT_LE(s.order, 40);
    changed = changed || s.order != 7;
  }
  EXPECT_TRUE(changed);
  EXPECT_LE(f.worstInside(), 1.01e-6);  // 1 % over the bound: samples inside, the bound is kept at the ends
}

/// U_p = a_c^-p v + 3^-p u: the progression with a_c shows in the late terms, ahead and behind.
TEST(GeometricProgression, IsRecognisedAheadAndBehind) {
  JetProblem<Bratu> space(Bratu{3});
  for (const double ac : {0.8, -0.8}) {
    Series s({space.vector({0, 0, 0}), 0}, 1), decaying({space.vector({0, 0, 0}), 0}, 1);
    for (int p = 1; p <= 30; ++p) {
      const double g = 1e-6 * std::pow(ac, -p), r = std::pow(3.0, -p);
      auto u = space.vector({g + r, 2 * g, g - r}), v = space.vector({r, p * r, std::cos(p) * r});
      s.append({u, {}}, 0, u->norm2());
      decaying.append({v, {}}, 0, v->norm2());
    }
    const auto found = geometricProgression(space, s, 1e-6, 1e-3);
    ASSERT_TRUE(found);
    EXPECT_NEAR(*found, ac, 1e-8);  // (0.8/3)^30 / 1e-6 = 6e-12
    EXPECT_FALSE(geometricProgression(space, decaying, 1e-6, 1e-3));
  }
}

/// Steps that approach a bifurcation point on the branch that leaves it: the residual would turn the path
/// onto the other branch little by little, every step of it within the bound.
TEST(BranchJump, TheSideBranchIsKeptThroughItsPitchfork) {
  Modes law;
  law.bend = 0.3;
  int passed = 0;
  for (const int order : {10, 15, 20, 30})
    for (const double delta : {1e-4, 1e-6, 1e-8})
      for (const auto use : {PadeUse::off, PadeUse::automatic}) {
        Options options;
        options.order = order;
        options.delta = options.residualBound = delta;
        options.pade = use;
        options.direction = -1;
        options.maxSteps = 200;
        JetProblem<Modes> problem(law);
        Stops stops;
        stops.functionals.push_back({"x", problem.vector({0, 1}), -0.6});
        const double x = 0.5, v = 0.5 + x * x;
        Followed<Modes, SymmetricDenseSolver> f(law, {v, x}, v + 0.3 * v * v - 0.5 * x * x, options, stops);
        EXPECT_EQ(f.outcome.reason, EndReason::stopReached) << order << ' ' << delta << f.outcome.text;
        for (const auto& s : f.record.steps) {
          const auto u = s.end.u->getData();
          // On v = 1/2 + x^2, off by the residual (scale 0.1) over the tangent, which is small next to the
          // point.
          EXPECT_NEAR(u[0], 0.5 + u[1] * u[1], 20 * std::sqrt(delta) * 0.1) << order << ' ' << delta;
        }
        passed += criticalPoints(f.record).size() == 1;
      }
  EXPECT_GE(passed, 22);  // of 24 runs found and located the point that all of them passed
}

/// Branches 1e-3 apart: the imperfect pitchfork's own branch is kept at every order and accuracy.
TEST(BranchJump, BranchesAThousandthApartAreNotMixed) {
  Modes law;
  law.bend = 0.3;
  law.imperfection = 1e-3;
  for (const int order : {5, 10, 20, 30})
    for (const double delta : {1e-4, 1e-6, 1e-8})
      for (const auto use : {PadeUse::off, PadeUse::automatic}) {
        Options options;
        options.order = order;
        options.delta = options.residualBound = delta;
        options.pade = use;
        options.maxSteps = 2000;
        Stops stops = loads({2});
        Followed<Modes, SymmetricDenseSolver> f(law, {0, 0}, -2e-6, options, stops);
        EXPECT_EQ(f.outcome.reason, EndReason::stopReached) << order << ' ' << delta << f.outcome.text;
        EXPECT_GT(f.final(1), 1) << order << ' ' << delta;  // 1.106; 0 or -1.105 on the others
        for (const auto& s : f.record.steps) EXPECT_GT(s.end.u->getData()[1], -1e-5);
        EXPECT_TRUE(criticalPoints(f.record).empty());
      }
}

/// Both sways of a truss with a short unstable stretch lie in one step, and cancel in the count of
/// eigenvalues.
TEST(WatchedModes, ShowPointsThatCancelInTheCount) {
  SwayTruss law;
  law.b = 0.705;
  JetProblem<SwayTruss> problem(law);
  Stops stops;
  stops.functionals.push_back({"x", problem.vector({1, 0}), 2.2});
  int runs = 0, blindRuns = 0;
  for (const int order : {10, 15, 20, 30})
    for (const double delta : {1e-4, 1e-6, 1e-8}) {
      Options options;
      options.order = order;
      options.delta = options.residualBound = delta;
      options.pade = PadeUse::off;  // its range is bounded by the eigenvalues followed
      Followed<SwayTruss, SymmetricDenseSolver> f(law, {0, 0}, 0, options, stops);
      const auto points = criticalPoints(f.record);
      ASSERT_EQ(points.size(), 2u) << order << ' ' << delta;
      EXPECT_LE(f.outcome.criticalFactorizations, 4);
      for (int i = 0; i < 2; ++i)
        EXPECT_NEAR(points[i].state.u->getData()[0], 1 + (i == 0 ? -1 : 1) * std::sqrt(1 - 2 * law.b * law.b),
                    1e-12);
      options.watchedModes = 0;
      Followed<SwayTruss, SymmetricDenseSolver> blind(law, {0, 0}, 0, options, stops);
      EXPECT_EQ(f.outcome.steps, blind.outcome.steps);
      blindRuns += criticalPoints(blind.record).size() == 2;
      ++runs;
    }
  EXPECT_LT(blindRuns, runs);  // the count alone does not see them everywhere
}

/// Fields that have moved count alike, and together as the load factor: w sum_b c_b s_b^2 = s_lambda^2. Units
/// that are powers of two change nothing of that.
TEST(FieldSizes, CountAlikeInAnyUnits) {
  EXPECT_TRUE(FieldSizes().factors(2).empty());
  FieldSizes one;
  one.moved({3, 0}, 0.25);
  EXPECT_TRUE(one.factors(2).empty());  // nothing to weigh it against
  one.moved({1, 512}, -0.5);            // the largest of each
  EXPECT_EQ(one.sizes(), (std::vector<double>{3, 512, 0.5}));
  constexpr double w = 2;
  const double s[2] = {2, 512};  // 3 counts as a power of two near it
  const auto c = one.factors(w);
  ASSERT_EQ(c.size(), 2u);
  EXPECT_DOUBLE_EQ(w * (c[0] * s[0] * s[0] + c[1] * s[1] * s[1]), 0.25);
  EXPECT_DOUBLE_EQ(c[0] * s[0] * s[0], c[1] * s[1] * s[1]);
  FieldSizes other;
  other.moved({3 * 1024.0, 0.5, 0}, 0.5);
  const auto d = other.factors(w);
  EXPECT_DOUBLE_EQ(d[0] * 1024 * 1024, c[0]);
  EXPECT_DOUBLE_EQ(d[1] / (1024.0 * 1024), c[1]);
  EXPECT_EQ(d[2], 1);  // has not moved
}

}  // namespace
