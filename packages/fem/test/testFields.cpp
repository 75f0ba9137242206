// Problems of several fields with different nodes and shape functions.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "support/Checks.hpp"
#include "support/Model.hpp"
#include "support/Vectors.hpp"

using namespace atrapos::fem;
using namespace atrapos::fem::test;

namespace {

Mesh body() { return distorted(box(Topology::Hex20, {3, 2, 2}), 0.02); }

}  // namespace

TEST(Fields, TangentIsTheDerivativeOfTheResidual) {
  checkTangent(heatedModel<1>(body()));
  checkTangent(heatedModel<3>(body()));
}

TEST(Fields, OrdersAreThoseOfTheResidual) {
  checkOrders(heatedModel<1>(body()));
  checkOrders(heatedModel<3>(body()));
}

TEST(Fields, APotentialHasASymmetricTangent) {
  const FeModel shape = heatedModel<1>(body());
  const Numbers u = randomNumbers(shape.dofs.numDofs(), 0.05, 5), x = randomNumbers(u.size(), 1, 6),
                y = randomNumbers(u.size(), 1, 7);
  const auto asymmetry = [&](FeModel model) {
    FeProblem problem(std::move(model));
    const Tangent K = tangent(problem, u, 0.3);
    return std::abs(dot(K.times(x), y) - dot(K.times(y), x)) / (norm(K.times(x)) * norm(y));
  };
  EXPECT_LT(asymmetry(heatedModel<1>(body())), 1e-14);
  EXPECT_GT(asymmetry(heatedModel<3>(body())), 1e-4);
}

// Newtons and watts do not add: heat that is out of balance counts as such beside forces of any size.
TEST(Fields, EveryBalanceHasItsOwnScale) {
  FeModel model = heatedModel<1>(body());
  EXPECT_EQ(model.dofs.balances(), (std::vector<std::string>{"forces", "temperature"}));
  std::fill(model.constantLoad.begin(), model.constantLoad.end(), 0.0);
  for (int d = 0; d < model.dofs.numDofs(); ++d) {
    const bool heat = model.dofs.addressOf(d).field == 1;
    // The supports bear the forces.
    model.load[d] = heat ? 1.0 : model.supports.fixed(d) ? 1e6 : 0.0;
  }
  FeProblem problem(std::move(model));
  const Numbers u = FeProblem::values(*problem.initialState(1));
  EXPECT_GT(residual(problem, u, 1).norm.relative(), 0.1);  // of the forces it would be 1e-6
}

// Fields that a model does not have cost nothing: as many unknowns as nodes have components.
TEST(Fields, UnknownsExistOnlyWhereAFieldIs) {
  const Mesh mesh = body();
  const FeModel heated = heatedModel<1>(mesh);
  int corners = 0;
  for (int n = 0; n < mesh.numNodes(); ++n) corners += heated.dofs.numDofs(n) == 4;
  EXPECT_EQ(heated.dofs.numDofs(), 3 * mesh.numNodes() + corners);
  EXPECT_EQ(corners, 4 * 3 * 3);
  EXPECT_EQ(busyModel(mesh).dofs.numDofs(), 3 * mesh.numNodes());
}

TEST(Fields, ATermWithoutItsFieldIsRefused) {
  FeModel model = heatedModel<1>(body());
  model.dofs = DofMap::displacements(model.dofs.numNodes());
  model.supports = {};
  model.load.clear();
  model.constantLoad.clear();
  EXPECT_THROW(FeProblem{std::move(model)}, std::logic_error);
  FeModel other = heatedModel<1>(body());
  EXPECT_THROW(other.prescribe(0, 1, 0, 0, "temperature"), std::invalid_argument);
  EXPECT_THROW(other.prescribe(0, 0, 0, 0, "voltage"), std::invalid_argument);
}
