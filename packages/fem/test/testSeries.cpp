// Order-k right-hand sides: where U_1..U_K solve the order equations, what is left of the residual along the
// series starts at order K+1. A mistake in any order shows as a lower rate.
#include <gtest/gtest.h>

#include <cmath>

#include "atrapos/linear/MakeTangentSolver.hpp"
#include "atrapos/path/SeriesStep.hpp"
#include "support/Checks.hpp"
#include "support/Model.hpp"
#include "support/Vectors.hpp"

using namespace atrapos::fem;
using namespace atrapos::fem::test;
namespace path = atrapos::path;

namespace {

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
    problem.beginSeries({vectorOf(problem, u), 0}, maxOrder);
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
  model.dofs = DofMap::displacements(mesh.numNodes());
  model.terms = solidTerms(mesh);
  FeProblem problem(std::move(model));
  const auto shape = atrapos::taylor::historyShape(ExponentialSolid{});
  const std::size_t batches = (18 + kLanes - 1) / kLanes;
  EXPECT_EQ(problem.historyBytes(20), batches * 8 * shape.doubles<kLanes>(20) * sizeof(double));
}
