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

namespace {

Numbers oneEach(const DofMap& dofs, double displacement, double temperature) {
  Numbers v(dofs.numDofs());
  for (int d = 0; d < dofs.numDofs(); ++d) v[d] = dofs.addressOf(d).field == 0 ? displacement : temperature;
  return v;
}

}  // namespace

// <x, y> = sum over the balances of factor times product, and Euclid's where there are no factors.
TEST(Fields, FactorsMultiplyTheirProducts) {
  FeProblem problem(heatedModel<3>(body()));
  const DofMap& dofs = problem.model().dofs;
  const auto x = vectorOf(problem, oneEach(dofs, 2, 0)), y = vectorOf(problem, oneEach(dofs, 0, 3)),
             both = vectorOf(problem, oneEach(dofs, 2, 3));
  const Numbers rest(dofs.numDofs(), 0.0);
  tangent(problem, rest, 0.3);
  const atrapos::path::State from{vectorOf(problem, rest), 0.3};
  const auto norms = problem.fieldChanges(from, {both, 0.3});
  ASSERT_EQ(norms.size(), 2u);
  // Next to nothing of the forces there: that field has not moved.
  const auto still = problem.fieldChanges(from, {vectorOf(problem, oneEach(dofs, 2, 1e-12)), 0.3});
  EXPECT_EQ(still[0], norms[0]);
  EXPECT_EQ(still[1], 0);
  const auto inner = [&](const auto& a, const auto& b) { return problem.inner({a, {}}, {b, {}}); };
  EXPECT_NEAR(inner(x, x), norms[0] * norms[0], 1e-12 * norms[0] * norms[0]);
  EXPECT_NEAR(inner(y, y), norms[1] * norms[1], 1e-12 * norms[1] * norms[1]);
  problem.weighFields({0.25, 16});
  EXPECT_NEAR(inner(x, x), 0.25 * norms[0] * norms[0], 1e-12 * norms[0] * norms[0]);
  EXPECT_NEAR(inner(both, both), 0.25 * norms[0] * norms[0] + 16 * norms[1] * norms[1],
              1e-12 * norms[1] * norms[1]);
  EXPECT_EQ(inner(x, y), 0);
  problem.weighFields({});
  EXPECT_NEAR(inner(both, both), norms[0] * norms[0] + norms[1] * norms[1], 1e-12 * norms[1] * norms[1]);
  EXPECT_THROW(problem.weighFields({1, 2, 3}), std::invalid_argument);
}

namespace {

/// Largest and mean entry on the diagonal of the tangent, [field], in free rows and in prescribed ones.
struct Diagonals {
  double largest[2] = {0, 0}, mean[2] = {0, 0}, prescribed[2] = {0, 0};
};
Diagonals diagonalsOf(FeProblem& problem, const Numbers& u) {
  const FeModel& model = problem.model();
  const Tangent K = tangent(problem, u, 0);
  Diagonals of;
  int rows[2] = {0, 0};
  for (int d = 0; d < model.dofs.numDofs(); ++d) {
    const int field = model.dofs.addressOf(d).field;
    const double size = std::abs(K.at(d, d));
    if (model.supports.fixed(d)) {
      of.prescribed[field] = size;
      continue;
    }
    of.largest[field] = std::max(of.largest[field], size);
    of.mean[field] += size;
    ++rows[field];
  }
  for (int f = 0; f < 2; ++f) of.mean[f] /= rows[f];
  return of;
}

}  // namespace

// In rows of their own size supports leave nothing of the rounding of a stiffness in the balance of heat.
TEST(Fields, PrescribedRowsHaveTheSizeOfTheirBalance) {
  FeProblem problem(heatedModel<3>(body(), 1e-6));
  const Diagonals of = diagonalsOf(problem, FeProblem::values(*problem.initialState(0)));
  EXPECT_LT(of.largest[1], 1e-3 * of.largest[0]);
  for (int f = 0; f < 2; ++f) EXPECT_DOUBLE_EQ(of.prescribed[f], of.largest[f]);
}

// Eigenvalues of a tangent that is not symmetric are measured by the mean of each field's own diagonal.
TEST(Fields, EigenvaluesAreMeasuredByTheirBalance) {
  FeProblem problem(heatedModel<3>(body(), 1e-6));
  const Numbers u = FeProblem::values(*problem.initialState(0));
  const Diagonals of = diagonalsOf(problem, u);
  const auto weights = problem.eigenvalueWeights({vectorOf(problem, u), 0});
  ASSERT_FALSE(weights.is_null());
  const Numbers m = FeProblem::values(*weights);
  const FeModel& model = problem.model();
  for (int d = 0; d < model.dofs.numDofs(); ++d) {
    const int field = model.dofs.addressOf(d).field;
    EXPECT_NEAR(m[d] / (model.supports.fixed(d) ? of.prescribed : of.mean)[field], 1, 1e-12);
  }
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
