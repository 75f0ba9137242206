#include <cmath>

#include <gtest/gtest.h>

#include "problems/Bifurcations.hpp"
#include "problems/Ends.hpp"
#include "problems/Record.hpp"

using namespace atrapos::path;

namespace {

template <class Law>
using Symmetric = Followed<Law, SymmetricDenseSolver>;

/// What holds for every path with critical points.
template <class F>
void expectSound(const F& f) {
  EXPECT_EQ(f.outcome.reason, EndReason::stopReached) << f.outcome.text;
  EXPECT_EQ(f.outcome.factorizations, f.outcome.steps + f.outcome.corrections + f.outcome.retreats +
                                          f.outcome.closings + f.outcome.criticalFactorizations);
  EXPECT_EQ(f.solver.counters().factorizations, f.outcome.factorizations);
  for (const auto& s : f.record.steps) EXPECT_EQ(s.unexplained, 0) << s.step;
  for (const auto& p : criticalPoints(f.record)) EXPECT_LE(p.uncertainty, 1e-8);
}

TEST(Critical, SwayOfTheTrussBeforeAtAndBehindItsLimitPoint) {
  const double together = std::sqrt(1.0 / 3);  // both eigenvalues of the tangent vanish at one state
  for (const double b : {0.5, together, 0.65})
    for (const auto use : {PadeUse::off, PadeUse::automatic}) {
      Options options;
      options.pade = use;
      SwayTruss law;
      law.b = b;
      Symmetric<SwayTruss> f(law, {0, 0}, 0, options, unknown(law, 0, 2.2));
      expectSound(f);
      const auto points = criticalPoints(f.record);
      ASSERT_EQ(points.size(), 2u) << b;
      EXPECT_EQ(f.record.limitPoints().size(), 2u);
      EXPECT_LE(f.outcome.criticalFactorizations, 4);  // two a point
      for (int i = 0; i < 2; ++i) {
        const double x = 1 + (i == 0 ? -1 : 1) * std::sqrt(1 - 2 * b * b);
        // Newton converges on the extended system itself: the residual bound of the path does not count.
        EXPECT_NEAR(at(points[i].state, 0), x, 1e-12);
        EXPECT_NEAR(points[i].state.lambda, x * (1 - x) * (2 - x), 1e-12);
        EXPECT_EQ(points[i].kind, b == together ? CriticalKind::hilltop : CriticalKind::pitchfork);
        ASSERT_EQ(points[i].tangents.size(), 2u);
        // The path goes on in x, the other branch starts in y.
        EXPECT_NEAR(points[i].tangents[0].x.u->getData()[1], 0, 1e-9);
        EXPECT_GT(points[i].tangents[0].x.u->getData()[0], 0.1);
        EXPECT_NEAR(points[i].tangents[1].x.u->getData()[0], 0, 1e-9);
        EXPECT_NEAR(points[i].tangents[1].lambda, 0, 1e-9);
      }
    }
}

/// lambda = v on the trivial path, v = 1/2 + x + x^2 on the other: both slopes are known.
TEST(Critical, TranscriticalPointAndItsTangents) {
  Modes law;
  law.cubic = 1;
  Symmetric<Modes> f(law, {0, 0}, 0, Options{}, loads({2}));
  expectSound(f);
  const auto points = criticalPoints(f.record);
  ASSERT_EQ(points.size(), 1u);
  EXPECT_EQ(points[0].kind, CriticalKind::transcritical);
  EXPECT_NEAR(points[0].state.lambda, 0.5, 1e-12);
  const auto& t = points[0].tangents.at(1);
  // lambda = v - x^2/2: dv/dx = dlambda/dx = 1.
  EXPECT_NEAR(t.x.u->getData()[0] / t.x.u->getData()[1], 1, 1e-9);
  EXPECT_NEAR(t.lambda / t.x.u->getData()[1], 1, 1e-9);
  EXPECT_LE(f.outcome.criticalFactorizations, 2);
}

/// On the branch that leaves a pitchfork no eigenvalue changes sign; lambda turns there.
TEST(Critical, PitchforkApproachedFromTheSideBranch) {
  Modes law;
  law.bend = 0.3;
  Options options;
  options.direction = -1;
  const double x = 0.5, v = 0.5 + x * x;
  Symmetric<Modes> f(law, {v, x}, v + 0.3 * v * v - 0.5 * x * x, options, unknown(law, 1, -0.6));
  expectSound(f);
  for (const auto& s : f.record.steps) EXPECT_EQ(s.inertia->negative, 0);
  const auto points = criticalPoints(f.record);
  ASSERT_EQ(points.size(), 1u);
  EXPECT_EQ(points[0].kind, CriticalKind::pitchfork);
  EXPECT_NEAR(at(points[0].state, 0), 0.5, 1e-12);
  EXPECT_NEAR(at(points[0].state, 1), 0, 1e-12);
  EXPECT_NEAR(points[0].state.lambda, 0.575, 1e-12);
  EXPECT_NEAR(points[0].tangents[0].lambda, 0, 1e-9);  // that of the path, which turns
  EXPECT_GT(std::abs(points[0].tangents[1].lambda), 0.1);
  EXPECT_LE(f.outcome.criticalFactorizations, 2);
}

TEST(Critical, TwoEigenvaluesThatVanishTogether) {
  Modes law;
  law.crossing = {0.5, 0.5};
  law.bend = 0.3;
  Symmetric<Modes> f(law, {0, 0, 0}, 0, Options{}, loads({2}));
  expectSound(f);
  const auto points = criticalPoints(f.record);
  ASSERT_EQ(points.size(), 1u);
  EXPECT_EQ(points[0].kind, CriticalKind::multiple);
  EXPECT_EQ(points[0].nullity, 2);
  EXPECT_NEAR(points[0].state.lambda, 0.575, 1e-8);
  ASSERT_EQ(points[0].nullVectors.size(), 2u);
  for (const auto& phi : points[0].nullVectors) EXPECT_NEAR(phi->getData()[0], 0, 1e-9);
  EXPECT_LE(f.outcome.criticalFactorizations, 2);
}

TEST(Critical, TwoPointsAThousandthApartAreTwo) {
  Modes law;
  law.crossing = {0.5, 0.501};
  law.bend = 0.3;
  Symmetric<Modes> f(law, {0, 0, 0}, 0, Options{}, loads({2}));
  expectSound(f);
  const auto points = criticalPoints(f.record);
  ASSERT_EQ(points.size(), 2u);
  EXPECT_LE(f.outcome.criticalFactorizations, 2);  // for both
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(points[i].kind, CriticalKind::pitchfork);
    EXPECT_NEAR(at(points[i].state, 0), law.crossing[i], 1e-12);
    EXPECT_GT(std::abs(points[i].tangents[1].x.u->getData()[1 + i]), 0.1);  // each has its own mode
  }
}

/// A fold is no bifurcation, and an imperfection above the residual bound keeps the branches apart.
TEST(Critical, NothingIsReportedWithoutEvidence) {
  Symmetric<Truss> fold(Truss{}, {0}, 0, Options{}, unknown(Truss{}, 0, 2.2));
  expectSound(fold);
  EXPECT_EQ(fold.record.limitPoints().size(), 2u);
  EXPECT_TRUE(criticalPoints(fold.record).empty());
  EXPECT_EQ(fold.outcome.criticalFactorizations, 0);
  for (const double imperfection : {1e-5, 1e-3}) {
    Modes law;
    law.imperfection = imperfection;
    law.bend = 0.3;
    Symmetric<Modes> f(law, {0, 0}, -imperfection * imperfection * 2, Options{}, loads({2}));
    EXPECT_EQ(f.outcome.reason, EndReason::stopReached);
    EXPECT_TRUE(criticalPoints(f.record).empty()) << imperfection;
    // The stable side of the imperfect pitchfork is followed: x > 0 and large.
    EXPECT_GT(f.final(1), 1);
  }
}

/// The discrete column's buckling loads are known in closed form; the second lies beyond the first.
TEST(Critical, BucklingLoadsOfAColumn) {
  for (const int n : {4, 20}) {
    Column law;
    law.n = n;
    std::vector<double> zero(n + 1, 0.0);
    const double second = law.buckling(2);
    Symmetric<Column> f(law, zero, 0, Options{}, loads({1.05 * second}));
    expectSound(f);
    const auto points = criticalPoints(f.record);
    ASSERT_EQ(points.size(), 2u);
    EXPECT_NEAR(points[0].state.lambda, law.buckling(1), 1e-10);  // rounding of loads of 25 and springs of n
    EXPECT_NEAR(points[1].state.lambda, second, 1e-10);
    for (const auto& p : points) EXPECT_EQ(p.kind, CriticalKind::pitchfork);
    // The mode of the first is sin((i - 1/2) pi/2n).
    const auto mode = points[0].tangents[1].x.u->getData();
    for (int i = 1; i <= n; ++i)
      EXPECT_NEAR(mode[i] / mode[n],
                  std::sin((i - 0.5) * M_PI / (2 * n)) / std::sin((n - 0.5) * M_PI / (2 * n)), 1e-8);
  }
}

/// The count inside the steps against the eigenvalues of the 2 x 2 tangent of the perfect truss, which is
/// diagonal: (1 - x)(2 - x) - x (2 - x) - x (1 - x) and x^2 - 2x + 2b^2.
TEST(Stability, CountsInsideStepsAreThoseOfTheTangent) {
  for (const auto use : {PadeUse::off, PadeUse::automatic}) {
    Options options;
    options.pade = use;
    SwayTruss law;
    Symmetric<SwayTruss> f(law, {0, 0}, 0, options, unknown(law, 0, 2.2));
    auto u = f.problem.vector({});
    int known = 0, asked = 0;
    for (std::size_t s = 0; s < f.record.steps.size(); ++s)
      for (int i = 0; i <= 50; ++i) {
        const double a = f.record.steps[s].length * i / 50;
        f.record.series[s].evaluate(a, *u);
        const double x = u->getData()[0];
        const double sink = 3 * x * x - 6 * x + 2, sway = x * x - 2 * x + 2 * law.b * law.b;
        if (std::abs(sink) < 1e-5 || std::abs(sway) < 1e-5)
          continue;  // within the path's accuracy of the change
        ++asked;
        const auto n = f.record.steps[s].negativeAt(a);
        if (!n) continue;
        ++known;
        EXPECT_EQ(*n, (sink < 0) + (sway < 0)) << "x = " << x;
      }
    EXPECT_EQ(known, asked);
  }
}

/// Buckling loads as those of a square box, in every cluster a double one and two single ones so near that
/// the sides hardly know of each other: 32 eigenvalues in one step, of which three are followed.
TEST(Critical, ClustersOfManyInOneStep) {
  Modes law;
  law.crossing.clear();
  std::vector<double> known;
  for (int wave = 1; wave <= 8; ++wave) {
    const double load = 0.1 + 0.01 * wave * wave, apart = wave % 2 == 0 ? 2e-5 : 2e-4;
    law.crossing.insert(law.crossing.end(), {load, load, load * (1 + apart), load * (1 + 1.3 * apart)});
    known.insert(known.end(), {load, load * (1 + apart), load * (1 + 1.3 * apart)});
  }
  std::vector<double> start(law.size(), 0.0);
  Symmetric<Modes> f(law, start, 0, Options{}, loads({0.8}));
  expectSound(f);
  ASSERT_EQ(f.outcome.steps, 1);
  const auto points = criticalPoints(f.record);
  ASSERT_EQ(points.size(), known.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_NEAR(points[i].state.lambda, known[i], 1e-10);
    EXPECT_EQ(points[i].nullity, i % 3 == 0 ? 2 : 1);
  }
  EXPECT_LE(f.outcome.criticalFactorizations, 2 * 32);
}

/// The search tells how far it is.
TEST(Critical, ALongSearchTellsItsProgress) {
  struct Listening : Observer {
    std::vector<std::pair<int, int>> told;
    bool onStep(const StepReport&, const Series&) override { return true; }
    void onSearch(int found, int wanted) override { told.emplace_back(found, wanted); }
  } observer;
  Modes law;
  law.crossing = {0.3, 0.4, 0.4, 0.5, 0.5001, 0.6};
  JetProblem<Modes> problem(law);
  SymmetricDenseSolver solver;
  PathFollower(problem, solver, Options{}, loads({0.8})).run({problem.vector({}), 0}, observer);
  ASSERT_FALSE(observer.told.empty());
  for (std::size_t i = 0; i < observer.told.size(); ++i) {
    EXPECT_EQ(observer.told[i].second, 6);
    if (i > 0) {
      EXPECT_GE(observer.told[i].first, observer.told[i - 1].first);
    }
  }
  EXPECT_EQ(observer.told.back().first, 6);
}

}  // namespace
