// Hopf points: pairs of eigenvalues that cross the imaginary axis, against closed forms.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "atrapos/linear/MakeTangentSolver.hpp"
#include "problems/Bifurcations.hpp"
#include "problems/Ends.hpp"
#include "problems/Record.hpp"

using namespace atrapos;
using namespace atrapos::path;

namespace {

/// Cells of the Brusselator, u' = A - (B + 1) u + u^2 v, v' = B u - u^2 v with B = lambda, that exchange both
/// species with their neighbours. The rest state u = A, v = B/A of the mode with the coupling's eigenvalue q
/// has a trace that vanishes at B = 1 + q + (A^2 + q) m_u/m_v, with M = diag(m_u, m_v) in each.
struct Brusselators : NoInternal {
  int cells = 1;
  double A = 2, exchange = 0, massU = 1, massV = 1;
  bool algebraic = false;  ///< a further unknown of each cell, w = u^2, that has no rate
  int each() const { return algebraic ? 3 : 2; }
  int size() const { return each() * cells; }
  double scale() const { return 1; }
  bool symmetric() const { return false; }
  std::vector<double> rateWeights() const {
    std::vector<double> m;
    for (int i = 0; i < cells; ++i) {
      m.insert(m.end(), {massU, massV});
      if (algebraic) m.push_back(0);
    }
    return m;
  }
  template <class S>
  std::vector<S> residual(const std::vector<S>& x, const S& B) const {
    const int n = each();
    std::vector<S> r;
    for (int i = 0; i < cells; ++i) {
      const S u = x[n * i], v = x[n * i + 1];
      const S square = algebraic ? x[n * i + 2] : u * u;
      S ru = (B + 1) * u - square * v - S(A), rv = square * v - B * u;
      for (const int j : {i - 1, i + 1})
        if (j >= 0 && j < cells) {
          ru = ru + exchange * (u - x[n * j]);
          rv = rv + exchange * (v - x[n * j + 1]);
        }
      r.push_back(ru);
      r.push_back(rv);
      if (algebraic) r.push_back(square - u * u);
    }
    return r;
  }

  /// Eigenvalue of the coupling: a chain with free ends.
  double coupling(int mode) const { return exchange * 4 * std::pow(std::sin(M_PI * mode / (2 * cells)), 2); }
  double critical(int mode) const {
    const double q = coupling(mode);
    return 1 + q + (A * A + q) * massU / massV;
  }
  double frequency(int mode) const {
    const double q = coupling(mode), B = critical(mode);
    return std::sqrt(((1 - B + q) * (A * A + q) + A * A * B) / (massU * massV));
  }
  std::vector<double> rest(double B) const {
    std::vector<double> x;
    for (int i = 0; i < cells; ++i) {
      x.insert(x.end(), {A, B / A});
      if (algebraic) x.push_back(A * A);
    }
    return x;
  }
};

struct FollowedHopf {
  JetProblem<Brusselators> problem;
  std::unique_ptr<linear::TangentSolver> solver;
  Record record;
  Outcome outcome;
  std::vector<HopfPoint> points;

  FollowedHopf(const Brusselators& law, double from, double to, Options options = withHopf()) : problem(law) {
    linear::TangentSolverOptions unsymmetric;
    unsymmetric.symmetric = false;
    solver = linear::makeTangentSolver(unsymmetric);
    options.direction = to > from ? 1 : -1;
    Stops stops = loads({to});
    outcome =
        PathFollower(problem, *solver, options, stops).run({problem.vector(law.rest(from)), from}, record);
    EXPECT_EQ(outcome.reason, EndReason::stopReached) << outcome.text;
    for (const auto& s : record.steps) points.insert(points.end(), s.hopfPoints.begin(), s.hopfPoints.end());
  }
  static Options withHopf() {
    Options options;
    options.hopfEigenvalues = 6;
    return options;
  }
};

// Eigenvalues have 1e-8 of themselves, and their real parts change by about as much as the parameter does.
constexpr double tolerance = 1e-7;

TEST(Hopf, OfOneBrusselatorInBothDirections) {
  for (const double A : {0.7, 2.0})
    for (const bool forward : {true, false}) {
      Brusselators law;
      law.A = A;
      const double B = 1 + A * A;
      const FollowedHopf f(law, forward ? 0.5 * B : 1.3 * B, forward ? 1.3 * B : 0.5 * B);
      ASSERT_EQ(f.points.size(), 1u) << A << forward;
      const HopfPoint& point = f.points.front();
      EXPECT_NEAR(point.state.lambda, B, tolerance * B);
      EXPECT_NEAR(point.frequency, A, tolerance * A);
      EXPECT_EQ(point.negativeChange, forward ? 2 : -2);
      EXPECT_LT(point.uncertainty, 1e-6);
      EXPECT_TRUE(criticalPoints(f.record).empty());
      // The flag changes right at the point.
      for (const auto& step : f.record.steps)
        for (const auto& p : step.hopfPoints) {
          EXPECT_EQ(step.negativeAt(p.a - 1e-5 * step.length), forward ? 0 : 2);
          EXPECT_EQ(step.negativeAt(p.a + 1e-5 * step.length), forward ? 2 : 0);
        }
      EXPECT_LE(f.outcome.hopfFactorizations, 10);
    }
}

/// Rates of other weights move the point and the frequency; an unknown without a rate does not.
TEST(Hopf, MassesCount) {
  for (const bool algebraic : {false, true}) {
    Brusselators law;
    law.massU = 0.5;
    law.massV = 2;
    law.algebraic = algebraic;
    const FollowedHopf f(law, 1, 4);
    ASSERT_EQ(f.points.size(), 1u) << algebraic;
    EXPECT_NEAR(f.points[0].state.lambda, 1 + 4 * 0.25, tolerance);
    EXPECT_NEAR(f.points[0].frequency, 2, tolerance);
  }
}

/// Many pairs in a step, by LAPACK (20 unknowns) and by Krylov and Schur (80 and 120 unknowns, the latter
/// with a singular mass).
TEST(Hopf, OfAChainOfCells) {
  for (const auto& [cells, algebraic] : {std::pair{10, false}, {40, false}, {40, true}}) {
    Brusselators law;
    law.cells = cells;
    law.algebraic = algebraic;
    law.exchange = 0.002 * cells * cells;
    const double end = 0.5 * (law.critical(3) + law.critical(4));
    const FollowedHopf f(law, 3, end);
    ASSERT_EQ(f.points.size(), 4u) << cells;
    for (int mode = 0; mode < 4; ++mode) {
      EXPECT_NEAR(f.points[mode].state.lambda, law.critical(mode), tolerance * law.critical(mode));
      EXPECT_NEAR(f.points[mode].frequency, law.frequency(mode), tolerance * law.frequency(mode));
    }
    EXPECT_EQ(f.record.steps.back().inertiaEnd->negative, 8);
  }
}

/// Cells that know nothing of each other lose their stability at once: one point.
TEST(Hopf, TwoPairsAtOnce) {
  Brusselators law;
  law.cells = 2;
  const FollowedHopf f(law, 3, 6);
  ASSERT_EQ(f.points.size(), 1u);
  EXPECT_NEAR(f.points[0].state.lambda, 5, tolerance * 5);
  EXPECT_EQ(f.points[0].negativeChange, 4);
}

/// A real eigenvalue that crosses zero is no Hopf point, and costs nothing here.
TEST(Hopf, DivergenceIsNone) {
  Column law;
  law.n = 20;
  law.follow = 1.0 / 3;
  Stops stops = loads({1.02 * law.buckling(1)});
  JetProblem<Column> problem(law);
  linear::TangentSolverOptions unsymmetric;
  unsymmetric.symmetric = false;
  const auto solver = linear::makeTangentSolver(unsymmetric);
  Record record;
  const auto outcome =
      PathFollower(problem, *solver, FollowedHopf::withHopf(), stops).run({problem.vector({}), 0}, record);
  EXPECT_EQ(criticalPoints(record).size(), 1u);
  EXPECT_EQ(outcome.hopfFactorizations, 0);
}

/// Two velocities that a pressure p keeps equal, x' = (lambda - 1) x - x^3 + p - lambda, y' = -3 y - p +
/// lambda, 0 = x - y: rest, with p = lambda, is stable up to lambda = 4. The pressure's part of the null
/// vectors is larger than all others, with one sign on the left and the other on the right, and has no rate.
struct Constrained : NoInternal {
  int size() const { return 3; }
  double scale() const { return 1; }
  bool symmetric() const { return false; }
  std::vector<double> rateWeights() const { return {1, 1, 0}; }
  template <class S>
  std::vector<S> residual(const std::vector<S>& u, const S& lambda) const {
    const S &x = u[0], &y = u[1], &p = u[2];
    return {S(x - lambda * x + x * x * x - p + lambda), S(3.0 * y + p - lambda), S(x - y)};
  }
};

TEST(Hopf, SenseOfAPitchforkByWhatHasRates) {
  JetProblem<Constrained> problem((Constrained()));
  linear::TangentSolverOptions unsymmetric;
  unsymmetric.symmetric = false;
  const auto solver = linear::makeTangentSolver(unsymmetric);
  for (const bool up : {true, false}) {
    Options options = FollowedHopf::withHopf();
    options.direction = up ? 1 : -1;
    Stops stops = loads({up ? 5.0 : 3.0});
    Record record;
    const double start = up ? 3 : 5;
    const auto outcome =
        PathFollower(problem, *solver, options, stops).run({problem.vector({0, 0, start}), start}, record);
    EXPECT_EQ(outcome.reason, EndReason::stopReached) << outcome.text;
    const auto points = criticalPoints(record);
    ASSERT_EQ(points.size(), 1u);
    EXPECT_NEAR(points[0].state.lambda, 4, tolerance * 4);
    EXPECT_EQ(points[0].negativeChange, up ? 1 : -1);
    for (const auto& step : record.steps) EXPECT_EQ(step.unexplained, 0);
  }
}

/// Not asked for: nothing is paid, and the pair is counted as before.
TEST(Hopf, NotAskedFor) {
  Brusselators law;
  const FollowedHopf f(law, 3, 6, Options{});
  EXPECT_TRUE(f.points.empty());
  EXPECT_EQ(f.outcome.hopfFactorizations, 0);
  EXPECT_EQ(f.record.steps.back().inertiaEnd->negative, 2);
}

}  // namespace
