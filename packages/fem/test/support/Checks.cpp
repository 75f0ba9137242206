#include "support/Checks.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "atrapos/linear/MakeTangentSolver.hpp"
#include "atrapos/path/SeriesStep.hpp"
#include "support/Meshes.hpp"
#include "support/Vectors.hpp"

namespace atrapos::fem::test {
namespace {

/// [dof] whether an entity has its node.
std::vector<char> usedDofs(const FeModel& model) {
  std::vector<char> used(model.dofs.numDofs(), 0);
  for (const auto& term : model.terms)
    for (int n : term->nodes())
      for (int d = model.dofs.firstDof(n); d < model.dofs.firstDof(n + 1); ++d) used[d] = 1;
  return used;
}

/// A change of (u, lambda) that keeps to the supports.
struct Direction {
  Numbers u;
  double lambda;
};
Direction randomDirection(const FeModel& model, double amplitude, unsigned seed) {
  Direction d{randomNumbers(model.dofs.numDofs(), amplitude, seed), 0.3};
  const auto used = usedDofs(model);
  for (int i = 0; i < model.dofs.numDofs(); ++i)
    if (model.supports.fixed(i) || !used[i]) d.u[i] = d.lambda * model.supports.perLoadFactor(i);
  return d;
}

path::Series series(FeProblem& problem, const Numbers& u, double lambda, int order) {
  atrapos::linear::TangentSolverOptions options;
  options.symmetric = problem.symmetric();
  const auto solver = atrapos::linear::makeTangentSolver(options);
  path::Calls calls(problem, *solver);
  path::SeriesRequest request;
  request.order = order;
  return path::buildSeries(calls, {vectorOf(problem, u), lambda}, request);
}

}  // namespace

void checkTangent(FeModel model) {
  const Numbers u = randomNumbers(model.dofs.numDofs(), 0.02, 31);
  const Direction d = randomDirection(model, 0.05, 32);
  FeProblem problem(std::move(model));
  const double lambda = 0.4;
  const Tangent K = tangent(problem, u, lambda);
  const Numbers exact = sum(K.times(d.u), -d.lambda, K.F);
  const auto error = [&](double h) {
    const Numbers plus = residual(problem, sum(u, h, d.u), lambda + h * d.lambda).r;
    const Numbers minus = residual(problem, sum(u, -h, d.u), lambda - h * d.lambda).r;
    return norm(sum(sum(plus, -1, minus), -2 * h, exact)) / (2 * h * norm(exact));
  };
  const double coarse = error(0.2), fine = error(0.1);
  // h^2 with terms of h^4 behind, which are about 1 % at these h.
  EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.1) << coarse << ' ' << fine;
  // Truncation at h = 1e-4 is 1e-6 of that at 0.1, rounding 1e-16 / h.
  EXPECT_LT(error(1e-4), 1e-6 * fine + 1e-11);
}

// U0 need not be an equilibrium: its own residual R0 is constant along the series and taken off.
void checkOrders(FeModel model) {
  const int numDofs = model.dofs.numDofs();
  const Supports supports = model.supports;
  const auto used = usedDofs(model);
  FeProblem problem(std::move(model));
  const double lambda0 = 0.4;
  Numbers u0 = FeProblem::values(*problem.initialState(lambda0));
  const Numbers perturbation = randomNumbers(numDofs, 0.01, 41);
  for (int d = 0; d < numDofs; ++d)
    if (!supports.fixed(d) && used[d]) u0[d] += perturbation[d];
  const Numbers R0 = residual(problem, u0, lambda0).r;

  const int longest = 12;
  const path::Series reference = series(problem, u0, lambda0, longest);
  const double unit = std::pow(reference.norm(1) / reference.norm(longest), 1.0 / (longest - 1));
  ASSERT_TRUE(std::isfinite(unit));

  for (int K : {1, 3, 6, 10}) {
    SCOPED_TRACE("order " + std::to_string(K));
    const path::Series part = series(problem, u0, lambda0, K);
    auto u = zeroVector(problem);
    const auto left = [&](double a) {
      const double lambda = part.evaluate(a, *u);
      const Numbers values = FeProblem::values(*u);
      for (int d = 0; d < numDofs; ++d)  // the series keeps to the supports
        if (supports.fixed(d)) {
          EXPECT_NEAR(values[d], supports.at(d, lambda), 1e-14);
        }
      return norm(sum(residual(problem, values, lambda).r, -1, R0));
    };
    // Where the remainder is about 1e-8 of its size at the unit: far above rounding at a/2 too (1e-12 for
    // K = 10), and a small against the radius, so that order K+2 adds to the rate no more than about a/unit.
    const double a = std::pow(1e-8, 1.0 / (K + 1)) * unit;
    const double rate = std::log2(left(a) / left(a / 2));
    EXPECT_NEAR(rate, K + 1, 0.25);
  }
}

}  // namespace atrapos::fem::test
