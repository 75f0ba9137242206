#include <cmath>
#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

#include "problems/Ends.hpp"
#include "problems/Record.hpp"

using namespace atrapos::path;

namespace {

struct NoLoad : Linear {
  template <class S>
  std::vector<S> residual(const std::vector<S>& u, const S&) const {
    return {2 * u[0]};
  }
};

struct Nan : Linear {
  template <class S>
  std::vector<S> residual(const std::vector<S>& u, const S& lambda) const {
    return {2 * u[0] - lambda + S(std::numeric_limits<double>::quiet_NaN())};
  }
};

struct NoSolution : Linear {
  template <class S>
  std::vector<S> residual(const std::vector<S>& u, const S& lambda) const {
    return {u[0] * u[0] + 1 + lambda};
  }
};

/// Straight along u_0 = lambda, left by u_1^2 = 1 - lambda at lambda = 1.
struct Crossed : Linear {
  int size() const { return 2; }
  template <class S>
  std::vector<S> residual(const std::vector<S>& u, const S& lambda) const {
    return {u[0] - lambda, u[1] * (1 - lambda) - u[1] * u[1] * u[1]};
  }
};

/// Nothing holds u_1.
struct Mechanism : Linear {
  int size() const { return 2; }
  template <class S>
  std::vector<S> residual(const std::vector<S>& u, const S& lambda) const {
    return {u[0] - lambda, 0 * u[1]};
  }
};

TEST(Failures, StartsAtALimitPoint) {
  // The tangent of u^2 = lambda is exactly zero at 0. One factorization of it, one of the shifted one.
  Followed<Fold> f(Fold{}, {0}, 0, Options{}, loads({1}));
  ASSERT_EQ(f.outcome.reason, EndReason::stopReached) << f.outcome.text;
  // On one of the two halves, as exact as the residual bound is with the slope 2.
  EXPECT_NEAR(std::abs(f.outcome.final.u->getData()[0]), 1, 1e-6);
  EXPECT_EQ(f.outcome.restarts, 2);
  EXPECT_EQ(f.outcome.factorizations, f.outcome.steps + f.outcome.startIterations + f.outcome.corrections +
                                          f.outcome.restarts + f.outcome.retreats);
  Options falling;
  falling.direction = -1;
  Followed<Fold> none(Fold{}, {0}, 0, falling, loads({-1}));
  EXPECT_EQ(none.outcome.reason, EndReason::singularTangent);
  EXPECT_NE(none.outcome.text.find("grows on both sides"), std::string::npos) << none.outcome.text;
}

TEST(Failures, StartsAtABifurcationPoint) {
  for (const double direction : {1.0, -1.0}) {
    Options options;
    options.direction = direction;
    Followed<Crossed> f(Crossed{}, {1, 0}, 1, options, loads({1 + direction}));
    ASSERT_EQ(f.outcome.reason, EndReason::stopReached) << f.outcome.text;
    EXPECT_NEAR(f.outcome.final.u->getData()[0], 1 + direction, 1e-12);  // linear
    EXPECT_NEAR(f.outcome.final.u->getData()[1], 0, 1e-6);  // the residual bound; the other branch has 0 or 1
  }
}

TEST(Failures, MechanismNamesItsMotion) {
  Followed<Mechanism> f(Mechanism{}, {0, 0}, 0, Options{}, loads({1}));
  EXPECT_EQ(f.outcome.reason, EndReason::singularTangent);
  EXPECT_NE(f.outcome.text.find("cannot start here, nor next to it"), std::string::npos) << f.outcome.text;
  EXPECT_NE(f.outcome.text.find("null vector: unknown 1"), std::string::npos) << f.outcome.text;
  EXPECT_EQ(f.outcome.steps, 0);
}

TEST(Failures, SingularTangentOnTheWayIsSteppedOver) {
  JetProblem<TrussOnSpring> problem(TrussOnSpring{});
  DenseSolver solver;
  solver.pretendSingularAt = {4, 5};
  Record record;
  Stops stops;
  stops.functionals.push_back({"x", problem.vector({1, 0}), 2.2});
  const auto outcome =
      PathFollower(problem, solver, Options{}, stops).run({problem.vector({0, 0}), 0}, record);
  EXPECT_EQ(outcome.reason, EndReason::stopReached) << outcome.text;
  EXPECT_EQ(outcome.restarts, 2);
  EXPECT_EQ(outcome.factorizations, outcome.steps + outcome.corrections + outcome.restarts);
  EXPECT_LE(outcome.worstResidual, 1e-6);

  DenseSolver stubborn;
  stubborn.pretendSingularAt = {4, 5, 6, 7, 8};
  Record before;
  const auto failed =
      PathFollower(problem, stubborn, Options{}, stops).run({problem.vector({0, 0}), 0}, before);
  EXPECT_EQ(failed.reason, EndReason::singularTangent);
  EXPECT_EQ(failed.steps, 3);  // the steps before stay valid
  EXPECT_EQ(before.steps.size(), 3u);
  EXPECT_EQ(failed.factorizations, failed.steps + failed.corrections + failed.restarts + 1);
}

TEST(Failures, LoadWithoutEffect) {
  Followed<NoLoad> f(NoLoad{}, {0}, 0, Options{}, loads({1}));
  EXPECT_EQ(f.outcome.reason, EndReason::loadWithoutEffect) << f.outcome.text;
}

TEST(Failures, NotANumberAtTheStart) {
  Followed<Nan> f(Nan{}, {0}, 0, Options{}, loads({1}));
  EXPECT_EQ(f.outcome.reason, EndReason::notFinite) << f.outcome.text;
}

/// u = lambda/(lambda + 1e-9): at the start coefficients grow by 1e9 from order to order.
struct Steep : Linear {
  template <class S>
  std::vector<S> residual(const std::vector<S>& u, const S& lambda) const {
    return {u[0] * (1e9 * lambda + 1) - 1e9 * lambda};
  }
};

// A series whose coefficients overflow goes on with those before.
TEST(Failures, CoefficientsOverflow) {
  Options options;
  options.order = 40;
  Followed<Steep> f(Steep{}, {0}, 0, options, loads({1}));
  EXPECT_EQ(f.outcome.reason, EndReason::stopReached) << f.outcome.text;
  EXPECT_LT(f.record.steps.front().order, 40);
  EXPECT_NEAR(f.outcome.final.u->getData()[0], 1 / (1 + 1e-9), 1e-6);  // the residual's bound
}

/// Residual is fine, an order is not.
TEST(Failures, NotANumberInAnOrder) {
  struct Broken : JetProblem<StvkBar> {
    using JetProblem::JetProblem;
    void orderRhs(int k, Vector& Fk) override {
      JetProblem::orderRhs(k, Fk);
      if (k == 7) Fk.putScalar(std::numeric_limits<double>::quiet_NaN());
    }
  };
  Broken problem{StvkBar{}};
  DenseSolver solver;
  Record record;
  const auto outcome = PathFollower(problem, solver, Options{}).run({problem.vector({0}), 0}, record);
  EXPECT_EQ(outcome.reason, EndReason::notFinite);
  EXPECT_NE(outcome.text.find("order 7"), std::string::npos) << outcome.text;
}

/// A residual that the series does not belong to: the bound cannot be met.
TEST(Failures, BoundThatCannotBeMet) {
  struct Wrong : JetProblem<StvkBar> {
    using JetProblem::JetProblem;
    ResidualNorm residual(const State& state, Vector& r) override {
      auto n = JetProblem::residual(state, r);
      if (state.lambda != 0) n.norm += 1e-3;
      return n;
    }
  };
  Wrong problem{StvkBar{}};
  DenseSolver solver;
  Record record;
  const auto outcome = PathFollower(problem, solver, Options{}).run({problem.vector({0}), 0}, record);
  EXPECT_EQ(outcome.reason, EndReason::stepTooSmall) << outcome.text;
  EXPECT_EQ(outcome.steps, 0);
  EXPECT_GT(outcome.cutBacks, 0);
}

TEST(Failures, ProblemAndSolverExceptionsBecomeReasons) {
  struct Throws : JetProblem<StvkBar> {
    using JetProblem::JetProblem;
    ResidualNorm residual(const State& state, Vector& r) override {
      if (residuals > 4) throw std::runtime_error("element 12 is turned inside out");
      return JetProblem::residual(state, r);
    }
  };
  Throws problem{StvkBar{}};
  DenseSolver solver;
  Record record;
  const auto outcome = PathFollower(problem, solver, Options{}).run({problem.vector({0}), 0}, record);
  EXPECT_EQ(outcome.reason, EndReason::problemFailed);
  EXPECT_EQ(outcome.text, "element 12 is turned inside out");
  EXPECT_EQ(outcome.steps, static_cast<int>(record.steps.size()));

  struct OutOfMemory : DenseSolver {
    void factor(const Teuchos::RCP<const CrsMatrix>&) override {
      throw atrapos::linear::SolverError("out of memory");
    }
  };
  OutOfMemory broken;
  JetProblem<StvkBar> bar{StvkBar{}};
  const auto second = PathFollower(bar, broken, Options{}).run({bar.vector({0}), 0}, record);
  EXPECT_EQ(second.reason, EndReason::solverFailed);
  EXPECT_EQ(second.text, "out of memory");
}

TEST(Failures, StartOutOfEquilibriumIsCorrectedOrRefused) {
  Followed<Truss> f(Truss{}, {0.35}, 0.3, Options{}, loads({0.36}));
  EXPECT_EQ(f.outcome.reason, EndReason::stopReached) << f.outcome.text;
  EXPECT_GT(f.outcome.startIterations, 0);
  EXPECT_EQ(f.outcome.factorizations, f.outcome.steps + f.outcome.corrections + f.outcome.startIterations);
  Followed<NoSolution> g(NoSolution{}, {0.7}, 0, Options{}, loads({1}));
  EXPECT_EQ(g.outcome.reason, EndReason::startNotInEquilibrium);
  EXPECT_EQ(g.outcome.factorizations, g.outcome.startIterations);
}

TEST(Failures, TheCallersStartIsNotChanged) {
  JetProblem<Truss> problem(Truss{});
  DenseSolver solver;
  Record record;
  const auto u = problem.vector({0.35});
  PathFollower(problem, solver, Options{}, loads({0.36})).run({u, 0.3}, record);
  EXPECT_EQ(u->getData()[0], 0.35);
}

}  // namespace
