// Order-k right-hand sides: where U_1..U_K solve the order equations, what is left of the residual along the
// series starts at order K+1. A mistake in any order shows as a lower rate.
#include <gtest/gtest.h>

#include <cmath>

#include "atrapos/linear/MakeTangentSolver.hpp"
#include "atrapos/path/SeriesStep.hpp"
#include "support/Model.hpp"
#include "support/Vectors.hpp"

using namespace atrapos::fem;
using namespace atrapos::fem::test;
namespace path = atrapos::path;

namespace {

path::Series series(FeProblem& problem, const Numbers& u, double lambda, int order) {
  atrapos::linear::TangentSolverOptions options;
  options.symmetric = problem.symmetric();
  const auto solver = atrapos::linear::makeTangentSolver(options);
  path::Calls calls(problem, *solver);
  path::SeriesRequest request;
  request.order = order;
  return path::buildSeries(calls, {vectorOf(problem, u), lambda}, request);
}

/// U0 need not be an equilibrium: its own residual R0 is constant along the series and taken off.
void checkOrders(FeModel model) {
  const int numDofs = 3 * model.numNodes;
  const Supports supports = model.supports;
  std::vector<char> used(model.numNodes, 0);
  for (const auto& term : model.terms)
    for (int n : term->nodes()) used[n] = 1;
  FeProblem problem(std::move(model));
  const double lambda0 = 0.4;
  Numbers u0 = FeProblem::values(*problem.initialState(lambda0));
  const Numbers perturbation = randomNumbers(numDofs, 0.01, 41);
  for (int d = 0; d < numDofs; ++d)
    if (!supports.fixed(d) && used[d / 3]) u0[d] += perturbation[d];
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
      const auto r = residual(problem, values, lambda);
      return norm(sum(r.r, -1, R0)) / r.norm.scale;
    };
    // Where the remainder is about 1e-8 of its size at the unit: far above rounding at a/2 too (1e-12 for
    // K = 10), and a small against the radius, so that order K+2 adds to the rate no more than about a/unit.
    const double a = std::pow(1e-8, 1.0 / (K + 1)) * unit;
    const double rate = std::log2(left(a) / left(a / 2));
    EXPECT_NEAR(rate, K + 1, 0.25);
  }
}

class SeriesOfCells : public testing::TestWithParam<Topology> {};

}  // namespace

TEST_P(SeriesOfCells, ResidualStartsAtOrderKPlusOne) {
  checkOrders(busyModel(distorted(box(GetParam(), {2, 2, 3}), 0.03)));
}

INSTANTIATE_TEST_SUITE_P(All, SeriesOfCells, testing::ValuesIn(allCells()),
                         [](const auto& info) { return std::string(topologyName(info.param)); });

TEST(Series, SeveralBlocksAndTerms) {
  const Mesh mesh = mixedMesh();
  FeModel model = busyModel(mesh);
  for (const PointSet& p : facePoints(mesh, sideSet(mesh, "x_max"), 3)) {
    model.terms.push_back(lawTerm(pointLaw(CentralForce{0.5}), p));
    model.terms.push_back(lawTerm(pointLaw(Swirl{0.2}), p));
    model.terms.push_back(lawTerm(pointLaw(MovingPull{0.2}), p));
  }
  model.terms.push_back(lawTerm(pointLaw(CentralForce{0.7}), nodePoints(mesh, {3, 8, 50})));
  checkOrders(std::move(model));
}

// A second series of another order in the same problem: histories of the first must not shine through.
TEST(Series, HistoriesStartAfresh) {
  const Mesh mesh = box(Topology::Hex8);
  FeProblem used(busyModel(mesh)), fresh(busyModel(mesh));
  const Numbers u1 = randomNumbers(3 * mesh.numNodes(), 0.02, 1),
                u2 = randomNumbers(3 * mesh.numNodes(), 0.02, 2);
  const auto orderThree = [&](FeProblem& problem, const Numbers& u, int maxOrder) {
    problem.beginSeries(*vectorOf(problem, u), 0, maxOrder);
    auto F = zeroVector(problem);
    for (int k = 1; k <= 3; ++k) {
      problem.orderRhs(k, *F);
      problem.completeOrder(k, *vectorOf(problem, randomNumbers(u.size(), 0.1, 50 + k)), 0);
    }
    return FeProblem::values(*F);
  };
  orderThree(used, u1, 8);
  EXPECT_EQ(orderThree(used, u2, 3), orderThree(fresh, u2, 3));
  orderThree(used, u1, 3);
  EXPECT_EQ(orderThree(used, u2, 3), orderThree(fresh, u2, 3));
  EXPECT_GT(norm(orderThree(fresh, u2, 3)), 1e-6);
}

TEST(Series, HistoryBytes) {
  const Mesh mesh = box(Topology::Hex8);  // 18 cells of 8 points
  FeModel model;
  model.numNodes = mesh.numNodes();
  model.terms = solidTerms(mesh);
  model.supports = Supports(mesh.numNodes());
  FeProblem problem(std::move(model));
  const auto shape = atrapos::taylor::historyShape(ExponentialSolid{});
  const std::size_t batches = (18 + kLanes - 1) / kLanes;
  EXPECT_EQ(problem.historyBytes(20), batches * 8 * shape.doubles<kLanes>(20) * sizeof(double));
}
