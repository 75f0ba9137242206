// Linear couplings: what they resolve to, and that the eliminated problem is the one of a mesh without them.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "atrapos/fem/Coupling.hpp"
#include "support/Model.hpp"
#include "support/Vectors.hpp"

using namespace atrapos::fem;
using namespace atrapos::fem::test;

namespace {

std::string messageOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "nothing thrown";
}

/// Every node of `mesh` in the plane x = 1 and the node of `other` at the same place, `offset` added.
std::vector<std::pair<int, int>> interface(const Mesh& mesh, const Mesh& other, int offset) {
  std::vector<std::pair<int, int>> pairs;
  for (int n = 0; n < mesh.numNodes(); ++n)
    for (int m = 0; m < other.numNodes(); ++m) {
      double distance = 0;
      for (int i = 0; i < 3; ++i)
        distance += std::abs(mesh.coordinates[3 * n + i] - other.coordinates[3 * m + i]);
      if (distance < 1e-9) pairs.push_back({n, m + offset});
    }
  return pairs;
}

}  // namespace

TEST(Couplings, ChainsAreResolved) {
  // u1 = 2 u0 + 1 + 3 lambda, u2 = u1 - u0: u2 = u0 + 1 + 3 lambda.
  Couplings couplings;
  couplings.add({3, {{0, 2.0}}, 1.0, 3.0});
  couplings.add({6, {{3, 1.0}, {0, -1.0}}, 0.0, 0.0});
  EXPECT_TRUE(couplings.driven());
  const auto rows = couplings.resolved(DofMap::displacements(3), {});
  ASSERT_EQ(rows.size(), 2u);
  ASSERT_EQ(rows[1].masters.size(), 1u);
  EXPECT_EQ(rows[1].masters[0].dof, 0);
  EXPECT_EQ(rows[1].masters[0].factor, 1.0);
  EXPECT_EQ(rows[1].value, 1.0);
  EXPECT_EQ(rows[1].perLoadFactor, 3.0);
}

TEST(Couplings, WhatCannotBeIsNamed) {
  const DofMap dofs = DofMap::displacements(3);
  const auto refusal = [&](const std::vector<Coupling>& list, const Supports& supports = {}) {
    Couplings couplings;
    for (const Coupling& c : list) couplings.add(c);
    return messageOf([&] { couplings.resolved(dofs, supports); });
  };
  const Coupling first{3, {{0, 1.0}}, 0.0, 0.0};
  EXPECT_EQ(refusal({first, {3, {{6, 1.0}}, 0.0, 0.0}}), "displacement x of node 2 is coupled twice");
  EXPECT_EQ(refusal({first, {4, {{4, 1.0}}, 0.0, 0.0}}), "displacement y of node 2 is coupled to itself");
  Supports supports;
  supports.prescribe(3, 0.0, 0.0);
  EXPECT_EQ(refusal({first}, supports),
            "displacement x of node 2 is both supported and coupled: support its masters");
  EXPECT_EQ(refusal({{3, {{9, 1.0}}, 0.0, 0.0}}),
            "a coupling of displacement x of node 2 names an unknown that the model does not have");
  EXPECT_EQ(refusal({{9, {{3, 1.0}}, 0.0, 0.0}}),
            "a coupling is of unknown 9, which the model does not have");
  EXPECT_EQ(refusal({first, {0, {{3, 0.5}}, 0.0, 0.0}}),
            "displacement x of node 2 depends on itself by its couplings");
  EXPECT_EQ(messageOf([&] {
              Couplings plane;
              couplePlane(plane, dofs, {0, 1}, {0, 0, 0});
            }),
            "a coupled plane needs a normal of finite length");
}

// Two boxes whose nodes at the common face are coupled are the box in one piece.
TEST(Couplings, EqualNodesAreOneNode) {
  const Mesh left = box(Topology::Hex20, {2, 2, 1}),
             right = box(Topology::Hex20, {2, 2, 1}, {1, 1, 1}, {1, 0, 0}), whole = glued({left, right});
  const auto material = [](const Mesh& mesh, int offset, FeModel& model) {
    for (const Block& block : mesh.blocks) {
      PointSet p = volumePoints(mesh, block, tabulate(block.topology));
      for (int& n : p.nodes) n += offset;
      model.terms.push_back(
          lawTerm(pointLaw(ExponentialSolid{}), p, std::vector<double>(p.numPoints(), 1.0)));
    }
  };
  const auto conditions = [](const Mesh& mesh, int offset, FeModel& model) {
    for (int n = 0; n < mesh.numNodes(); ++n) {
      const double x = mesh.coordinates[3 * n];
      for (int i = 0; i < 3 && x < 1e-9; ++i) model.prescribe(n + offset, i, 0, i == 1 ? 0.1 : 0);
      if (x > 2 - 1e-9) model.load[3 * (n + offset) + 2] = 0.002;
    }
  };
  FeModel one, two;
  one.dofs = DofMap::displacements(whole.numNodes());
  two.dofs = DofMap::displacements(left.numNodes() + right.numNodes());
  for (FeModel* m : {&one, &two}) m->load.assign(m->dofs.numDofs(), 0.0);
  material(whole, 0, one);
  conditions(whole, 0, one);
  material(left, 0, two);
  material(right, left.numNodes(), two);
  conditions(left, 0, two);
  conditions(right, left.numNodes(), two);
  const auto pairs = interface(left, right, left.numNodes());
  ASSERT_EQ(pairs.size(), 13u);
  for (const auto& [a, b] : pairs) coupleEqual(two.couplings, two.dofs, {a, b});
  FeProblem first(std::move(one)), second(std::move(two));
  EXPECT_EQ(first.numFreeDofs(), second.numFreeDofs());
  const auto expected = equilibrium(first, 1.0, FeProblem::values(*first.initialState(1.0)));
  const auto seen = equilibrium(second, 1.0, FeProblem::values(*second.initialState(1.0)));
  double worst = 0;
  for (const auto& [n, m] : interface(whole, right, left.numNodes()))
    for (int i = 0; i < 3; ++i) worst = std::max(worst, std::abs(expected.u[3 * n + i] - seen.u[3 * m + i]));
  EXPECT_GT(largest(expected.u), 0.05);
  EXPECT_LT(worst, 1e-12);  // rounding of displacements of 0.1 times the condition of a small mesh
  ASSERT_TRUE(seen.inertia);
  EXPECT_EQ(seen.inertia->negative, 0);
  // Reactions balance the load.
  const auto reactions = second.reactions({vectorOf(second, seen.u), 1.0});
  double total = 0;
  for (std::size_t n = 0; n < reactions.size() / 3; ++n) total += reactions[3 * n + 2];
  double load = 0;
  for (int n = 0; n < right.numNodes(); ++n) load += right.coordinates[3 * n] > 2 - 1e-9 ? 0.002 : 0.0;
  EXPECT_NEAR(total, -load, 1e-12);
}

// The end of a bar under one nodal force stays plane: a homogeneous state, as if the force were spread.
TEST(Couplings, PlaneEnd) {
  const Mesh mesh = box(Topology::Hex8, {3, 2, 2});
  FeModel model;
  model.dofs = DofMap::displacements(mesh.numNodes());
  for (const Block& block : mesh.blocks) {
    const PointSet p = volumePoints(mesh, block, tabulate(block.topology));
    model.terms.push_back(lawTerm(pointLaw(ExponentialSolid{}), p, std::vector<double>(p.numPoints(), 1.0)));
  }
  model.load.assign(model.dofs.numDofs(), 0.0);
  std::vector<int> end;
  for (int n = 0; n < mesh.numNodes(); ++n) {
    const double* X = &mesh.coordinates[3 * n];
    for (int i = 0; i < 3; ++i)
      if (X[i] < 1e-9) model.prescribe(n, i, 0, 0);
    if (X[0] > 1 - 1e-9) end.push_back(n);
  }
  ASSERT_EQ(end.size(), 9u);
  couplePlane(model.couplings, model.dofs, end, {-2, 0, 0});
  model.load[3 * end.back()] = 0.3;
  FeProblem problem(std::move(model));
  const auto seen = equilibrium(problem, 1.0, FeProblem::values(*problem.initialState(1.0)));
  const double stretch = seen.u[3 * end[0]], lateral = seen.u[3 * end.back() + 1];
  EXPECT_GT(stretch, 0.05);
  EXPECT_LT(lateral, -0.01);
  double worst = 0;
  for (int n = 0; n < mesh.numNodes(); ++n) {
    const double* X = &mesh.coordinates[3 * n];
    worst = std::max({worst, std::abs(seen.u[3 * n] - stretch * X[0]),
                      std::abs(seen.u[3 * n + 1] - lateral * X[1]),
                      std::abs(seen.u[3 * n + 2] - lateral * X[2])});
  }
  EXPECT_LT(worst, 1e-12);  // rounding
  double stress[9];
  const double H[9] = {stretch, 0, 0, 0, lateral, 0, 0, 0, lateral}, one = 1;
  ExponentialSolid{}(H, &one, stress);
  EXPECT_NEAR(stress[0], 0.3, 1e-12);  // the force over the area
  EXPECT_NEAR(stress[4], 0, 1e-12);
}

// Two boxes apart, one of them clamped: the other is free, unless a coupling joins them.
TEST(Couplings, JoinedBodiesAreOne) {
  const Mesh near = box(Topology::Hex8), far = box(Topology::Hex8, {1, 1, 1}, {1, 1, 1}, {5, 0, 0}),
             both = glued({near, far});
  ASSERT_EQ(both.numNodes(), near.numNodes() + far.numNodes());
  const DofMap dofs = DofMap::displacements(both.numNodes());
  Supports supports;
  for (int d = 0; d < 3 * near.numNodes(); ++d) supports.prescribe(d, 0, 0);
  const auto free = freeBodies(both, dofs, supports, {});
  ASSERT_EQ(free.size(), 1u);
  EXPECT_EQ(free[0].motions, 6);
  EXPECT_TRUE(freeBodies(both, dofs, supports, {}, nullptr, {{0, near.numNodes()}}).empty());
}
