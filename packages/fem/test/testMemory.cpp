// States that remember: rate laws in elements, along paths through limit points, forward and back.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "atrapos/linear/MakeTangentSolver.hpp"
#include "atrapos/path/NewtonFollower.hpp"
#include "atrapos/path/PathFollower.hpp"
#include "atrapos/path/SeriesStep.hpp"
#include "atrapos/taylor/Rate.hpp"
#include "support/Model.hpp"
#include "support/Steps.hpp"
#include "support/Vectors.hpp"

using namespace atrapos;
using namespace atrapos::fem;
using namespace atrapos::fem::test;

namespace {

/// A bar's stress S = E - p along its current vector c over its length, E = (c.c - 1)/2 Green's strain; p'
/// = fading E' + (E - p) lambda'/tau: `fading` makes S a function of E, a relaxation time what it is on the
/// way. Modulus 1.
struct FadingBar {
  static constexpr int numInputs = 4, numOutputs = 4, numData = 1, numVariables = 1;
  static constexpr bool symmetric = true;
  double fading = 0, rate = 0;  ///< of S, by E; 1/tau

  struct Rate {
    double fading, rate;
    template <class T, class R>
    KOKKOS_INLINE_FUNCTION void operator()(const T* v, const T* z, const R* dv, const R* dz, R* g) const {
      const T stress = v[0] - z[0];
      g[0] = dz[0] - fading * stress * dv[0] - rate * stress * dv[1];
    }
  };

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* in, const taylor::Passive<T>* data, T* out) const {
    T v[2];
    v[0] = 0.5 * (in[0] * in[0] + in[1] * in[1] + in[2] * in[2] - 1.0);
    v[1] = in[3];
    out[3] = T(data[0]);
    taylor::solveRate<2, 1>(Rate{fading, rate}, v, out + 3);
    const T stress = v[0] - out[3];
    for (int i = 0; i < 3; ++i) out[i] = stress * in[i];
  }
};

/// Maxwell's solid: stresses H - p by displacement gradients, p' = (H - p) lambda'/tau + p_11 H' swept; every
/// component by itself but for the last term, which makes p depend on the way.
struct SweptSolid {
  static constexpr int numInputs = 10, numOutputs = 18, numData = 9, numVariables = 9;
  static constexpr bool symmetric = false;

  struct Rate {
    template <class T, class R>
    KOKKOS_INLINE_FUNCTION void operator()(const T* v, const T* z, const R* dv, const R* dz, R* g) const {
      for (int i = 0; i < 9; ++i)
        g[i] = dz[i] - 0.5 * (v[i] - z[i]) * dv[9] - (0.3 + z[(i + 1) % 9]) * v[(i + 2) % 9] * dv[i];
    }
  };

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* in, const taylor::Passive<T>* data, T* out) const {
    for (int i = 0; i < 9; ++i) out[9 + i] = T(data[i]);
    taylor::solveRate<10, 9>(Rate{}, in, out + 9);
    for (int i = 0; i < 9; ++i) out[i] = in[i] - out[9 + i] + 0.2 * in[i] * in[(i + 4) % 9];
  }
};

}  // namespace

ATRAPOS_POINT_LAW(FadingBar)
ATRAPOS_POINT_LAW(SweptSolid)

namespace {

/// Half of von Mises' truss: a bar from the origin to its apex (1, 0, h), which moves along z under -lambda.
struct Truss {
  double h = 0.5, length = std::sqrt(1 + 0.25);
  FadingBar law;
  std::unique_ptr<FeProblem> problem;

  explicit Truss(const FadingBar& bar) : law(bar) {
    PointSet bars;
    bars.numEntities = bars.pointsPerEntity = 1;
    bars.nodesPerEntity = 2;
    bars.shapeComponents = 1;
    bars.nodes = {0, 1};
    bars.shape = {-1 / length, 1 / length};
    bars.weights = {length};
    bars.positions = {1 / length, 0,
                      h / length};  // the place that the inputs begin with: the bar's direction
    FeModel model;
    model.dofs = DofMap::displacements(2);
    model.terms.push_back(lawTerm(pointLaw(bar), bars, {0.0}));
    for (int i = 0; i < 3; ++i) model.prescribe(0, i, 0, 0);
    for (int i = 0; i < 2; ++i) model.prescribe(1, i, 0, 0);
    model.load = {0, 0, 0, 0, 0, -load};
    problem = std::make_unique<FeProblem>(std::move(model));
  }

  static constexpr double load = 0.01;
  double strain(double w) const { return ((h - w) * (h - w) - h * h) / (2 * length * length); }
  double lambda(double w, double stress) const { return -stress * (h - w) / (length * load); }
  /// S at E where the strain alone counts: S' = (1 - fading S) E'.
  double fadedStress(double E) const { return -std::expm1(-law.fading * E) / law.fading; }
};

double downwards(const path::State& state) { return -FeProblem::values(*state.u)[5]; }

/// The path until the apex is w below where it began, or above.
struct Followed {
  Steps steps;
  path::Outcome outcome;

  Followed(Truss& truss, const path::Start& start, double w, path::Options options = {}) {
    options.delta = 1e-10;
    options.residualBound = 1e-10;
    const auto solver = linear::makeTangentSolver();
    outcome = path::PathFollower(*truss.problem, *solver, options, stopAt(truss, w)).runFrom(start, steps);
  }
  static path::Stops stopAt(const Truss& truss, double w) {
    path::Stops stops;
    stops.functionals = {{"w", vectorOf(*truss.problem, {0, 0, 0, 0, 0, -1}), w}};
    return stops;
  }
};

path::Start unloaded(Truss& truss) {
  path::Start start;
  start.state = {truss.problem->initialState(0), 0.0};
  return start;
}

/// Lambda and p of FadingBar in the truss at w, by Runge's and Kutta's method with `steps` steps from 0.
std::pair<double, double> byRunge(const Truss& t, double w, int steps) {
  const auto slope = [&](double x, double p) {
    const double E = t.strain(x), Ew = -(t.h - x) / (t.length * t.length), S = E - p;
    // lambda_w = -(1/(L P)) (S_w (h - w) - S),  S_w = E_w - p_w,  p_w = S (fading E_w + lambda_w / tau)
    const double c = 1 / (t.length * Truss::load), arm = t.h - x;
    const double lambdaW = -c * ((Ew - S * t.law.fading * Ew) * arm - S) / (1 - c * arm * S * t.law.rate);
    return S * (t.law.fading * Ew + t.law.rate * lambdaW);
  };
  double p = 0;
  const double d = w / steps;
  for (int i = 0; i < steps; ++i) {
    const double x = i * d, k1 = slope(x, p), k2 = slope(x + d / 2, p + d / 2 * k1),
                 k3 = slope(x + d / 2, p + d / 2 * k2), k4 = slope(x + d, p + d * k3);
    p += d / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  return {t.lambda(w, t.strain(w) - p), p};
}

}  // namespace

// Through both limit points to the far side, where S is a function of E: the path is known.
TEST(Memory, PathThroughLimitPointsAgainstClosedForm) {
  Truss truss({-3, 0});
  const Followed f(truss, unloaded(truss), 1.2);
  ASSERT_EQ(f.outcome.reason, path::EndReason::stopReached) << f.outcome.text;
  EXPECT_LE(f.outcome.steps, 20);
  int limits = 0;
  for (std::size_t s = 0; s < f.steps.reports.size(); ++s) {
    for (int i = 0; i <= 5; ++i) {
      const path::State state = f.steps.series[s].state(f.steps.reports[s].length * i / 5);
      const double w = downwards(state), E = truss.strain(w), S = truss.fadedStress(E);
      // Steps are good to 1e-10 of forces of about 1, each; they add up.
      EXPECT_NEAR(state.lambda, truss.lambda(w, S), 1e-8);
      EXPECT_NEAR(state.memory->variables.at(0), E - S, 1e-9);
    }
    limits += static_cast<int>(f.steps.reports[s].limitPoints.size());
  }
  EXPECT_EQ(limits, 2);
}

// A stress that fades with the load: the path depends on itself.
TEST(Memory, PathThroughLimitPointsAgainstRunge) {
  Truss truss({-1, 0.1});
  const Followed f(truss, unloaded(truss), 1.2);
  ASSERT_EQ(f.outcome.reason, path::EndReason::stopReached) << f.outcome.text;
  int limits = 0;
  for (std::size_t s = 0; s < f.steps.reports.size(); ++s) {
    const path::State state = f.steps.series[s].state(0.6 * f.steps.reports[s].length);
    const auto [lambda, p] = byRunge(truss, downwards(state), 4000);
    EXPECT_NEAR(state.lambda, lambda, 1e-8);  // Runge's own error: 1e-12
    EXPECT_NEAR(state.memory->variables.at(0), p, 1e-9);
    limits += static_cast<int>(f.steps.reports[s].limitPoints.size());
  }
  EXPECT_EQ(limits, 2);
}

// A rate law has no arrow: back from the end, through the same states to the start.
TEST(Memory, BackTheSameWay) {
  Truss truss({-1, 0.1});
  const Followed forward(truss, unloaded(truss), 1.2);
  path::Start turned;
  turned.state = forward.outcome.final;
  path::Options options;
  options.direction = -1;  // the load grows at the end of the way there
  const Followed back(truss, turned, 1e-3, options);
  ASSERT_EQ(back.outcome.reason, path::EndReason::stopReached) << back.outcome.text;
  const auto [lambda, p] = byRunge(truss, 1e-3, 10);
  EXPECT_NEAR(back.outcome.final.lambda, lambda, 1e-7);
  EXPECT_NEAR(back.outcome.final.memory->variables.at(0), p, 1e-8);
}

TEST(Memory, ARestartKeepsTheBits) {
  Truss truss({-1, 0.1});
  const Followed whole(truss, unloaded(truss), 1.2);
  ASSERT_GE(whole.outcome.steps, 4);
  Truss again({-1, 0.1});
  const Followed rest(again, whole.steps.reports[1].next, 1.2);
  ASSERT_EQ(rest.steps.reports.size() + 2, whole.steps.reports.size());
  EXPECT_EQ(rest.outcome.final.lambda, whole.outcome.final.lambda);
  EXPECT_EQ(rest.outcome.final.memory->variables, whole.outcome.final.memory->variables);
}

// Newton's steps take the way between two states for straight: second order in the length of the steps.
TEST(Memory, NewtonsStepsConvergeToThePath) {
  Truss truss({-1, 0.1});
  const auto error = [&](double step) {
    path::NewtonOptions options;
    options.residualBound = 1e-12;
    options.firstStep = options.maxStep = step;
    options.desiredIterations = 100;
    options.maxIterations = 40;
    const auto solver = linear::makeTangentSolver();
    Steps steps;
    path::NewtonFollower follower(*truss.problem, *solver, options, Followed::stopAt(truss, 0.4));
    const auto outcome = follower.runFrom(unloaded(truss), steps);
    EXPECT_EQ(outcome.reason, path::EndReason::stopReached) << outcome.text;
    const auto [lambda, p] = byRunge(truss, 0.4, 4000);
    return std::abs(outcome.final.lambda - lambda);
  };
  const double coarse = error(0.1), fine = error(0.05);
  EXPECT_NEAR(std::log2(coarse / fine), 2, 0.3);
}

namespace {

/// A distorted block of eight cells with SweptSolid; variables that differ from point to point.
FeModel sweptBlock() {
  const Mesh mesh = distorted(box(Topology::Hex8, {2, 2, 2}), 0.05);
  const PointSet points = volumePoints(mesh, mesh.blocks[0], tabulate(Topology::Hex8));
  FeModel model;
  model.dofs = DofMap::displacements(mesh.numNodes());
  model.terms.push_back(
      lawTerm(pointLaw(SweptSolid{}), points, randomNumbers(9 * points.numPoints(), 0.05, 3)));
  for (int n = 0; n < mesh.numNodes(); ++n)
    if (mesh.coordinates[3 * n] < 0.1)
      for (int i = 0; i < 3; ++i) model.prescribe(n, i, 0, 0);
  model.load = randomNumbers(model.dofs.numDofs(), 0.02, 5);
  return model;
}

}  // namespace

// K_T and F are those of the residual around a state on the path, with the variables carried there: central
// differences, whose error falls by 4.
TEST(Memory, TangentIsTheDerivativeAroundAState) {
  FeProblem problem(sweptBlock());
  ASSERT_TRUE(problem.remembers());
  const Numbers u = randomNumbers(problem.model().dofs.numDofs(), 0.05, 7);
  const path::State at = problem.settled({vectorOf(problem, u), 0.2});
  const Tangent K = tangent(problem, u, 0.2, at.memory);
  Numbers d = randomNumbers(u.size(), 1, 8);
  for (std::size_t i = 0; i < d.size(); ++i)
    if (problem.model().supports.fixed(static_cast<int>(i))) d[i] = 0;
  const double rate = 0.7;
  const Numbers exact = sum(K.times(d), -rate, K.F);
  double before = 0;
  for (double step = 8e-3; step > 8e-4; step /= 2) {
    const Numbers plus = residual(problem, sum(u, step, d), 0.2 + rate * step, at.memory).r,
                  minus = residual(problem, sum(u, -step, d), 0.2 - rate * step, at.memory).r;
    Numbers error = sum(plus, -1, minus);
    for (std::size_t i = 0; i < error.size(); ++i) error[i] = error[i] / (2 * step) - exact[i];
    const double now = norm(error);
    if (before > 0) {
      EXPECT_NEAR(before / now, 4, 0.1) << step;
    }
    before = now;
  }
  EXPECT_LT(before, 1e-4 * norm(exact));
}

// All orders: a series' states are in balance, and their variables those that a fine polygon leads to.
TEST(Memory, OrdersAreThoseOfTheRates) {
  FeProblem problem(sweptBlock());
  linear::TangentSolverOptions unsymmetric;
  unsymmetric.symmetric = false;
  const auto solver = linear::makeTangentSolver(unsymmetric);
  path::Calls calls(problem, *solver);
  const Numbers start = equilibrium(problem, 0, FeProblem::values(*problem.initialState(0))).u;
  const path::State at = problem.settled({vectorOf(problem, start), 0.0});
  auto r = zeroVector(problem);
  for (const int order : {1, 3, 6}) {
    path::SeriesRequest request;
    request.order = order;
    const auto series = path::buildSeries(calls, at, request);
    const auto size = [&](double a) { return problem.residual(series.state(a), *r).relative(); };
    double a = 1e-3;
    while (size(a) < 1e-6) a *= 1.2;
    EXPECT_NEAR(std::log2(size(a) / size(a / 2)), order + 1, 0.15 * (order + 1)) << order;
  }
  path::SeriesRequest request;
  request.order = 16;
  const auto series = path::buildSeries(calls, at, request);
  const double length = 0.5 * series.radius(1e-8);
  // The polygon's error falls by 4.
  const auto error = [&](int pieces) {
    path::State state = at;
    for (int i = 1; i <= pieces; ++i) {
      const path::State next = series.state(length * i / pieces);
      state = problem.settled(state.at(next.u, next.lambda));
    }
    return norm(sum(state.memory->variables, -1, series.state(length).memory->variables));
  };
  const double coarse = error(8), fine = error(16);
  EXPECT_NEAR(coarse / fine, 4, 0.3);
  EXPECT_LT(fine, 1e-3 * norm(series.state(length).memory->variables));
}

TEST(Memory, StatesOfAnotherProblemAreRefused) {
  FeProblem problem(sweptBlock());
  auto memory = std::make_shared<path::Memory>();
  memory->variables = {1, 2, 3};
  memory->u = problem.initialState(0);
  auto r = zeroVector(problem);
  EXPECT_THROW(problem.residual({problem.initialState(0), 0, memory}, *r), std::invalid_argument);
}
