#include <cmath>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include <gtest/gtest.h>

#include "atrapos/path/Branches.hpp"
#include "problems/Bifurcations.hpp"
#include "problems/Ends.hpp"
#include "problems/Record.hpp"

using namespace atrapos::path;

namespace {

/// Keeps what the branches look like.
struct Tree : BranchObserver {
  std::map<int, std::vector<std::pair<StepReport, Series>>> steps;
  bool onStep(int branch, const StepReport& report, const Series& series) override {
    steps[branch].emplace_back(report, series);
    return true;
  }
};

/// Keeps where a diagram can be gone on with, and the number of steps seen until then.
struct Interruptions : BranchObserver {
  struct Step {
    int branch = 0;
    StepReport report;
  };
  std::vector<Step> steps;
  std::vector<std::pair<BranchProgress, std::size_t>> places;
  bool onStep(int branch, const StepReport& report, const Series&) override {
    steps.push_back({branch, report});
    return true;
  }
  void onProgress(const BranchProgress& progress) override { places.emplace_back(progress, steps.size()); }
};

/// A diagram interrupted anywhere, between steps and between branches, goes on with the same bits.
template <class Law>
void expectGoesOnFromAnywhere(Law law, const std::vector<double>& u, double lambda, const Stops& stops) {
  Options options;
  options.maxSteps = 60;
  JetProblem<Law> problem(law);
  SymmetricDenseSolver solver;
  Interruptions whole;
  const BranchDiagram diagram =
      BranchFollower(problem, solver, options, stops, {}).run({problem.vector(u), lambda}, whole);
  ASSERT_GT(diagram.branches.size(), 1u);
  for (const auto& [place, seen] : whole.places) {
    SCOPED_TRACE(seen);
    JetProblem<Law> again(law);
    SymmetricDenseSolver other;
    Interruptions rest;
    BranchProgress progress = place;
    BranchFollower(again, other, options, stops, {}).goOn(progress, rest);
    ASSERT_EQ(rest.steps.size(), whole.steps.size() - seen);
    for (std::size_t i = 0; i < rest.steps.size(); ++i) {
      const auto &a = rest.steps[i], &b = whole.steps[seen + i];
      EXPECT_EQ(a.branch, b.branch);
      EXPECT_EQ(a.report.step, b.report.step);
      EXPECT_EQ(a.report.length, b.report.length);
      EXPECT_EQ(a.report.lambdaEnd, b.report.lambdaEnd);
      EXPECT_EQ(a.report.criticalPoints.size(), b.report.criticalPoints.size());
      for (std::size_t j = 0; j < a.report.end.u->getLocalLength(); ++j)
        EXPECT_EQ(a.report.end.u->getData()[j], b.report.end.u->getData()[j]);
    }
    ASSERT_EQ(progress.diagram.branches.size(), diagram.branches.size());
    ASSERT_EQ(progress.diagram.points.size(), diagram.points.size());
    for (std::size_t b = 0; b < diagram.branches.size(); ++b) {
      EXPECT_EQ(progress.diagram.branches[b].end, diagram.branches[b].end);
      EXPECT_EQ(progress.diagram.branches[b].outcome.reason, diagram.branches[b].outcome.reason);
      EXPECT_EQ(progress.diagram.branches[b].outcome.text, diagram.branches[b].outcome.text);
      EXPECT_EQ(progress.diagram.branches[b].outcome.steps, diagram.branches[b].outcome.steps);
    }
  }
}

template <class Law>
struct Traced {
  JetProblem<Law> problem;
  SymmetricDenseSolver solver;
  Tree tree;
  BranchDiagram diagram;
  Traced(Law law, std::vector<double> u, double lambda, Stops stops, BranchOptions branches = {},
         Options options = {})
      : problem(law) {
    options.maxSteps = 60;
    BranchFollower follower(problem, solver, options, stops, branches);
    diagram = follower.run({problem.vector(u), lambda}, tree);
    // Every factorization is accounted for.
    int all = diagram.switchFactorizations;
    for (const auto& b : diagram.branches) all += b.outcome.factorizations;
    EXPECT_EQ(solver.counters().factorizations, all);
  }
};

TEST(Branches, AnInterruptedDiagramGoesOnBitForBit) {
  SwayTruss sway;
  Stops stops;
  stops.functionals.push_back({"x", JetProblem<SwayTruss>(sway).vector({1, 0}), 2.2});
  expectGoesOnFromAnywhere(sway, {0, 0}, 0, stops);
  Modes pitchfork;
  pitchfork.bend = 0.3;
  expectGoesOnFromAnywhere(pitchfork, {0, 0}, 0, loads({0.9}));
}

/// The truss's swaying branch is one closed loop through both bifurcation points: followed once, not four
/// times.
TEST(Branches, ALoopThroughTwoPitchforksIsFollowedOnce) {
  SwayTruss law;
  JetProblem<SwayTruss> space(law);
  Stops stops;
  stops.functionals.push_back({"x", space.vector({1, 0}), 2.2});
  Traced<SwayTruss> t(law, {0, 0}, 0, stops);
  ASSERT_EQ(t.diagram.branches.size(), 2u);
  EXPECT_EQ(t.diagram.points.size(), 2u);
  EXPECT_TRUE(t.diagram.complete);
  EXPECT_EQ(t.diagram.branches[1].end, BranchEnd::joined);
  EXPECT_EQ(t.diagram.branches[1].parent, 0);
  EXPECT_LE(t.diagram.switchFactorizations, 2);
  // On it, with both bars at angle: lambda from equilibrium in y, (left)(y + b) + (right)(y - b) = 0. The
  // truss sways both ways.
  double least = 0, most = 0;
  for (const auto& [report, series] : t.tree.steps[1]) {
    EXPECT_LE(report.residual, 1e-6);
    least = std::min(least, at(report.end, 1));
    most = std::max(most, at(report.end, 1));
    // y^2 = 2x - x^2 - 2b^2 there: the branch's projection is a circle, exact to the residual bound.
    const double x = at(report.end, 0), y = at(report.end, 1);
    EXPECT_NEAR(y * y, 2 * x - x * x - 2 * law.b * law.b, 1e-5);
  }
  EXPECT_LT(least, -0.5);
  EXPECT_GT(most, 0.5);
}

/// A side force within the residual's bound turns the swaying branch off the pitchfork that it comes to,
/// where its load has a limit point: that is the point, and no eigenvalue is left to explain. (Otherwise it
/// goes back along the path that the point is on, with an eigenvalue that changes sign at no point found.)
TEST(Branches, OneThatTurnsBesideAPitchforkHasArrived) {
  const std::pair<double, double> cases[] = {{1e-9, 0.5}, {1e-9, 0.65}, {-1e-8, 0.5}, {-1e-8, 0.6}};
  for (const auto& [force, b] : cases) {
    SCOPED_TRACE(testing::Message() << force << ' ' << b);
    SwayTruss law;
    law.imperfection = force;
    law.b = b;
    JetProblem<SwayTruss> space(law);
    Stops stops;
    stops.functionals.push_back({"x", space.vector({1, 0}), 2.2});
    const Traced<SwayTruss> t(law, {0, 0}, 0, stops);
    EXPECT_EQ(t.diagram.points.size(), 2u);
    EXPECT_EQ(t.diagram.unexplained, 0);
    ASSERT_GE(t.diagram.branches.size(), 2u);
    EXPECT_EQ(t.diagram.branches[0].outcome.reason, EndReason::stopReached);
    for (std::size_t i = 1; i < t.diagram.branches.size(); ++i)
      EXPECT_EQ(t.diagram.branches[i].end, BranchEnd::joined) << i;
  }
}

/// lambda = 1/2 + (quartic - 1/2) x^2 turns away from the null vector within 1/quartic: starts of branches a
/// hundredth of the step away are on none of them.
TEST(Branches, OneThatBendsAtOnceIsFound) {
  for (const double quartic : {1e2, 1e4, 1e6}) {
    Modes law;
    law.quartic = quartic;
    Traced<Modes> t(law, {0, 0}, 0, loads({0.9}));
    ASSERT_EQ(t.diagram.branches.size(), 3u) << quartic;
    for (int b = 1; b <= 2; ++b) {
      const Branch& branch = t.diagram.branches[b];
      ASSERT_EQ(branch.end, BranchEnd::path) << quartic;
      EXPECT_EQ(branch.outcome.reason, EndReason::stopReached);
      const double x = at(branch.outcome.final, 1), exact = std::sqrt(0.4 / (quartic - 0.5));
      EXPECT_NEAR(std::abs(x), exact, 1e-5 * exact);  // half of the residual's bound, which is of the load
    }
    EXPECT_LT(at(t.diagram.branches[1].outcome.final, 1) * at(t.diagram.branches[2].outcome.final, 1), 0);
  }
}

TEST(Branches, OnlyStableOnesOnRequest) {
  SwayTruss sway;
  JetProblem<SwayTruss> space(sway);
  Stops stops;
  stops.functionals.push_back({"x", space.vector({1, 0}), 2.2});
  BranchOptions options;
  options.follow = Follow::stable;
  Traced<SwayTruss> unstable(sway, {0, 0}, 0, stops, options);
  for (std::size_t i = 1; i < unstable.diagram.branches.size(); ++i) {
    EXPECT_EQ(unstable.diagram.branches[i].end, BranchEnd::notStable);
    EXPECT_EQ(unstable.diagram.branches[i].outcome.steps, 0);
  }
  Modes stable;
  stable.bend = 0.3;
  Traced<Modes> t(stable, {0, 0}, 0, loads({2}), options);
  ASSERT_EQ(t.diagram.branches.size(), 3u);
  for (int i : {1, 2}) {
    const auto& b = t.diagram.branches[i];
    EXPECT_EQ(b.end, BranchEnd::path);
    EXPECT_EQ(b.outcome.reason, EndReason::stopReached);
    for (const auto& [report, series] : t.tree.steps[i]) EXPECT_EQ(report.inertia->negative, 0);
    // v = 1/2 + x^2, lambda = v + 0.3 v^2 - x^2/2 = 2.
    const double x = at(b.outcome.final, 1), v = 0.5 + x * x;
    EXPECT_NEAR(at(b.outcome.final, 0), v, 1e-6);
    EXPECT_NEAR(v + 0.3 * v * v - 0.5 * x * x, 2, 1e-6);
  }
  EXPECT_LT(at(t.diagram.branches[1].outcome.final, 1) * at(t.diagram.branches[2].outcome.final, 1), 0);
  options.follow = Follow::none;
  Traced<Modes> none(stable, {0, 0}, 0, loads({2}), options);
  EXPECT_EQ(none.diagram.branches.size(), 1u);
  EXPECT_EQ(none.diagram.points.size(), 1u);
}

/// Two modes: two primary pitchforks, and a secondary one on each half of the first branch.
TEST(Branches, TreeOfTwoModes) {
  Modes law;
  law.bend = 0.3;
  law.crossing = {0.5, 0.9};
  Traced<Modes> t(law, {0, 0, 0}, 0, loads({3, -1}));
  EXPECT_EQ(t.diagram.points.size(), 4u);
  ASSERT_EQ(t.diagram.branches.size(), 9u);
  std::multiset<int> depths;
  std::set<std::pair<long, long>> ends;  // no two branches end at the same state
  for (const auto& b : t.diagram.branches) {
    depths.insert(b.depth);
    EXPECT_EQ(b.outcome.reason, EndReason::stopReached) << b.outcome.text;
    ends.insert({std::lround(1e3 * at(b.outcome.final, 1)), std::lround(1e3 * at(b.outcome.final, 2))});
    if (b.parent < 0) continue;
    EXPECT_LT(b.parent, static_cast<int>(t.diagram.branches.size()));
    EXPECT_EQ(b.depth, t.diagram.branches[b.parent].depth + 1);
  }
  EXPECT_EQ(depths.count(0), 1u);
  EXPECT_EQ(depths.count(1), 4u);
  EXPECT_EQ(depths.count(2), 4u);
  EXPECT_EQ(ends.size(), 9u);
  EXPECT_LE(t.diagram.switchFactorizations, 2 * 8);  // two a branch

  BranchOptions shallow;
  shallow.maxDepth = 1;
  Traced<Modes> limited(law, {0, 0, 0}, 0, loads({3, -1}), shallow);
  EXPECT_EQ(limited.diagram.branches.size(), 5u);
  EXPECT_FALSE(limited.diagram.complete);
}

TEST(Branches, TranscriticalBranchGoesBothWays) {
  Modes law;
  law.bend = 0.3;
  law.cubic = 1;
  Traced<Modes> t(law, {0, 0}, 0, loads({2, -1}));
  ASSERT_EQ(t.diagram.branches.size(), 3u);
  double product = 1;
  for (int i : {1, 2}) {
    EXPECT_EQ(t.diagram.branches[i].outcome.reason, EndReason::stopReached);
    const auto& first = t.tree.steps[i].front().first;
    product *= at(first.end, 1);
    for (const auto& [report, series] : t.tree.steps[i]) {
      const double x = at(report.end, 1);
      EXPECT_NEAR(at(report.end, 0), 0.5 + x + x * x, 1e-5);  // residual bound over the smallest slope
    }
  }
  EXPECT_LT(product, 0);
}

/// (u - 2)^2 + (lambda - 2)^2 / 4 = 1 by itself.
struct Isola : NoInternal {
  int size() const { return 1; }
  template <class S>
  std::vector<S> residual(const std::vector<S>& u, const S& lambda) const {
    const S x = u[0] - 2, y = lambda - 2;
    return {x * x + 0.25 * y * y - 1};
  }
};

TEST(Branches, AnIsolaIsAClosedLoop) {
  Traced<Isola> t(Isola{}, {2 - std::sqrt(0.75)}, 3, loads({100}));
  ASSERT_EQ(t.diagram.branches.size(), 1u);
  EXPECT_EQ(t.diagram.branches[0].end, BranchEnd::closed) << t.diagram.branches[0].outcome.text;
  int limits = 0;
  for (const auto& [report, series] : t.tree.steps[0]) limits += static_cast<int>(report.limitPoints.size());
  EXPECT_GE(limits, 2);
  EXPECT_LE(limits, 3);  // the last step may go past its start
  EXPECT_LE(t.diagram.branches[0].outcome.steps, 30);
  EXPECT_TRUE(t.diagram.points.empty());
}

/// P / P_cr at the given tip rotations (degrees) on the first post-buckling branch.
std::vector<double> postBuckling(int n, const std::vector<double>& degrees, double sense) {
  Column law;
  law.n = n;
  Traced<Column> t(law, std::vector<double>(n + 1, 0.0), 0, loads({7}));
  std::vector<double> ratios;
  // The rotation is flat at the free end: parabola through the last two links.
  std::vector<double> tip(n + 1, 0.0), axial(n + 1, 0.0);
  tip[n] = 9.0 / 8;
  tip[n - 1] = -1.0 / 8;
  const auto w = t.problem.vector(tip);
  auto u = t.problem.vector({});
  for (const double a : degrees)
    for (std::size_t b = 1; b < t.diagram.branches.size(); ++b) {
      if (t.diagram.branches[b].point != 0) continue;
      for (const auto& [report, series] : t.tree.steps[b])
        for (const double root : series.functional(*w).minus(sense * a * M_PI / 180).roots(report.length)) {
          const double lambda = series.evaluate(root, *u);
          ratios.push_back(lambda * (1 + u->getData()[0]) / (M_PI * M_PI / 4));
        }
    }
  return ratios;
}

/// Both post-buckling branches against the elastica, to the order of the discretisation and one
/// extrapolation.
TEST(Branches, BothBucklingBranchesOfAColumnAreTheElastica) {
  std::ifstream file(ATRAPOS_TEST_DATA "/euler_column_postbuckling.csv");
  std::vector<double> degrees, exact;
  for (std::string text; std::getline(file, text);) {
    for (char& c : text)
      if (c == ',') c = ' ';
    std::istringstream in(text);
    double a, ratio;
    if (in >> a >> ratio && a >= 10 && a <= 100) {
      degrees.push_back(a);
      exact.push_back(ratio);
    }
  }
  ASSERT_GE(degrees.size(), 9u);
  for (const double sense : {1.0, -1.0}) {
    const auto coarse = postBuckling(6, degrees, sense), fine = postBuckling(12, degrees, sense);
    ASSERT_EQ(coarse.size(), degrees.size());
    ASSERT_EQ(fine.size(), degrees.size());
    for (std::size_t i = 0; i < degrees.size(); ++i) {
      const double error = std::abs(fine[i] - exact[i]);
      EXPECT_NEAR(std::log2(std::abs(coarse[i] - exact[i]) / error), 2, 0.15) << degrees[i];
      // One extrapolation leaves h^4 = 5e-5 times a constant of order 1.
      EXPECT_NEAR((4 * fine[i] - coarse[i]) / 3, exact[i], 2e-4) << degrees[i];
    }
  }
}

}  // namespace
