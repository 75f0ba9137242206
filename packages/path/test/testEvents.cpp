#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "problems/Bifurcations.hpp"
#include "problems/Ends.hpp"
#include "problems/Record.hpp"
#include "problems/UnilateralProblem.hpp"

using namespace atrapos::path;

namespace {

/// Followed with events.
template <class Body>
struct Moved {
  UnilateralProblem<Body> problem;
  SymmetricDenseSolver solver;
  Record record;
  Outcome outcome;
  Moved(Body body, std::vector<double> stops, double end, Options options = {})
      : problem(WithStops<Body>(body, stops)) {
    Stops at = loads({end});
    options.maxSteps = 60;
    outcome = PathFollower(problem, solver, options, at).run({problem.vector({}), 0}, record);
    EXPECT_EQ(solver.counters().factorizations, outcome.factorizations);
    EXPECT_EQ(outcome.factorizations, outcome.steps + outcome.corrections + outcome.retreats +
                                          outcome.closings + outcome.criticalFactorizations +
                                          outcome.eventTrials);
  }
  double final(int i) const { return outcome.final.u->getData()[i]; }
  /// The steps that ended with an event.
  std::vector<StepReport> events() const {
    std::vector<StepReport> all;
    for (const auto& s : record.steps)
      if (!s.events.empty()) all.push_back(s);
    return all;
  }
  /// Nothing passes a stop or is pulled by it, anywhere inside the steps.
  void expectAdmissible(double tolerance) {
    auto u = problem.vector({});
    const int m = problem.law().masses();
    for (std::size_t s = 0; s < record.steps.size(); ++s)
      for (int j = 0; j <= 20; ++j) {
        record.series[s].evaluate(record.steps[s].length * j / 20, *u);
        for (int i = 0; i < m; ++i) {
          EXPECT_LE(u->getData()[i], problem.law().stops[i] + tolerance);
          EXPECT_GE(u->getData()[m + i], -tolerance);
        }
      }
  }
};

/// One mass on a hardening spring, u + u^3 = lambda.
struct OneMass : NoInternal {
  template <class S>
  std::vector<S> forces(const std::vector<S>& u, const S& lambda) const {
    return {u[0] + u[0] * u[0] * u[0] - lambda};
  }
};

TEST(Events, AMassMeetsItsStop) {
  Moved<OneMass> f(OneMass{}, {1}, 3);
  EXPECT_EQ(f.outcome.reason, EndReason::stopReached) << f.outcome.text;
  ASSERT_EQ(f.events().size(), 1u);
  EXPECT_NEAR(f.events()[0].lambdaEnd, 2, 1e-6);  // 1 + 1, to the residual bound
  EXPECT_EQ(f.events()[0].events, std::vector<int>{0});
  EXPECT_NEAR(f.final(0), 1, 1e-7);
  EXPECT_NEAR(f.final(1), 1, 1e-6);  // the rest of the load
  EXPECT_EQ(f.outcome.events, 1);
  EXPECT_EQ(f.outcome.eventTrials, 0);
  f.expectAdmissible(1e-6);
  // The multiplier's negative pivot is not an instability.
  for (const auto& s : f.record.steps) EXPECT_EQ(s.inertia->negative, 0);
  for (const auto& s : f.record.steps) EXPECT_TRUE(s.limitPoints.empty());
}

/// The truss x (1 - x)(2 - x) = lambda, falling after its limit point, meets a stop at x = 1.2: x stays and
/// the load rises again. A limit point without a horizontal tangent.
struct TrussBody : NoInternal {
  template <class S>
  std::vector<S> forces(const std::vector<S>& u, const S& lambda) const {
    return {u[0] * (1 - u[0]) * (2 - u[0]) - lambda};
  }
};

TEST(Events, ThePathTurnsAtAStop) {
  Moved<TrussBody> f(TrussBody{}, {1.2}, 1.0);
  EXPECT_EQ(f.outcome.reason, EndReason::stopReached) << f.outcome.text;
  const double least = 1.2 * -0.2 * 0.8;
  const auto limits = f.record.limitPoints();
  ASSERT_EQ(limits.size(), 2u);
  EXPECT_TRUE(limits[0].smooth);
  EXPECT_TRUE(limits[0].maximum);
  EXPECT_NEAR(limits[0].lambda, 0.384900179459750, 1e-7);
  EXPECT_FALSE(limits[1].smooth);
  EXPECT_FALSE(limits[1].maximum);
  EXPECT_NEAR(limits[1].lambda, least, 1e-6);
  EXPECT_NEAR(f.final(0), 1.2, 1e-7);
  EXPECT_NEAR(f.final(1), 1.0 - least, 1e-6);
  // Held by the stop the truss is stable where it was not.
  EXPECT_EQ(f.events().at(0).inertia->negative, 1);
  EXPECT_EQ(f.record.steps.back().inertia->negative, 0);
  f.expectAdmissible(1e-6);
}

/// Two masses and a spring between them; the load on the first turns quadratic with lambda so that it comes
/// off.
struct ComesOff : NoInternal {
  template <class S>
  std::vector<S> forces(const std::vector<S>& u, const S& lambda) const {
    return {2 * u[0] - u[1] - 3 * lambda + lambda * lambda, 2 * u[1] - u[0] - 0.1 * lambda};
  }
};

TEST(Events, AMassTouchesAndComesOffAgain) {
  Moved<ComesOff> f(ComesOff{}, {1, 10}, 2.9);
  EXPECT_EQ(f.outcome.reason, EndReason::stopReached) << f.outcome.text;
  // Free: u_0 = (2 (3 l - l^2) + 0.1 l)/3 = 1 twice.
  const double root = std::sqrt(6.1 * 6.1 - 24), on = (6.1 - root) / 4, off = (6.1 + root) / 4;
  const auto events = f.events();
  ASSERT_EQ(events.size(), 2u);
  EXPECT_NEAR(events[0].lambdaEnd, on, 1e-6);
  EXPECT_NEAR(events[1].lambdaEnd, off, 1e-6);
  EXPECT_NEAR(f.final(2), 0, 1e-12);
  EXPECT_NEAR(f.final(0), (2 * (3 * 2.9 - 2.9 * 2.9) + 0.29) / 3, 1e-6);
  f.expectAdmissible(1e-6);
}

/// K u = lambda f with K = [2, -1.5; -1.5, 2].
struct TwoMasses : NoInternal {
  double f0 = 1, f1 = 1;
  template <class S>
  std::vector<S> forces(const std::vector<S>& u, const S& lambda) const {
    return {2 * u[0] - 1.5 * u[1] - f0 * lambda, 2 * u[1] - 1.5 * u[0] - f1 * lambda};
  }
};

TEST(Events, EventsThatCoincideAreAppliedTogether) {
  Moved<TwoMasses> f(TwoMasses{}, {2, 2}, 3);  // u_0 = u_1 = 2 lambda
  EXPECT_EQ(f.outcome.reason, EndReason::stopReached) << f.outcome.text;
  ASSERT_EQ(f.events().size(), 1u);
  EXPECT_EQ(f.events()[0].events.size(), 2u);
  EXPECT_NEAR(f.events()[0].lambdaEnd, 1, 1e-9);
  EXPECT_NEAR(f.final(2), 2, 1e-6);  // R = lambda f - K u = 3 - 1
  EXPECT_NEAR(f.final(3), 2, 1e-6);
  EXPECT_EQ(f.outcome.eventTrials, 0);
}

/// Both gaps vanish at lambda = 1, but the stop of the first alone moves the second mass away from its own.
TEST(Events, OfTwoThatCoincideOnlyOneMayBeAdmissible) {
  TwoMasses body;
  body.f1 = -0.2;
  Moved<TwoMasses> f(body, {1.7 / 1.75, 1.1 / 1.75}, 3);
  EXPECT_EQ(f.outcome.reason, EndReason::stopReached) << f.outcome.text;
  ASSERT_EQ(f.events().size(), 1u);
  EXPECT_EQ(f.events()[0].events, std::vector<int>{0});
  EXPECT_GE(f.outcome.eventTrials, 1);  // both together were tried first
  EXPECT_NEAR(f.final(3), 0, 1e-12);
  EXPECT_NEAR(f.final(1), 1.1 / 1.75 - 0.1 * 2, 1e-6);  // 2 u_1 = 1.5 u_0 - 0.2 lambda
  EXPECT_GT(f.final(2), 0);
  f.expectAdmissible(1e-6);
}

/// Twelve masses in a row, each on a spring of its own and with springs between them: more events at once
/// than all choices of them could be tried.
struct Row : NoInternal {
  static constexpr int n = 12;
  std::vector<double> load = {1, 0.6, -0.4, 0.9, 1.2, -0.7, -0.1, 0.8, 0.5, -0.3, 1.1, 0.2};
  template <class S>
  std::vector<S> forces(const std::vector<S>& u, const S& lambda) const {
    std::vector<S> r;
    for (int i = 0; i < n; ++i) {
      S f = 3 * u[i] - load[i] * lambda;
      if (i > 0) f = f - 1.2 * u[i - 1];
      if (i + 1 < n) f = f - 1.2 * u[i + 1];
      r.push_back(f);
    }
    return r;
  }
  /// u of the row pressed against stops, by projected Gauss-Seidel (converges: the matrix is positive
  /// definite).
  std::vector<double> against(const std::vector<double>& stops, double lambda) const {
    std::vector<double> u(n, 0.0);
    for (int sweep = 0; sweep < 2000; ++sweep)
      for (int i = 0; i < n; ++i) {
        const double neighbours = (i > 0 ? u[i - 1] : 0) + (i + 1 < n ? u[i + 1] : 0);
        u[i] = std::min(stops[i], (load[i] * lambda + 1.2 * neighbours) / 3);
      }
    return u;
  }
};

TEST(Events, TwelveThatCoincide) {
  const Row row;
  // Where the free row is at lambda = 1; a mass that goes the other way has its stop far off.
  std::vector<double> stops = row.against(std::vector<double>(Row::n, 1e9), 1);
  int together = 0;
  for (double& s : stops) {
    if (s > 0)
      ++together;
    else
      s = 10;
  }
  ASSERT_GT(together, 6);
  Moved<Row> f(row, stops, 2);
  EXPECT_EQ(f.outcome.reason, EndReason::stopReached) << f.outcome.text;
  const auto expected = row.against(stops, 2);
  for (int i = 0; i < Row::n; ++i) EXPECT_NEAR(f.final(i), expected[i], 1e-6) << i;  // residual bound
  EXPECT_LE(f.outcome.eventTrials, together);
  f.expectAdmissible(1e-6);
}

/// All masses touch at the start; some come off at once, the others are pressed.
TEST(Events, AStartThatTouches) {
  const Row row;
  const std::vector<double> stops(Row::n, 0.0);
  Moved<Row> f(row, stops, 2);
  EXPECT_EQ(f.outcome.reason, EndReason::stopReached) << f.outcome.text;
  const auto expected = row.against(stops, 2);
  int touching = 0;
  for (int i = 0; i < Row::n; ++i) {
    EXPECT_NEAR(f.final(i), expected[i], 1e-6) << i;
    touching += expected[i] == 0;
  }
  EXPECT_GT(touching, 3);
  EXPECT_LT(touching, Row::n);
  EXPECT_EQ(f.problem.constraintPivots(), touching);
  f.expectAdmissible(1e-6);
}

/// Interrupted at any step, also between a root and the change that it brings, and taken up again with the
/// Problem in the condition that it was in: the same bits.
TEST(Events, ARestartKeepsTheirBits) {
  struct Steps final : Observer {
    std::vector<StepReport> steps;
    bool onStep(const StepReport& report, const Series&) override {
      steps.push_back(report);
      return true;
    }
  };
  Stops stops = loads({2.9});
  const auto follow = [&](UnilateralProblem<ComesOff>& problem, const Start& start, int maxSteps,
                          Steps& seen) {
    SymmetricDenseSolver solver;
    Options options;
    options.maxSteps = maxSteps;
    return PathFollower(problem, solver, options, stops).runFrom(start, seen);
  };
  const WithStops<ComesOff> body(ComesOff{}, {1, 10});
  UnilateralProblem<ComesOff> whole(body);
  Start start;
  start.state = {whole.vector({}), 0};
  Steps all;
  EXPECT_EQ(follow(whole, start, 100, all).reason, EndReason::stopReached);
  ASSERT_GE(all.steps.size(), 3u);
  const auto same = [&](const Steps& rest, std::size_t first) {
    ASSERT_EQ(rest.steps.size() + first, all.steps.size());
    for (std::size_t i = 0; i < rest.steps.size(); ++i) {
      const auto &a = rest.steps[i], &b = all.steps[first + i];
      EXPECT_EQ(a.length, b.length);
      EXPECT_EQ(a.lambdaEnd, b.lambdaEnd);
      EXPECT_EQ(a.events, b.events);
      for (int j = 0; j < 4; ++j) EXPECT_EQ(a.end.u->getData()[j], b.end.u->getData()[j]);
    }
  };
  for (std::size_t s = 0; s + 1 < all.steps.size(); ++s) {
    UnilateralProblem<ComesOff> again(body);
    Steps rest;
    follow(again, all.steps[s].next, 100, rest);
    same(rest, s + 1);
    // The limit of steps ends a path before its events are applied.
    UnilateralProblem<ComesOff> part(body);
    Steps head;
    EXPECT_EQ(follow(part, start, static_cast<int>(s) + 1, head).reason, EndReason::stepLimit);
    Steps tail;
    follow(part, head.steps.back().next, 100, tail);
    same(tail, s + 1);
  }
}

/// A limit of steps ends a path where the load is about to turn at a stop: the path that goes on has that
/// limit point where it begins.
TEST(Events, ARestartTurnsWhereThePathWouldHave) {
  struct Turn {
    double pathLength, lambda;
    bool maximum;
  };
  const auto turns = [](const Record& record) {
    std::vector<Turn> all;
    for (const auto& s : record.steps)
      for (const auto& p : s.limitPoints)
        if (!p.smooth) all.push_back({s.pathLengthStart + p.a, p.lambda, p.maximum});
    return all;
  };
  Stops stops = loads({1.0});
  const WithStops<TrussBody> body(TrussBody{}, {1.2});
  const auto follow = [&](const Start* from, int maxSteps, Record& record) {
    UnilateralProblem<TrussBody> problem(body);
    SymmetricDenseSolver solver;
    Start start;
    start.state = {problem.vector({}), 0};
    Options options;
    options.maxSteps = maxSteps;
    return PathFollower(problem, solver, options, stops).runFrom(from ? *from : start, record);
  };
  Record whole;
  EXPECT_EQ(follow(nullptr, 100, whole).reason, EndReason::stopReached);
  const auto expected = turns(whole);
  ASSERT_EQ(expected.size(), 1u);
  const auto at = std::find_if(whole.steps.begin(), whole.steps.end(),
                               [](const StepReport& s) { return !s.events.empty(); });
  ASSERT_NE(at, whole.steps.end());
  Record head, tail;
  EXPECT_EQ(follow(nullptr, at->step, head).reason, EndReason::stepLimit);
  EXPECT_TRUE(turns(head).empty());  // it is not known yet how the path goes on
  const Start& next = head.steps.back().next;
  EXPECT_EQ(next.due, std::vector<int>{0});
  EXPECT_EQ(follow(&next, 100, tail).reason, EndReason::stopReached);
  const auto found = turns(tail);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].pathLength, expected[0].pathLength);
  EXPECT_EQ(found[0].lambda, expected[0].lambda);
  EXPECT_EQ(found[0].maximum, expected[0].maximum);
  EXPECT_EQ(tail.steps.back().next.limitPoints, whole.steps.back().next.limitPoints);
  for (const auto& p : tail.steps[0].limitPoints) EXPECT_FALSE(p.smooth);
}

/// A function that falls whatever is done about it.
struct Hopeless : UnilateralProblem<OneMass> {
  using UnilateralProblem::UnilateralProblem;
  void eventOrder(int k, std::vector<double>& g) const override {
    // -(a)^2 from where it is applied: falls both ways.
    if (law().touched[0])
      g[0] = k == 2 ? -1 : 0;
    else
      UnilateralProblem::eventOrder(k, g);
  }
};

TEST(Events, APathThatMayNotGoOnEndsWithAReason) {
  Hopeless problem(WithStops<OneMass>(OneMass{}, {1}));
  SymmetricDenseSolver solver;
  Record record;
  Stops stops = loads({3});
  const auto outcome = PathFollower(problem, solver, Options{}, stops).run({problem.vector({}), 0}, record);
  EXPECT_EQ(outcome.reason, EndReason::noAdmissibleDirection) << outcome.text;
  EXPECT_NEAR(outcome.final.lambda, 2, 1e-6);
  EXPECT_EQ(record.steps.size(), static_cast<std::size_t>(outcome.steps));
  EXPECT_EQ(problem.touchedAt(outcome.final), std::vector<int>{0});  // left as it was
}

/// A change that the state does not solve is the Problem's mistake and is named.
struct Jumps : UnilateralProblem<OneMass> {
  using UnilateralProblem::UnilateralProblem;
  ResidualNorm residual(const State& state, Vector& r) override {
    auto n = UnilateralProblem::residual(state, r);
    if (law().touched[0]) n.norm += 1;
    return n;
  }
};

TEST(Events, AChangeThatTheStateDoesNotSolveIsNamed) {
  Jumps problem(WithStops<OneMass>(OneMass{}, {1}));
  SymmetricDenseSolver solver;
  Record record;
  Stops stops = loads({3});
  const auto outcome = PathFollower(problem, solver, Options{}, stops).run({problem.vector({}), 0}, record);
  EXPECT_EQ(outcome.reason, EndReason::problemFailed);
  EXPECT_NE(outcome.text.find("does not solve the problem as an event has changed it"), std::string::npos)
      << outcome.text;
}

/// Rounding makes an event a little early: the state behind it is over the bound.
struct Early : UnilateralProblem<OneMass> {
  using UnilateralProblem::UnilateralProblem;
  void eventOrder(int k, std::vector<double>& g) const override {
    UnilateralProblem::eventOrder(k, g);
    if (k == 0 && !law().touched[0]) g[0] -= 3e-7;
  }
};

TEST(Events, AStateBehindOneIsCorrected) {
  for (const int order : {5, 20}) {
    Early problem(WithStops<OneMass>(OneMass{}, {1}));
    SymmetricDenseSolver solver;
    Record record;
    Options options;
    options.order = order;
    Stops stops = loads({3});
    const auto outcome = PathFollower(problem, solver, options, stops).run({problem.vector({}), 0}, record);
    EXPECT_EQ(outcome.reason, EndReason::stopReached) << outcome.text;
    EXPECT_EQ(outcome.events, 1);
    EXPECT_EQ(outcome.corrections, 1);
    EXPECT_EQ(outcome.factorizations, outcome.steps + outcome.corrections + outcome.closings);
    EXPECT_LE(outcome.worstResidual, options.residualBound);
    EXPECT_NEAR(outcome.final.u->getData()[0], 1, 1e-12);
    EXPECT_NEAR(outcome.final.u->getData()[1], 1, 1e-12);
  }
}

/// A stop so near behind the event that a correction in the plane normal to the path would miss it.
TEST(Events, ACorrectionBehindOneMissesNoStop) {
  Early problem(WithStops<OneMass>(OneMass{}, {1}));
  SymmetricDenseSolver solver;
  Record record;
  Stops stops = loads({2 - 8e-7});
  const auto outcome = PathFollower(problem, solver, Options{}, stops).run({problem.vector({}), 0}, record);
  EXPECT_EQ(outcome.reason, EndReason::stopReached) << outcome.text;
  EXPECT_EQ(outcome.final.lambda, 2 - 8e-7);
}

/// One whose residual rounding does not let fall below the bound: that is said.
struct Rough : UnilateralProblem<OneMass> {
  using UnilateralProblem::UnilateralProblem;
  ResidualNorm residual(const State& state, Vector& r) override {
    auto n = UnilateralProblem::residual(state, r);
    if (law().touched[0]) n.norm += 3e-7;
    return n;
  }
};

TEST(Events, AStateThatCorrectionsDoNotHelpIsNamed) {
  Rough problem(WithStops<OneMass>(OneMass{}, {1}));
  SymmetricDenseSolver solver;
  Record record;
  Stops stops = loads({3});
  const auto outcome = PathFollower(problem, solver, Options{}, stops).run({problem.vector({}), 0}, record);
  EXPECT_EQ(outcome.reason, EndReason::stepTooSmall);
  EXPECT_NE(outcome.text.find("behind an event the relative residual 3"), std::string::npos) << outcome.text;
  EXPECT_NE(outcome.text.find("ask for a larger bound"), std::string::npos) << outcome.text;
}

/// A second event function that never vanishes, 1/(1 + 25 u^2): at u = 0 its series has the radius 0.2, and
/// what it is cut to falls through zero a little beyond, where the path's own series is good.
struct NeverVanishing : UnilateralProblem<OneMass> {
  using UnilateralProblem::UnilateralProblem;
  int eventCount() const override { return 2; }
  void eventOrder(int k, std::vector<double>& g) const override {
    UnilateralProblem::eventOrder(k, g);
    const auto u = seriesJets()[0];
    g[1] = (1 / (1 + 25 * u * u))[k];
  }
  State afterEvent(const std::vector<int>& indices, const State& state) override {
    falseEvents += static_cast<int>(std::count(indices.begin(), indices.end(), 1));
    std::vector<int> own = indices;
    own.erase(std::remove(own.begin(), own.end(), 1), own.end());
    return UnilateralProblem::afterEvent(own, state);
  }
  int falseEvents = 0;
};

TEST(Events, ARootThatAFunctionHasNotIsNoEvent) {
  for (const int order : {6, 10, 14, 18, 22}) {
    SCOPED_TRACE(order);
    NeverVanishing problem(WithStops<OneMass>(OneMass{}, {1}));
    SymmetricDenseSolver solver;
    Record record;
    Stops stops = loads({3});
    Options options;
    options.order = order;
    const auto outcome = PathFollower(problem, solver, options, stops).run({problem.vector({}), 0}, record);
    EXPECT_EQ(outcome.reason, EndReason::stopReached) << outcome.text;
    EXPECT_EQ(problem.falseEvents, 0);
    EXPECT_EQ(outcome.events, 1);  // the mass at its stop
    EXPECT_EQ(outcome.eventTrials, 0);
  }
}

}  // namespace
