#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "atrapos/path/NewtonFollower.hpp"
#include "problems/Bifurcations.hpp"
#include "problems/ChebyshevBratu.hpp"
#include "problems/Ends.hpp"
#include "problems/Record.hpp"

using namespace atrapos::path;

namespace {

constexpr NewtonKind kinds[] = {NewtonKind::full, NewtonKind::modified};

/// A path followed by Newton steps from (u, lambda), and all there is to know about it.
template <class Law, class Solver = DenseSolver>
struct NewtonFollowed {
  JetProblem<Law> problem;
  Solver solver;
  Record record;
  Outcome outcome;

  NewtonFollowed(Law law, std::vector<double> u, double lambda, NewtonOptions options, Stops stops = {})
      : problem(law) {
    NewtonFollower follower(problem, solver, options, std::move(stops));
    outcome = follower.run({problem.vector(u), lambda}, record);
  }

  double final(int i) const { return outcome.final.u->getData()[i]; }
};

template <class Followed>
void expectSound(const Followed& f, double bound) {
  EXPECT_EQ(f.outcome.reason, EndReason::stopReached) << f.outcome.text;
  EXPECT_LE(f.outcome.worstResidual, bound);
  EXPECT_EQ(f.solver.counters().factorizations, f.outcome.factorizations);
  EXPECT_EQ(f.solver.counters().solves, f.outcome.solves);
  EXPECT_EQ(f.solver.counters().analyses, 1);
  EXPECT_EQ(f.outcome.steps, static_cast<int>(f.record.steps.size()));
  double length = 0;
  for (const auto& s : f.record.steps) {
    EXPECT_EQ(s.pathLengthStart, length);
    length = s.pathLengthEnd;
  }
  EXPECT_EQ(f.outcome.pathLength, length);
}

/// Halving the step must divide the residual by 2^p: p of two successive halvings, read off the finer one.
template <class Measure>
double order(Measure measure, double s) {
  return std::log2(measure(s) / measure(s / 2));
}

/// One step of length s with exactly n iterations.
NewtonOptions oneStep(double s, int n, NewtonKind kind) {
  NewtonOptions options;
  options.kind = kind;
  options.residualBound = 1e30;  // any residual passes: n iterations, not more
  options.minIterations = options.maxIterations = n;
  options.refactorAbove = 0.999;
  options.firstStep = s;
  options.maxSteps = 1;
  return options;
}

/// Residual s^2 at the tangent predictor; then s^4, s^8 by full Newton, s^4, s^6 with the predictor's tangent
/// (docs/theory/newton.md).
TEST(Newton, OrdersOfPredictorAndCorrector) {
  const TrussOnSpring law{0.3};
  const auto residual = [&](double s, int n, NewtonKind kind) {
    NewtonFollowed<TrussOnSpring> f(law, {0, 0}, 0, oneStep(s, n, kind));
    EXPECT_EQ(f.outcome.reason, EndReason::stepLimit) << f.outcome.text;
    EXPECT_EQ(f.outcome.corrections, n);
    const auto& step = f.record.steps.at(0);
    return n == 0 ? step.residualOfSeries : step.residual;
  };
  // The next power of s, of relative size 2 s with these lengths, moves an observed order by about 0.1.
  const double tolerance = 0.25;
  const auto predictor = [&](double s) {
    NewtonFollowed<TrussOnSpring> f(law, {0, 0}, 0, oneStep(s, 1, NewtonKind::full));
    return f.record.steps.at(0).residualOfSeries;
  };
  EXPECT_NEAR(order(predictor, 0.02), 2, tolerance);
  for (const auto kind : kinds)
    EXPECT_NEAR(order([&](double s) { return residual(s, 1, kind); }, 0.02), 4, tolerance);
  EXPECT_NEAR(order([&](double s) { return residual(s, 2, NewtonKind::full); }, 0.06), 8, 2 * tolerance);
  EXPECT_NEAR(order([&](double s) { return residual(s, 2, NewtonKind::modified); }, 0.06), 6, 2 * tolerance);
}

/// The cubic of a step leaves the path like s^4, with both kinds: its end tangents are exact to that order.
TEST(Newton, DenseOutputIsOfFourthOrder) {
  const TrussOnSpring law{0.3};
  for (const auto kind : kinds) {
    const auto inside = [&](double s) {
      NewtonOptions options;
      options.kind = kind;
      options.residualBound = 1e-12;
      options.accuracy = 1e-6;  // not reached with these lengths, but asks for tangents as exact
      options.firstStep = s;
      options.maxSteps = 1;
      NewtonFollowed<TrussOnSpring> f(law, {0.1, 0.1 + 0.1 * 0.9 * 1.9 / 0.3}, 0.1 * 0.9 * 1.9, options);
      EXPECT_EQ(f.record.steps.at(0).length, f.record.steps.at(0).radius);
      auto u = f.problem.vector({}), r = f.problem.vector({});
      const double lambda = f.record.series.at(0).evaluate(0.5 * f.record.steps.at(0).length, *u);
      return f.problem.residual({u, lambda}, *r).norm;
    };
    EXPECT_NEAR(order(inside, 0.0625), 4, 0.3) << static_cast<int>(kind);  // next power, as above
  }
}

/// What lies between the points of a path is as near to it as was asked, and steps go like accuracy^(1/4).
TEST(Newton, AccuracyIsKeptInsideSteps) {
  const Truss law;
  for (const auto kind : kinds) {
    int steps[2];
    for (const int level : {0, 1}) {
      NewtonOptions options;
      options.kind = kind;
      options.accuracy = level == 0 ? 1e-5 : 1e-9;
      options.residualBound = 1e-11;
      NewtonFollowed<Truss> f(law, {0}, 0, options, unknown(law, 0, 2.2));
      expectSound(f, 1e-11);
      double worst = 0;
      for (std::size_t i = 0; i < f.record.steps.size(); ++i)
        for (int j = 0; j <= 20; ++j) {
          auto u = f.problem.vector({}), r = f.problem.vector({});
          const double lambda = f.record.series[i].evaluate(f.record.steps[i].length * j / 20, *u);
          // |dlambda| at fixed u bounds the distance from above.
          worst = std::max(worst, f.problem.residual({u, lambda}, *r).norm);
        }
      EXPECT_LE(worst, 2 * options.accuracy);    // lambda alone is further away than the nearest point
      EXPECT_GE(worst, options.accuracy / 100);  // and no effort is wasted
      steps[level] = f.outcome.steps;
    }
    const double ratio = static_cast<double>(steps[1]) / steps[0];
    EXPECT_GT(ratio, 5);  // 10 by the order
    EXPECT_LT(ratio, 20);
  }
}

TEST(Newton, TrussSnapsThrough) {
  for (const auto kind : kinds) {
    NewtonOptions options;
    options.kind = kind;
    options.residualBound = 1e-9;
    options.accuracy = 1e-6;
    NewtonFollowed<Truss> f(Truss{}, {0}, 0, options, unknown(Truss{}, 0, 2.2));
    expectSound(f, 1e-9);
    EXPECT_NEAR(f.final(0), 2.2, 1e-9);
    EXPECT_NEAR(f.outcome.final.lambda, 2.2 * -1.2 * -0.2,
                1e-9);  // residual bound x scale 0.1, and some room
    const auto limits = f.record.limitPoints();
    ASSERT_EQ(limits.size(), 2u);
    // lambda is extremal there: off by the cubic's own error.
    EXPECT_NEAR(limits[0].lambda, 0.384900179459750, 2e-6);
    EXPECT_NEAR(limits[1].lambda, -0.384900179459750, 2e-6);
    EXPECT_TRUE(limits[0].maximum);
    EXPECT_FALSE(limits[1].maximum);
  }
}

/// Both the load and the displacement of the load point fold, with long steps too.
TEST(Newton, SpringLoadedTrussSnapsBack) {
  const double k = 0.3;
  const auto law = TrussOnSpring{k};
  for (const auto kind : kinds)
    for (const double accuracy : {1e-5, std::numeric_limits<double>::infinity()}) {
      NewtonOptions options;
      options.kind = kind;
      options.accuracy = accuracy;
      NewtonFollowed<TrussOnSpring> f(law, {0, 0}, 0, options, unknown(law, 0, 2.2));
      expectSound(f, 1e-6);
      const double load = 2.2 * -1.2 * -0.2;
      EXPECT_NEAR(f.outcome.final.lambda, load, 1e-6);  // residual bound x scale 0.1, and some room
      EXPECT_NEAR(f.final(1), 2.2 + load / k, 1e-5);
      std::vector<double> folds;
      for (std::size_t i = 0; i < f.record.series.size(); ++i) {
        const auto& s = f.record.series[i];
        for (const double a :
             s.functional(*f.problem.vector({0, 1})).derivative().roots(f.record.steps[i].length))
          folds.push_back(s.functional(*f.problem.vector({1, 0}))(a));
      }
      if (std::isfinite(accuracy)) {
        ASSERT_EQ(folds.size(), 2u);
        // A place of an extremum: error of the cubic over step length, 1e-5 / 0.1, and curvature of order 1.
        EXPECT_NEAR(folds[0], 1 - std::sqrt((1 - k) / 3), 2e-3);
        EXPECT_NEAR(folds[1], 1 + std::sqrt((1 - k) / 3), 2e-3);
      }
    }
}

/// The same path, fold and end as by series; the outside reference is the fold of the equation.
TEST(Newton, BratuAgreesWithTheSeries) {
  const ChebyshevBratu law(24, 1);
  JetProblem<ChebyshevBratu> problem(law);
  const int middle = law.size() - 1;
  Followed<ChebyshevBratu> series(law, std::vector<double>(law.size(), 0.0), 0, Options{},
                                  unknown(law, middle, 2.5));
  int factorizations[2];
  for (const auto kind : kinds) {
    NewtonOptions options;
    options.kind = kind;
    options.accuracy = 1e-5;
    NewtonFollowed<ChebyshevBratu> f(law, std::vector<double>(law.size(), 0.0), 0, options,
                                     unknown(law, middle, 2.5));
    expectSound(f, 1e-6);
    ASSERT_EQ(f.record.limitPoints().size(), 1u);
    EXPECT_NEAR(f.record.limitPoints()[0].lambda, 3.513830719125161, 2e-5);  // the cubic's error at the fold
    EXPECT_NEAR(f.outcome.final.lambda, series.outcome.final.lambda,
                1e-4);  // both residual bounds, 1e-6 x 50
    if (kind == NewtonKind::full) {
      EXPECT_EQ(f.outcome.factorizations,
                1 + f.outcome.startIterations + f.outcome.corrections + f.outcome.restarts);
    }
    factorizations[static_cast<int>(kind)] = f.outcome.factorizations;
    RecordProperty(kind == NewtonKind::full ? "full" : "modified", f.outcome.factorizations);
  }
  RecordProperty("series", series.outcome.factorizations);
  EXPECT_LT(factorizations[1], factorizations[0]);
}

/// Steps grow to what the iterations wanted allow: more of them, fewer steps.
TEST(Newton, StepsFollowTheDesiredIterations) {
  const auto law = TrussOnSpring{0.3};
  for (const auto kind : kinds) {
    int before = 1 << 30;
    for (const double desired : {1.5, 2.0, 3.0}) {
      NewtonOptions options;
      options.kind = kind;
      options.desiredIterations = desired;
      NewtonFollowed<TrussOnSpring> f(law, {0, 0}, 0, options, unknown(law, 0, 2.2));
      expectSound(f, 1e-6);
      EXPECT_LT(f.outcome.steps, before) << desired;
      before = f.outcome.steps;
      // What was asked for, give or take one: single steps have whole numbers of iterations, and some are
      // shorter for their angle or the stop. Rejected trials are not what was asked for.
      double iterations = 0;
      int steps = 0;
      for (const auto& r : f.record.steps)
        if (r.cutBacks == 0) {
          iterations += r.corrections;
          ++steps;
        }
      EXPECT_GT(2 * steps, f.outcome.steps) << desired;
      EXPECT_NEAR(iterations / steps, desired, 1) << desired;
    }
  }
}

TEST(Newton, StopsOfAllKinds) {
  const auto law = TrussOnSpring{0.3};
  for (const auto kind : kinds) {
    NewtonOptions options;
    options.kind = kind;
    options.residualBound = 1e-10;
    Stops load;
    load.loadFactors = {0.3};
    NewtonFollowed<TrussOnSpring> f(law, {0, 0}, 0, options, load);
    expectSound(f, 1e-10);
    EXPECT_NEAR(f.outcome.final.lambda, 0.3, 1e-14);  // held by the correction
    EXPECT_EQ(f.outcome.text, "load factor 0.3 reached");
    Stops length;
    length.pathLength = 0.5;
    NewtonFollowed<TrussOnSpring> g(law, {0, 0}, 0, options, length);
    expectSound(g, 1e-10);
    EXPECT_EQ(g.outcome.pathLength, 0.5);
    EXPECT_EQ(g.outcome.text, "path length 0.5 reached");
  }
}

/// Goes on from every third step with the same bits.
TEST(Newton, RestartsBitForBit) {
  const TrussOnSpring law{0.3};
  const Stops stops = unknown(law, 0, 2.2);
  for (const auto kind : kinds) {
    NewtonOptions options;
    options.kind = kind;
    options.maxStep = 0.2;
    NewtonFollowed<TrussOnSpring> whole(law, {0, 0}, 0, options, stops);
    const auto& all = whole.record.steps;
    ASSERT_GT(all.size(), 8u);
    for (std::size_t s = 0; s + 1 < all.size(); s += 3) {
      JetProblem<TrussOnSpring> again(law);
      DenseSolver solver;
      Record record;
      const Outcome outcome = NewtonFollower(again, solver, options, stops).runFrom(all[s].next, record);
      EXPECT_EQ(outcome.reason, EndReason::stopReached);
      ASSERT_EQ(record.steps.size(), all.size() - s - 1);
      for (std::size_t i = 0; i < record.steps.size(); ++i) {
        EXPECT_EQ(record.steps[i].lambdaEnd, all[s + 1 + i].lambdaEnd);
        EXPECT_EQ(record.steps[i].pathLengthEnd, all[s + 1 + i].pathLengthEnd);
        EXPECT_EQ(record.steps[i].step, all[s + 1 + i].step);
      }
    }
  }
}

/// The straight column's first buckling load is passed, not found: one eigenvalue is left unexplained.
TEST(Newton, BifurcationPointsAreSeenInTheInertia) {
  Column law;
  law.n = 8;
  Stops stops = loads({1.3 * law.buckling(1)});
  NewtonOptions options;
  options.maxStep = 0.2;
  NewtonFollowed<Column, SymmetricDenseSolver> f(law, std::vector<double>(law.size(), 0.0), 0, options,
                                                 stops);
  expectSound(f, 1e-6);
  int unexplained = 0;
  for (const auto& s : f.record.steps) {
    unexplained += s.unexplained;
    if (s.unexplained > 0) {
      EXPECT_LT(s.lambdaStart, law.buckling(1));
      EXPECT_GE(s.lambdaEnd, law.buckling(1));
    }
  }
  EXPECT_EQ(unexplained, 1);
}

/// The snap-through's limit points explain their own changes of sign.
TEST(Newton, LimitPointsExplainTheInertia) {
  const auto law = TrussOnSpring{0.3};
  NewtonOptions options;
  options.accuracy = 1e-5;
  NewtonFollowed<TrussOnSpring, SymmetricDenseSolver> f(law, {0, 0}, 0, options, unknown(law, 0, 2.2));
  expectSound(f, 1e-6);
  long long largest = 0;
  for (const auto& s : f.record.steps) {
    EXPECT_EQ(s.unexplained, 0);
    if (s.inertiaEnd) largest = std::max(largest, s.inertiaEnd->negative);
  }
  EXPECT_EQ(largest, 1);
}

/// A first step onto the falling part is cut back to where the path turns less.
TEST(Newton, CutsBackStepsThatAreTooLong) {
  for (const auto kind : kinds) {
    NewtonOptions options;
    options.kind = kind;
    options.firstStep = 1;
    NewtonFollowed<Truss> f(Truss{}, {0}, 0, options, unknown(Truss{}, 0, 2.2));
    expectSound(f, 1e-6);
    EXPECT_NEAR(f.outcome.final.lambda, 2.2 * -1.2 * -0.2, 1e-6);
    int cutBacks = 0;
    for (const auto& s : f.record.steps) cutBacks += s.cutBacks;
    EXPECT_GT(f.record.steps[0].cutBacks, 0);
    EXPECT_EQ(cutBacks, f.outcome.cutBacks);
  }
}

/// Contact that closes, nearly hard.
TEST(Newton, ContactCloses) {
  Stops stops = loads({20});
  for (const auto kind : kinds) {
    NewtonOptions options;
    options.kind = kind;
    NewtonFollowed<Contact> f(Contact{1e6, 1e-5}, {0}, 0, options, stops);
    expectSound(f, 1e-6);
    // h = -R/alpha + eta (Delta - h)/R with R = 19 up to 2e-5, Delta = 1.
    const double h = -19 / 1e6 + 1e-5 / 19;
    EXPECT_NEAR(f.final(0), 1 - h,
                1e-10);  // 1e-5 h for R and Delta - h; the residual, 1e-6, over alpha is less
  }
}

TEST(Newton, EndsWithAReason) {
  const auto law = TrussOnSpring{0.3};
  NewtonOptions few;
  few.maxSteps = 3;
  EXPECT_EQ((NewtonFollowed<TrussOnSpring>(law, {0, 0}, 0, few).outcome.reason), EndReason::stepLimit);

  JetProblem<TrussOnSpring> problem(law);
  DenseSolver solver;
  Record record;
  record.goOn = [&] { return record.steps.size() < 2; };
  auto outcome = NewtonFollower(problem, solver, NewtonOptions{}).run({problem.vector({}), 0}, record);
  EXPECT_EQ(outcome.reason, EndReason::observerStopped);
  EXPECT_EQ(outcome.steps, 2);

  EXPECT_EQ((NewtonFollowed<Fold>(Fold{}, {0}, 0, NewtonOptions{}).outcome.reason),
            EndReason::singularTangent);
  // u^2 = lambda has no state at lambda = -1.
  EXPECT_EQ((NewtonFollowed<Fold>(Fold{}, {1}, -1, NewtonOptions{}).outcome.reason),
            EndReason::startNotInEquilibrium);

  struct Throws : JetProblem<TrussOnSpring> {
    using JetProblem::JetProblem;
    int calls = 0;
    Teuchos::RCP<const CrsMatrix> tangent(const State& state, Vector& F) override {
      if (++calls > 3) throw std::runtime_error("element 7 is inverted");
      return JetProblem::tangent(state, F);
    }
  } throws(law);
  NewtonOptions coarse;
  coarse.minStep = 1e-3;
  Record another;
  outcome = NewtonFollower(throws, solver, coarse).run({throws.vector({}), 0}, another);
  EXPECT_EQ(outcome.reason, EndReason::stepTooSmall);
  EXPECT_NE(outcome.text.find("element 7 is inverted"), std::string::npos) << outcome.text;

  struct OutOfMemory : DenseSolver {
    void factor(const Teuchos::RCP<const CrsMatrix>& K) override {
      if (counters().factorizations == 4) throw atrapos::linear::SolverError("no memory left");
      DenseSolver::factor(K);
    }
  } broke;
  JetProblem<TrussOnSpring> again(law);
  outcome = NewtonFollower(again, broke, NewtonOptions{}).run({again.vector({}), 0}, another);
  EXPECT_EQ(outcome.reason, EndReason::solverFailed);
  EXPECT_EQ(outcome.text, "no memory left");

  // A bound below rounding cannot be met.
  NewtonOptions tiny;
  tiny.residualBound = 1e-30;
  tiny.maxStartIterations = 0;
  NewtonFollowed<TrussOnSpring> f(law, {0, 0}, 0, tiny);
  EXPECT_EQ(f.outcome.reason, EndReason::stepTooSmall) << f.outcome.text;
}

TEST(Newton, OptionsAreChecked) {
  const auto message = [](auto change) {
    NewtonOptions options;
    change(options);
    try {
      options.validate();
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  EXPECT_EQ(message([](NewtonOptions&) {}), "accepted");
  EXPECT_EQ(message([](NewtonOptions& o) { o.maxGrowth = 1; }),
            "newton options: maxGrowth = 1, must be more than 1");
  EXPECT_EQ(message([](NewtonOptions& o) { o.accuracy = 0; }),
            "newton options: accuracy = 0, must be positive");
  EXPECT_EQ(message([](NewtonOptions& o) { o.maxIterations = 0; }),
            "newton options: maxIterations = 0, must be at least minIterations");
}

}  // namespace
