#include <cmath>

#include <gtest/gtest.h>

#include "atrapos/path/NewtonFollower.hpp"
#include "problems/Bifurcations.hpp"
#include "problems/Ends.hpp"
#include "problems/Record.hpp"

using namespace atrapos::path;

namespace {

TEST(Stops, LoadFactorIsHitExactly) {
  Followed<Truss> f(Truss{}, {0}, 0, Options{}, loads({0.3}));
  EXPECT_EQ(f.outcome.reason, EndReason::stopReached);
  EXPECT_EQ(f.outcome.text, "load factor 0.3 reached");
  EXPECT_NEAR(f.outcome.final.lambda, 0.3, 1e-15);  // root to rounding
  EXPECT_LT(f.final(0), 1 - 1 / std::sqrt(3.0));    // the first crossing, before the limit point
}

TEST(Stops, FallingLoadComesAfterTheLimitPoint) {
  Followed<Truss> f(Truss{}, {0}, 0, Options{}, loads({-0.2}));
  EXPECT_NEAR(f.outcome.final.lambda, -0.2, 1e-15);
  EXPECT_GT(f.final(0), 1);
  Options down;
  down.direction = -1;
  Followed<Truss> g(Truss{}, {0}, 0, down, loads({-0.2}));
  EXPECT_NEAR(g.outcome.final.lambda, -0.2, 1e-15);
  EXPECT_LT(g.final(0), 0);
}

TEST(Stops, WhicheverComesFirst) {
  JetProblem<Truss> p(Truss{});
  Stops stops = loads({0.38, 2.0});
  stops.functionals.push_back({"deflection", p.vector({1}), 0.2});
  Followed<Truss> f(Truss{}, {0}, 0, Options{}, stops);
  EXPECT_EQ(f.outcome.text, "deflection 0.2 reached");
  EXPECT_NEAR(f.final(0), 0.2, 1e-15);
  EXPECT_NEAR(f.outcome.final.lambda, 0.288, 1e-7);  // residual bound x scale
}

TEST(Stops, PathLengthIsHitExactly) {
  Stops stops;
  stops.pathLength = 1.75;
  Followed<Truss> f(Truss{}, {0}, 0, Options{}, stops);
  EXPECT_EQ(f.outcome.reason, EndReason::stopReached);
  EXPECT_NEAR(f.outcome.pathLength, 1.75, 1e-15);
}

TEST(Stops, ACorrectionAtAStopKeepsTheStop) {
  Options options;
  options.relaxResidual = false;
  options.correctAbove = 1e-9;  // always correct
  JetProblem<TrussOnSpring> p(TrussOnSpring{});
  Stops stops;
  stops.functionals.push_back({"z", p.vector({0, 1}), 1.0});
  Followed<TrussOnSpring> f(TrussOnSpring{}, {0, 0}, 0, options, stops);
  EXPECT_NEAR(f.final(1), 1.0, 1e-14);        // a few roundings of the corrected state
  EXPECT_LE(f.outcome.worstResidual, 1e-14);  // correctAbove is below rounding: Newton went as far as it goes
  Followed<TrussOnSpring> g(TrussOnSpring{}, {0, 0}, 0, options, loads({0.33}));
  EXPECT_NEAR(g.outcome.final.lambda, 0.33, 1e-15);
}

TEST(Stops, StartOnTheStopMovesOn) {
  // Starts at lambda = 0, asks for lambda = 0: the next such point is the flat truss, x = 1.
  Followed<Truss> f(Truss{}, {0}, 0, Options{}, loads({0}));
  EXPECT_EQ(f.outcome.reason, EndReason::stopReached);
  EXPECT_NEAR(f.final(0), 1, 1e-6);
  // And from a state that an earlier run left on its stop.
  Followed<Truss> first(Truss{}, {0}, 0, Options{}, loads({0.3}));
  Followed<Truss> second(Truss{}, {first.final(0)}, first.outcome.final.lambda, Options{}, loads({0.3}));
  EXPECT_GT(second.final(0), 1 - 1 / std::sqrt(3.0));
  EXPECT_NEAR(second.outcome.final.lambda, 0.3, 1e-15);
  // Off by a rounding, so that the crossing lies a hair ahead of the start.
  Followed<Truss> third(Truss{}, {first.final(0)}, std::nextafter(0.3, 0.0), Options{}, loads({0.3}));
  EXPECT_GT(third.final(0), 1 - 1 / std::sqrt(3.0));
}

TEST(Stops, TinyValuesAreNoStartOnTheStop) {
  JetProblem<Truss> p(Truss{});
  // The path leaves the undeformed state through both, with 1e-300 an eps of the first step ahead.
  for (const double value : {1e-13, 1e-300}) {
    SCOPED_TRACE(value);
    Followed<Truss> f(Truss{}, {0}, 0, Options{}, loads({value}));
    EXPECT_EQ(f.outcome.reason, EndReason::stopReached);
    EXPECT_EQ(f.outcome.steps, 1);
    EXPECT_EQ(f.outcome.final.lambda, value);
    EXPECT_LT(std::abs(f.final(0)), 1e-12);
    Stops stops;
    stops.functionals.push_back({"x", p.vector({1}), value});
    Followed<Truss> g(Truss{}, {0}, 0, Options{}, stops);
    EXPECT_EQ(g.outcome.reason, EndReason::stopReached);
    EXPECT_EQ(g.outcome.steps, 1);
    EXPECT_NEAR(g.final(0), value, 1e-15);
  }
}

Stops limitPoint(int n) {
  Stops stops;
  stops.limitPoints = n;
  return stops;
}

Stops bifurcation(int n) {
  Stops stops;
  stops.bifurcations = n;
  return stops;
}

/// lambda = x (1 - x) (2 - x) turns at x = 1 -+ 1/sqrt(3).
TEST(Stops, TheStepThatPassesALimitPointIsTheLast) {
  for (const int n : {1, 2}) {
    SCOPED_TRACE(n);
    Followed<Truss, SymmetricDenseSolver> f(Truss{}, {0}, 0, Options{}, limitPoint(n));
    EXPECT_EQ(f.outcome.reason, EndReason::stopReached);
    EXPECT_EQ(f.outcome.text, "limit point " + std::to_string(n) + " passed");
    ASSERT_EQ(f.record.limitPoints().size(), static_cast<std::size_t>(n));
    ASSERT_EQ(f.record.steps.back().limitPoints.size(), 1u);  // not a step more
    const double x = 1 + (n == 1 ? -1 : 1) / std::sqrt(3.0);
    EXPECT_NEAR(f.record.limitPoints().back().lambda, x * (1 - x) * (2 - x), 1e-6);  // residual bound
    EXPECT_GT(f.final(0), x);
    EXPECT_EQ(f.record.steps.back().next.stop, f.outcome.text);
    // One series more than steps, the one that told the inertia at the end.
    EXPECT_EQ(f.outcome.factorizations, f.outcome.steps + 1 + f.outcome.corrections + f.outcome.retreats +
                                            f.outcome.criticalFactorizations);
  }
}

TEST(Stops, ABifurcationPointIsOneWhateverTurnsBeside) {
  // Bifurcation points at 1 -+ sqrt(1/2), each beside a limit point at 1 -+ sqrt(1/3).
  SwayTruss law;
  law.b = 0.5;
  for (const int n : {1, 2}) {
    SCOPED_TRACE(n);
    Followed<SwayTruss, SymmetricDenseSolver> f(law, {0, 0}, 0, Options{}, bifurcation(n));
    EXPECT_EQ(f.outcome.text, "bifurcation point " + std::to_string(n) + " passed");
    const auto points = criticalPoints(f.record);
    ASSERT_EQ(points.size(), static_cast<std::size_t>(n));
    const double x = 1 + (n == 1 ? -1 : 1) * std::sqrt(0.5);
    EXPECT_NEAR(points.back().state.u->getData()[0], x, 1e-12);  // Newton on the extended system
    EXPECT_GT(f.final(0), x);
  }
}

TEST(Stops, CountsOfPointsGoOnWithAPath) {
  Followed<Truss, SymmetricDenseSolver> whole(Truss{}, {0}, 0, Options{}, limitPoint(2));
  for (const StepReport& step : whole.record.steps) {
    SCOPED_TRACE(step.step);
    JetProblem<Truss> problem(Truss{});
    SymmetricDenseSolver solver;
    Record rest;
    const auto outcome = PathFollower(problem, solver, Options{}, limitPoint(2)).runFrom(step.next, rest);
    EXPECT_EQ(outcome.text, whole.outcome.text);
    EXPECT_EQ(outcome.steps, whole.outcome.steps);
    EXPECT_EQ(outcome.final.lambda, whole.outcome.final.lambda);
    // Fewer than it has passed: it is over.
    Record none;
    const auto over = PathFollower(problem, solver, Options{}, limitPoint(1)).runFrom(step.next, none);
    if (step.next.limitPoints > 0) {
      EXPECT_EQ(over.text, "limit point 1 passed");
      EXPECT_TRUE(none.steps.empty());
    }
  }
}

/// The limit of steps and the point on the same step: the point is what was asked for.
TEST(Stops, APointOnTheLastStepCounts) {
  Followed<Truss, SymmetricDenseSolver> whole(Truss{}, {0}, 0, Options{}, limitPoint(1));
  Options options;
  options.maxSteps = whole.outcome.steps;
  Followed<Truss, SymmetricDenseSolver> f(Truss{}, {0}, 0, options, limitPoint(1));
  EXPECT_EQ(f.outcome.reason, EndReason::stopReached);
  EXPECT_EQ(f.outcome.text, "limit point 1 passed");
}

TEST(Stops, NewtonStepsCountLimitPoints) {
  JetProblem<Truss> problem(Truss{});
  SymmetricDenseSolver solver;
  Record record;
  const auto outcome =
      NewtonFollower(problem, solver, {}, limitPoint(2)).run({problem.vector({0}), 0}, record);
  EXPECT_EQ(outcome.reason, EndReason::stopReached);
  EXPECT_EQ(outcome.text, "limit point 2 passed");
  EXPECT_EQ(record.limitPoints().size(), 2u);
  EXPECT_GT(outcome.final.u->getData()[0], 1 + 1 / std::sqrt(3.0));
  EXPECT_EQ(record.steps.back().next.stop, outcome.text);
}

TEST(Stops, StepLimitAndObserver) {
  Options options;
  options.maxSteps = 3;
  Followed<Truss> f(Truss{}, {0}, 0, options);
  EXPECT_EQ(f.outcome.reason, EndReason::stepLimit);
  EXPECT_EQ(f.outcome.steps, 3);
  JetProblem<Truss> problem(Truss{});
  DenseSolver solver;
  Record record;
  record.goOn = [&] { return record.steps.size() < 2; };
  const auto outcome = PathFollower(problem, solver, Options{}).run({problem.vector({0}), 0}, record);
  EXPECT_EQ(outcome.reason, EndReason::observerStopped);
  EXPECT_EQ(outcome.steps, 2);
}

TEST(Stops, TerminatingSeriesGoesAsFarAsAllowed) {
  Followed<Linear> f(Linear{}, {0}, 0, Options{}, loads({5}));
  EXPECT_EQ(f.outcome.steps, 1);
  EXPECT_NEAR(f.final(0), 2.5, 1e-13);  // roundings of a step of length 7
  EXPECT_TRUE(std::isinf(f.record.steps[0].radius));
  Options options;
  options.maxStep = 2;
  options.maxSteps = 4;
  Followed<Linear> g(Linear{}, {0}, 0, options);
  EXPECT_EQ(g.outcome.reason, EndReason::stepLimit);
  for (const auto& s : g.record.steps) EXPECT_EQ(s.length, 2);
  EXPECT_NEAR(g.outcome.final.lambda, 8 * std::sqrt(0.5),
              1e-13);  // dlambda/da = 1/sqrt(2) with the default weight
}

TEST(Stops, BadInputIsRefused) {
  JetProblem<Truss> problem(Truss{});
  DenseSolver solver;
  Options options;
  options.delta = 2;
  EXPECT_THROW(PathFollower(problem, solver, options), std::invalid_argument);
  options = {};
  options.order = 0;
  EXPECT_THROW(PathFollower(problem, solver, options), std::invalid_argument);
  Stops stops;
  stops.functionals.push_back({"nothing", Teuchos::null, 1});
  EXPECT_THROW(PathFollower(problem, solver, Options{}, stops), std::invalid_argument);
  EXPECT_THROW(PathFollower(problem, solver, Options{}, limitPoint(-1)), std::invalid_argument);
  EXPECT_THROW(NewtonFollower(problem, solver, {}, bifurcation(1)), std::invalid_argument);
  options = {};
  options.criticalPoints = false;
  EXPECT_THROW(PathFollower(problem, solver, options, bifurcation(1)), std::invalid_argument);
  try {
    options = {};
    options.correctAbove = -1;
    options.validate();
    FAIL() << "accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "path options: correctAbove = -1, must be in (0, 1]");
  }
}

}  // namespace
