#include <cmath>

#include <gtest/gtest.h>

#include "problems/Bifurcations.hpp"
#include "problems/Ends.hpp"
#include "problems/Record.hpp"
#include "problems/UnilateralProblem.hpp"

using namespace atrapos::path;

// A series has as many orders as its end asks for.
namespace {

/// Masses on hardening springs, with springs between them.
struct Masses : NoInternal {
  int n = 6;
  template <class S>
  std::vector<S> forces(const std::vector<S>& u, const S& lambda) const {
    std::vector<S> r;
    for (int i = 0; i < n; ++i) {
      S f = u[i] + 0.3 * u[i] * u[i] * u[i] - (1 - 0.1 * i) * lambda;
      if (i > 0) f = f + 0.2 * (u[i] - u[i - 1]);
      if (i + 1 < n) f = f + 0.2 * (u[i] - u[i + 1]);
      r.push_back(f);
    }
    return r;
  }
};

/// A path to a load factor with stops for the masses.
template <class B, class Problem = UnilateralProblem<B>>
struct Path {
  Problem problem;
  SymmetricDenseSolver solver;
  Record record;
  Outcome outcome;

  Path(B body, std::vector<double> stops, double end, Options options)
      : problem(WithStops<B>(body, std::move(stops))) {
    Stops at = loads({end});
    outcome = PathFollower(problem, solver, options, at).run({problem.vector({}), 0}, record);
    EXPECT_EQ(outcome.reason, EndReason::stopReached) << outcome.text;
    EXPECT_EQ(solver.counters().factorizations, outcome.factorizations);
    EXPECT_EQ(outcome.factorizations, outcome.steps + outcome.corrections + outcome.retreats +
                                          outcome.closings + outcome.criticalFactorizations +
                                          outcome.eventTrials);
  }
  double final(int i) const { return outcome.final.u->getData()[i]; }
  std::vector<StepReport> events() const {
    std::vector<StepReport> all;
    for (const auto& s : record.steps)
      if (!s.events.empty()) all.push_back(s);
    return all;
  }
};

Options allOrders(Options options = {}) {
  options.fewerOrders = false;
  return options;
}

TEST(Orders, FallNearEventsAndStopsAndThePathIsTheSame) {
  // Events one soon after the other.
  const std::vector<double> walls = {0.4, 0.39, 0.38, 0.36, 0.33, 0.29};
  Options polynomials;
  polynomials.pade = PadeUse::off;
  for (const Options& options : {Options{}, polynomials}) {
    const Path<Masses> few(Masses{}, walls, 1, options), all(Masses{}, walls, 1, allOrders(options));
    EXPECT_EQ(few.outcome.steps, all.outcome.steps);
    EXPECT_EQ(few.outcome.factorizations, all.outcome.factorizations);
    EXPECT_LT(few.outcome.orders, 0.6 * all.outcome.orders);
    EXPECT_EQ(few.outcome.corrections, 0);
    const auto met = few.events(), reference = all.events();
    ASSERT_EQ(met.size(), walls.size());
    ASSERT_EQ(reference.size(), walls.size());
    for (std::size_t i = 0; i < met.size(); ++i) {
      EXPECT_EQ(met[i].events, reference[i].events);
      EXPECT_NEAR(met[i].lambdaEnd, reference[i].lambdaEnd, 1e-7);
      EXPECT_LE(met[i].residual, 0.1 * options.residualBound);
    }
    EXPECT_LT(met.back().order, 12);
    for (int i = 0; i < few.problem.law().size(); ++i) EXPECT_NEAR(few.final(i), all.final(i), 1e-8) << i;
  }
}

TEST(Orders, FallWithTheDistance) {
  int last = 0;
  for (const double wall : {1e-3, 3e-2, 0.2}) {
    const Path<Masses> f(Masses{}, {wall, 9, 9, 9, 9, 9}, 0.5, Options{});
    EXPECT_GT(f.record.steps[0].order, last);
    EXPECT_LT(f.record.steps[0].order, 20);
    last = f.record.steps[0].order;
  }
}

/// u + u^3 = lambda.
struct Spring : NoInternal {
  int size() const { return 1; }
  template <class S>
  std::vector<S> residual(const std::vector<S>& u, const S& lambda) const {
    return {u[0] + u[0] * u[0] * u[0] - lambda};
  }
};

TEST(Orders, FallNearAStopAndAtTheLongestStep) {
  Stops stops = loads({0.03});
  const Followed<Spring> near(Spring{}, {0}, 0, Options{}, stops);
  ASSERT_EQ(near.record.steps.size(), 1u);
  EXPECT_LT(near.record.steps[0].order, 10);
  EXPECT_NEAR(near.final(0) + std::pow(near.final(0), 3), 0.03, 1e-12);

  Options options;
  options.maxStep = 0.02;
  options.maxSteps = 5;
  const Followed<Spring> often(Spring{}, {0}, 0, options), all(Spring{}, {0}, 0, allOrders(options));
  EXPECT_LT(often.outcome.orders, 0.6 * all.outcome.orders);
  ASSERT_EQ(often.record.steps.size(), all.record.steps.size());
  for (std::size_t s = 0; s < all.record.steps.size(); ++s) {
    EXPECT_EQ(often.record.steps[s].length, all.record.steps[s].length);
    EXPECT_NEAR(often.record.steps[s].lambdaEnd, all.record.steps[s].lambdaEnd, 1e-9);
  }
}

/// Nothing is near: the same to the bit.
TEST(Orders, AllWhereNoEndIsNear) {
  Options options;
  options.maxSteps = 6;
  const Followed<Spring> few(Spring{}, {0}, 0, options), all(Spring{}, {0}, 0, allOrders(options));
  ASSERT_EQ(few.record.steps.size(), all.record.steps.size());
  for (std::size_t s = 0; s < all.record.steps.size(); ++s) {
    EXPECT_EQ(few.record.steps[s].order, 20);
    EXPECT_EQ(few.record.steps[s].length, all.record.steps[s].length);
    EXPECT_EQ(few.record.steps[s].end.u->getData()[0], all.record.steps[s].end.u->getData()[0]);
  }
}

/// u = lambda + lambda^9: orders 2 to 8 vanish, and what they say of the remainder is wrong. The residual
/// says it.
struct Late : NoInternal {
  int size() const { return 1; }
  template <class S>
  std::vector<S> residual(const std::vector<S>& u, const S& lambda) const {
    const S l3 = lambda * lambda * lambda;
    return {u[0] - lambda - l3 * l3 * l3};
  }
};

TEST(Orders, AreEnoughOnlyWhereTheResidualSaysSo) {
  Stops stops = loads({0.3});
  Options options;
  options.maxStep = 1;
  const Followed<Late> f(Late{}, {0}, 0, options, stops);
  EXPECT_EQ(f.outcome.reason, EndReason::stopReached) << f.outcome.text;
  EXPECT_EQ(f.outcome.steps, 1);
  EXPECT_EQ(f.outcome.corrections, 0);
  EXPECT_GE(f.record.steps[0].order, 9);
  EXPECT_NEAR(f.final(0), 0.3 + std::pow(0.3, 9), 1e-10);
}

struct Linear : NoInternal {
  template <class S>
  std::vector<S> forces(const std::vector<S>& u, const S& lambda) const {
    return {u[0] - lambda};
  }
};

/// The event function begins with the ninth power of a: the orders below say nothing of its root.
struct LateEvent : UnilateralProblem<Linear> {
  using UnilateralProblem::UnilateralProblem;
  void eventOrder(int k, std::vector<double>& g) const override {
    UnilateralProblem::eventOrder(k, g);
    if (law().touched[0]) return;
    Jet::terms = k + 1;
    const Jet u = seriesJets()[0], u3 = u * u * u;
    g[0] = (Jet(std::pow(law().stops[0], 9)) - u3 * u3 * u3)[k];
  }
};

TEST(Orders, DoNotLoseAnEventThatTheyDoNotShow) {
  const Path<Linear, LateEvent> f(Linear{}, {0.9}, 0.95, Options{});
  ASSERT_EQ(f.events().size(), 1u);
  EXPECT_NEAR(f.events()[0].lambdaEnd, 0.9, 1e-9);
  EXPECT_EQ(f.events()[0].order, 20);
  EXPECT_NEAR(f.final(0), 0.9, 1e-9);
  EXPECT_NEAR(f.final(1), 0.05, 1e-9);
}

TEST(Orders, AreThoseOfAnUninterruptedPath) {
  const std::vector<double> walls = {0.4, 0.39, 0.38, 0.36, 0.33, 0.29};
  const Path<Masses> whole(Masses{}, walls, 1, Options{});
  Stops stops = loads({1});
  for (std::size_t s = 0; s + 1 < whole.record.steps.size(); ++s) {
    UnilateralProblem<Masses> again(WithStops<Masses>(Masses{}, walls));
    Options head;
    head.maxSteps = static_cast<int>(s) + 1;
    SymmetricDenseSolver solver;
    Record first, rest;
    PathFollower(again, solver, head, stops).run({again.vector({}), 0}, first);
    PathFollower(again, solver, Options{}, stops).runFrom(first.steps.back().next, rest);
    ASSERT_EQ(first.steps.size() + rest.steps.size(), whole.record.steps.size());
    for (std::size_t i = 0; i < rest.steps.size(); ++i) {
      EXPECT_EQ(rest.steps[i].order, whole.record.steps[s + 1 + i].order);
      EXPECT_EQ(rest.steps[i].lambdaEnd, whole.record.steps[s + 1 + i].lambdaEnd);
    }
  }
}

}  // namespace
