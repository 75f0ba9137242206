#include "ShellChecks.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "atrapos/linear/MakeTangentSolver.hpp"
#include "atrapos/path/SeriesStep.hpp"
#include "support/Meshes.hpp"

namespace atrapos::solid::test {

using namespace fem::test;

namespace {

path::Series series(fem::FeProblem& problem, const Numbers& u, double lambda, int order) {
  linear::TangentSolverOptions options;
  options.symmetric = problem.symmetric();
  const auto solver = linear::makeTangentSolver(options);
  path::Calls calls(problem, *solver);
  path::SeriesRequest request;
  request.order = order;
  return path::buildSeries(calls, {vectorOf(problem, u), lambda}, request);
}

}  // namespace

Numbers randomState(const fem::FeModel& model, double amplitude, unsigned seed) {
  Numbers u = randomNumbers(model.dofs.numDofs(), amplitude, seed);
  for (std::size_t d = 0; d < u.size(); ++d)
    if (model.supports.fixed(static_cast<int>(d))) u[d] = 0;
  return u;
}

void keepTo(const fem::FeModel& model, double lambda, Numbers& u) {
  for (const auto& c : model.couplings.resolved(model.dofs, model.supports)) {
    u[c.dof] = lambda * c.perLoadFactor;
    for (const auto& m : c.masters) u[c.dof] += m.factor * u[m.dof];
  }
}

void expectTangent(fem::FeProblem& problem, const Numbers& u, const Numbers& direction, double lambda) {
  const Numbers exact = tangent(problem, u, lambda).times(direction);
  const auto error = [&](double h) {
    const Numbers ahead = residual(problem, sum(u, h, direction), lambda).r,
                  behind = residual(problem, sum(u, -h, direction), lambda).r;
    Numbers e = exact;
    for (std::size_t d = 0; d < e.size(); ++d) e[d] -= (ahead[d] - behind[d]) / (2 * h);
    return norm(e) / norm(exact);
  };
  const double coarse = error(0.1), fine = error(0.05);
  EXPECT_GT(coarse, 1e-7);                        // far above rounding, 1e-16/h
  EXPECT_NEAR(std::log2(coarse / fine), 2, 0.1);  // the next term is h^2 smaller
}

void expectOrders(fem::FeProblem& problem, const Numbers& u0, double lambda0) {
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
      const auto r = residual(problem, fem::FeProblem::values(*u), lambda);
      return norm(sum(r.r, -1, R0)) / r.norm.scale;
    };
    // A remainder of 1e-8 of its size at the unit: above rounding at a/2 too, and a small against the radius.
    const double a = std::pow(1e-8, 1.0 / (K + 1)) * unit;
    EXPECT_NEAR(std::log2(left(a) / left(a / 2)), K + 1, 0.25);
  }
}

int expectSymmetricTangentAndOrders(fem::FeModel model) {
  model.load = randomNumbers(model.dofs.numDofs(), 0.002, 3);
  const Numbers u = randomState(model, 0.02, 17);
  Numbers direction = randomState(model, 0.02, 18);
  keepTo(model, 0, direction);
  fem::FeProblem problem(std::move(model));
  EXPECT_TRUE(problem.symmetric());
  const int pivots = problem.constraintPivots();
  expectTangent(problem, u, direction, 0);
  expectOrders(problem, u, 0.4);
  return pivots;
}

}  // namespace atrapos::solid::test
