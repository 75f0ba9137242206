// Stability where the tangent is not symmetric: eigenvalues counted, changes located.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include <Teuchos_LAPACK.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Vector.hpp>

#include "atrapos/linear/MakeTangentSolver.hpp"
#include "atrapos/path/Branches.hpp"
#include "problems/Bifurcations.hpp"
#include "problems/Ends.hpp"
#include "problems/Record.hpp"

using namespace atrapos;
using namespace atrapos::path;

namespace {

std::unique_ptr<linear::TangentSolver> mumps() {
  linear::TangentSolverOptions options;
  options.symmetric = false;
  return linear::makeTangentSolver(options);
}

/// All eigenvalues of the tangent that have a negative real part, by LAPACK.
template <class Law>
int unstable(JetProblem<Law>& problem, const State& state) {
  auto F = problem.vector({});
  const auto K = problem.tangent(state, *F);
  const int n = problem.law().size();
  std::vector<double> A(n * n, 0.0), real(n), imaginary(n), work(4 * n);
  for (int i = 0; i < n; ++i) {
    Teuchos::ArrayView<const int> columns;
    Teuchos::ArrayView<const double> values;
    K->getLocalRowView(i, columns, values);
    for (int j = 0; j < columns.size(); ++j) A[columns[j] * n + i] = values[j];
  }
  int info = 0;
  Teuchos::LAPACK<int, double>().GEEV('N', 'N', n, A.data(), n, real.data(), imaginary.data(), nullptr, 1,
                                      nullptr, 1, work.data(), 4 * n, &info);
  EXPECT_EQ(info, 0);
  return static_cast<int>(std::count_if(real.begin(), real.end(), [](double x) { return x < 0; }));
}

template <class Law>
struct FollowedUnsymmetric {
  JetProblem<Law> problem;
  std::unique_ptr<linear::TangentSolver> solver = mumps();
  Record record;
  Outcome outcome;

  FollowedUnsymmetric(Law law, double loadFactor, Options options = {}) : problem(law) {
    Stops stops = loads({loadFactor});
    outcome = PathFollower(problem, *solver, options, stops).run({problem.vector({}), 0}, record);
    EXPECT_EQ(outcome.reason, EndReason::stopReached) << outcome.text;
  }

  /// The counts of the path are those of LAPACK at the steps' ends and between them.
  void compare() {
    auto u = problem.vector({});
    for (std::size_t s = 0; s < record.steps.size(); ++s) {
      const auto& step = record.steps[s];
      ASSERT_TRUE(step.inertia && step.inertiaEnd);
      EXPECT_EQ(step.inertiaEnd->negative, unstable(problem, step.end)) << "step " << step.step;
      for (const double part : {0.25, 0.5, 0.75}) {
        const double lambda = record.series[s].evaluate(part * step.length, *u);
        const auto told = step.negativeAt(part * step.length);
        ASSERT_TRUE(told);
        EXPECT_EQ(*told, unstable(problem, {u, lambda})) << "step " << step.step << ", " << part;
      }
    }
  }
};

Column column(int links, double follow) {
  Column law;
  law.n = links;
  law.follow = follow;
  return law;
}

/// Divergence of a column under a load that follows in part, 10 links (all eigenvalues) and 90
/// (Krylov-Schur): a real eigenvalue crosses zero at each closed-form load. With a third of the load both do
/// in one step; with more of it one goes and comes back, which the numbers at the ends of one step do not
/// show.
TEST(Stability, ALoadThatFollowsInPart) {
  for (const int links : {10, 90})
    for (const double follow : {1.0 / 3, 0.45}) {
      const Column law = column(links, follow);
      Options options;
      if (follow > 0.4) options.maxStep = 8;
      FollowedUnsymmetric<Column> f(law, 1.02 * law.buckling(2), options);
      f.compare();
      const auto points = criticalPoints(f.record);
      ASSERT_EQ(points.size(), 2u) << links << ' ' << follow;
      for (int m = 1; m <= 2; ++m) {
        // Refined to rounding; K is of size links^2, its eigenvalues next to zero of size 1.
        EXPECT_NEAR(points[m - 1].state.lambda, law.buckling(m), 1e-9 * law.buckling(m));
        EXPECT_EQ(points[m - 1].kind, CriticalKind::pitchfork);
      }
      EXPECT_EQ(points[0].negativeChange, 1);
      EXPECT_EQ(f.record.steps.front().inertia->negative, 0);
      EXPECT_LE(f.outcome.criticalFactorizations, 4);  // two a point
    }
}

/// Beyond a half nothing crosses zero: no buckling, and none is told, although pairs of eigenvalues meet and
/// turn complex on the way.
TEST(Stability, ALoadThatFollowsMoreThanHalf) {
  const Column law = column(90, 0.6);
  FollowedUnsymmetric<Column> f(law, 20);
  f.compare();
  EXPECT_TRUE(criticalPoints(f.record).empty());
  EXPECT_EQ(f.outcome.criticalFactorizations, 0);
}

/// x' = -R has a spiral: the pair a(lambda) +- i b crosses the imaginary axis without a bifurcation of
/// equilibria. Told as two eigenvalues, no point, no search.
struct Spiral : NoInternal {
  double crossing = 0.5, turn = 2;
  int size() const { return 3; }
  bool symmetric() const { return false; }
  template <class S>
  std::vector<S> residual(const std::vector<S>& u, const S& lambda) const {
    const S a = crossing - u[0], squares = u[1] * u[1] + u[2] * u[2];
    return {u[0] - lambda + 0.1 * u[0] * u[0], a * u[1] - turn * u[2] + squares * u[1],
            turn * u[1] + a * u[2] + squares * u[2]};
  }
};

TEST(Stability, APairThatCrossesTheImaginaryAxis) {
  FollowedUnsymmetric<Spiral> f(Spiral{}, 2);
  ASSERT_FALSE(f.record.steps.empty());
  EXPECT_EQ(f.record.steps.front().inertia->negative, 0);
  EXPECT_EQ(f.record.steps.back().inertiaEnd->negative, 2);
  EXPECT_TRUE(criticalPoints(f.record).empty());
  EXPECT_EQ(f.outcome.criticalFactorizations, 0);
  for (const auto& step : f.record.steps) {
    EXPECT_EQ(step.unexplained, 0);
    // Where inside its step it crosses is not known, and not told.
    const bool inside = step.inertia->negative != step.inertiaEnd->negative;
    EXPECT_EQ(step.negativeAt(0.5 * step.length).has_value(), !inside);
    EXPECT_EQ(step.negativeAt(step.length), step.inertiaEnd->negative);
  }
}

/// Without eigenvalues watched nothing is told, and nothing is paid.
TEST(Stability, CanBeLeftOut) {
  Options options;
  options.watchedModes = 0;
  FollowedUnsymmetric<Column> f(column(90, 0.25), 2, options), g(column(90, 0.25), 2);
  for (const auto& step : f.record.steps) EXPECT_FALSE(step.inertia);
  EXPECT_EQ(f.outcome.closings, 0);
  // Some 15 solves a place.
  EXPECT_LE(g.outcome.solves - f.outcome.solves, 40 * (g.outcome.steps + 1));
}

/// Branches of an unsymmetric problem: both halves of the first buckling branch, on which the column stays
/// stable.
TEST(Stability, BranchesOfAnUnsymmetricProblem) {
  const Column law = column(20, 1.0 / 3);
  JetProblem<Column> problem(law);
  const auto solver = mumps();
  struct Watch : BranchObserver {
    std::vector<std::vector<StepReport>> steps;
    bool onStep(int branch, const StepReport& report, const Series&) override {
      steps.resize(std::max<std::size_t>(steps.size(), branch + 1));
      steps[branch].push_back(report);
      return true;
    }
  } watch;
  Stops stops = loads({1.1 * law.buckling(1)});
  BranchFollower follower(problem, *solver, Options{}, stops, {});
  const auto diagram = follower.run({problem.vector({}), 0}, watch);
  ASSERT_EQ(diagram.branches.size(), 3u);
  for (int b = 1; b <= 2; ++b) {
    EXPECT_EQ(diagram.branches[b].outcome.reason, EndReason::stopReached);
    EXPECT_EQ(unstable(problem, diagram.branches[b].outcome.final), 0);
    for (const auto& step : watch.steps[b]) EXPECT_EQ(step.inertiaEnd->negative, 0);
  }
  EXPECT_EQ(watch.steps[0].back().inertiaEnd->negative, 1);
}

}  // namespace
