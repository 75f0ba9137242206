#include <cmath>

#include <gtest/gtest.h>

#include "atrapos/path/Branches.hpp"
#include "atrapos/path/Forced.hpp"
#include "problems/Bifurcations.hpp"
#include "problems/Ends.hpp"
#include "problems/FollowedModel.hpp"

using namespace atrapos;
using namespace atrapos::path;

namespace {

/// Load, both displacements of Lee's frame: values at the folds from an independent solution of the
/// equations.
TEST(Monitors, FoldsOfLeesFrame) {
  const models::Parameters parameters{{"elements", 20}};
  const auto problem = models::make("lee_frame", parameters);
  const auto setup = models::setup("lee_frame", parameters, *problem);
  SymmetricDenseSolver solver;
  Record record;
  Options options;
  options.delta = options.residualBound = 1e-9;
  PathFollower follower(*problem, solver, options, setup.stops);
  follower.watch(setup.monitors);
  EXPECT_EQ(follower.run(setup.start, record).reason, EndReason::stopReached);
  std::vector<Extremum> u, v;
  for (const auto& s : record.steps)
    for (const auto& e : s.extrema) (setup.monitors.at(e.monitor).name == "u" ? u : v).push_back(e);
  // v turns back at 61.0030 (load 1.194410) and again at 58.2..; u turns back at 94.3598 (load -0.685858).
  ASSERT_GE(v.size(), 2u);
  EXPECT_TRUE(v[0].maximum);
  EXPECT_NEAR(v[0].value, 61.0030, 1e-4);  // the reference's digits
  EXPECT_NEAR(v[0].lambda, 1.194410, 1e-5);
  ASSERT_GE(u.size(), 1u);
  EXPECT_TRUE(u[0].maximum);
  EXPECT_NEAR(u[0].value, 94.3598, 1e-4);
  EXPECT_NEAR(u[0].lambda, -0.685858, 1e-5);
}

TEST(Monitors, OneWithoutWeightsIsRefused) {
  const auto problem = models::make("stvk_bar");
  DenseSolver solver;
  PathFollower follower(*problem, solver, Options{});
  EXPECT_THROW(follower.watch({{"nothing", Teuchos::null}}), std::invalid_argument);
}

/// A force on the mode is the imperfection of the law itself: the same path.
TEST(Imperfect, AForceIsTheImperfectionOfTheLaw) {
  const double size = 1e-3;
  Modes perfect, built;
  perfect.bend = built.bend = 0.3;
  built.imperfection = size;
  Stops stops = loads({2});
  JetProblem<Modes> problem(perfect);
  ForcedProblem imperfect(problem, {problem.vector({0, size}), {}});
  SymmetricDenseSolver solver;
  Record record;
  const auto outcome =
      PathFollower(imperfect, solver, Options{}, stops).run({problem.vector({0, 0}), -2e-6}, record);
  EXPECT_EQ(outcome.reason, EndReason::stopReached) << outcome.text;
  Followed<Modes, SymmetricDenseSolver> same(built, {0, 0}, -2e-6, Options{}, stops);
  EXPECT_EQ(outcome.steps, same.outcome.steps);
  for (int i = 0; i < 2; ++i)
    EXPECT_NEAR(outcome.final.u->getData()[i], same.final(i), 1e-12);  // the same sums in another order
  EXPECT_GT(same.final(1), 1);
}

/// Koiter: with the shape of the mode, the perfect structure moves by that shape, to first order in its size.
TEST(Imperfect, AForceOfAShapeMovesByThatShape) {
  Column law;
  law.n = 6;
  JetProblem<Column> problem(law);
  std::vector<double> mode(law.n + 1, 0.0);
  for (int i = 1; i <= law.n; ++i) mode[i] = 1e-3 * std::sin((i - 0.5) * M_PI / (2 * law.n));
  const State start{problem.vector({}), 0};
  const auto shape = problem.vector(mode);
  ForcedProblem imperfect(problem, {forceOfShape(problem, start, *shape), {}});
  SymmetricDenseSolver solver;
  Stops stops = loads({4});
  for (const double sense : {1.0, -1.0}) {
    auto d = problem.vector(mode);
    d->scale(sense);
    ForcedProblem one(problem, {forceOfShape(problem, start, *d), {}});
    Record record;
    Options options;
    options.residualBound = options.delta = 1e-9;
    const auto outcome = PathFollower(one, solver, options, stops).run(start, record);
    EXPECT_EQ(outcome.reason, EndReason::stopReached) << outcome.text;
    // The start of the path: springs are linear, so the shape itself at lambda = 0.
    auto u = problem.vector({});
    record.series.front().evaluate(0, *u);
    for (int i = 1; i <= law.n; ++i) EXPECT_NEAR(u->getData()[i], sense * mode[i], 1e-9);
    // Past the buckling load it has gone to that side, as far as the perfect column's branch is.
    EXPECT_GT(sense * outcome.final.u->getData()[law.n], 0.5);
    EXPECT_TRUE(criticalPoints(record).empty());
  }
  Vector other(Teuchos::rcp(new Map(3, 0, Teuchos::rcp(new Teuchos::MpiComm<int>(MPI_COMM_SELF)))));
  const auto elsewhere = Teuchos::rcp(new Vector(other, Teuchos::Copy));
  EXPECT_THROW(ForcedProblem(problem, {elsewhere, {}}), std::invalid_argument);
  EXPECT_THROW(ForcedProblem(problem, {{}, elsewhere}), std::invalid_argument);
  EXPECT_THROW(ForcedProblem(problem, {}), std::invalid_argument);
}

/// A state that is held where the Problem is out of balance, and let go: the path ends in the Problem's own
/// equilibrium, and in between the force that is missing is the rest of what held it.
TEST(Forced, WhatHoldsAStateFades) {
  Column law;
  law.n = 6;
  JetProblem<Column> problem(law);
  std::vector<double> bent(law.n + 1, 0.0);
  for (int i = 1; i <= law.n; ++i) bent[i] = 0.3 * std::sin((i - 0.5) * M_PI / (2 * law.n));
  const State start{problem.vector(bent), 0};
  const DeadForce force = forceThatFades(problem, start);
  ForcedProblem held(problem, force);
  Vector r(problem.map());
  EXPECT_EQ(held.residual(start, r).norm, 0);
  ASSERT_GT(problem.residual(start, r).relative(), 1e-2);
  SymmetricDenseSolver solver;
  Stops stops = loads({1});
  Record record;
  Options options;
  options.residualBound = options.delta = 1e-9;
  const auto outcome = PathFollower(held, solver, options, stops).run(start, record);
  EXPECT_EQ(outcome.reason, EndReason::stopReached) << outcome.text;
  EXPECT_LE(problem.residual(outcome.final, r).relative(), 1e-9);
  const auto half = record.series.front().state(0.5 * record.steps.front().length);
  problem.residual(half, r);
  r.update(-(1 - half.lambda), *force.constant, 1);
  EXPECT_LE(r.norm2(), 1e-8 * force.constant->norm2());  // what the accuracy leaves of the series, ten times
}

/// From any step a path goes on with other settings: the same curve.
TEST(Restart, GoesOnWithOtherSettings) {
  const auto law = TrussOnSpring{0.3};
  JetProblem<TrussOnSpring> problem(law);
  Stops stops;
  stops.functionals.push_back({"x", problem.vector({1, 0}), 2.2});
  Followed<TrussOnSpring, SymmetricDenseSolver> whole(law, {0, 0}, 0, Options{}, stops);
  Options other;
  other.order = 12;
  other.delta = other.residualBound = 1e-9;
  other.pade = PadeUse::automatic;
  for (const std::size_t s : {2u, 9u}) {
    Start from = whole.record.steps.at(s).next;
    from.order = 0;  // that of the new settings
    SymmetricDenseSolver solver;
    Record record;
    const auto outcome = PathFollower(problem, solver, other, stops).runFrom(from, record);
    EXPECT_EQ(outcome.reason, EndReason::stopReached) << outcome.text;
    EXPECT_EQ(record.steps.front().order, 12);
    EXPECT_EQ(record.steps.front().step, static_cast<int>(s) + 2);
    EXPECT_NEAR(outcome.final.lambda, 2.2 * -1.2 * -0.2, 1e-9);  // bound x scale, and room
    // The first step starts from a state of the looser run.
    for (std::size_t i = 1; i < record.steps.size(); ++i) EXPECT_LE(record.steps[i].residual, 1e-9);
  }
}

/// Any state of the path without a solve: the observer reads the series.
TEST(Observer, ReadsAnyStateWithoutASolve) {
  const auto problem = models::make("truss_on_spring");
  const auto setup = models::setup("truss_on_spring", {}, *problem);
  struct Watch : Observer {
    explicit Watch(Problem& p, DenseSolver& s) : problem(p), solver(s) {}
    bool onStep(const StepReport& report, const Series& series) override {
      const auto before = solver.counters().solves;
      auto u = Teuchos::rcp(new Vector(problem.map())), r = Teuchos::rcp(new Vector(problem.map()));
      for (const double part : {0.1, 0.77}) {
        const double lambda = series.evaluate(part * report.length, *u);
        worst = std::max(worst, problem.residual({u, lambda}, *r).relative());
      }
      solves += solver.counters().solves - before;
      return true;
    }
    Problem& problem;
    DenseSolver& solver;
    double worst = 0;
    long long solves = 0;
  };
  SymmetricDenseSolver solver;
  Watch watch(*problem, solver);
  PathFollower(*problem, solver, Options{}, setup.stops).run(setup.start, watch);
  EXPECT_LE(watch.worst, 1e-6);
  EXPECT_EQ(watch.solves, 0);
}

}  // namespace
