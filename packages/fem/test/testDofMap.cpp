#include <gtest/gtest.h>

#include <stdexcept>

#include "atrapos/fem/DofMap.hpp"

using namespace atrapos::fem;

namespace {

const Field temperature{"temperature", {""}, Role::primal};
const Field force{"contact force", {""}, Role::oneSided};

/// Four nodes in a plane with a displacement, two of them with a temperature; then two multipliers.
DofMap example() {
  DofMap dofs(4, {{displacementField(2), {}}, {temperature, {1, 3}}});
  EXPECT_EQ(dofs.addNodes(2, force), 4);
  return dofs;
}

}  // namespace

TEST(DofMap, UnknownsOfANodeAreContiguousFieldAfterField) {
  const DofMap dofs = example();
  EXPECT_EQ(dofs.numNodes(), 6);
  EXPECT_EQ(dofs.numDofs(), 4 * 2 + 2 + 2);
  const int u = dofs.find("displacement"), theta = dofs.find("temperature"), r = dofs.find("contact force");
  EXPECT_EQ(dofs.find("voltage"), -1);
  EXPECT_EQ(dofs.dof(u, 0, 1), 1);
  EXPECT_EQ(dofs.dof(theta, 0, 0), -1);
  EXPECT_EQ(dofs.dof(u, 1, 0), 2);
  EXPECT_EQ(dofs.dof(theta, 1, 0), 4);
  EXPECT_EQ(dofs.dof(u, 2, 0), 5);
  EXPECT_EQ(dofs.dof(theta, 3, 0), 9);
  EXPECT_EQ(dofs.dof(r, 5, 0), 11);
  EXPECT_EQ(dofs.firstFieldSize(3), 2);
  EXPECT_EQ(dofs.firstFieldSize(4), 1);
  for (int d = 0; d < dofs.numDofs(); ++d) {
    const auto at = dofs.addressOf(d);
    EXPECT_EQ(dofs.dof(at.field, at.node, at.component), d);
  }
  EXPECT_THROW(dofs.addressOf(dofs.numDofs()), std::out_of_range);
}

TEST(DofMap, NamesAndRoles) {
  const DofMap dofs = example();
  EXPECT_EQ(dofs.nameOf(3), "displacement y of node 2");
  EXPECT_EQ(dofs.nameOf(4), "temperature of node 2");
  EXPECT_EQ(dofs.nameOf(11), "contact force of node 6");
  EXPECT_EQ(dofs.dofsWith(Role::oneSided), (std::vector<int>{10, 11}));
  EXPECT_TRUE(dofs.dofsWith(Role::parameter).empty());
  DofMap other = dofs;
  EXPECT_THROW(other.addNodes(1, {"temperature", {"a", "b"}, Role::primal}), std::logic_error);
}

TEST(DofMap, VectorsInSpaceOfFirstFields) {
  const DofMap dofs = example();
  std::vector<double> u(dofs.numDofs());
  for (int d = 0; d < dofs.numDofs(); ++d) u[d] = d + 1;
  const auto xyz = dofs.vectors(u);
  EXPECT_EQ(xyz, (std::vector<double>{1, 2, 0, 3, 4, 0, 6, 7, 0, 8, 9, 0, 0, 0, 0, 0, 0, 0}));
  auto back = dofs.fromVectors(xyz);
  for (const int d : {4, 9, 10, 11}) u[d] = 0;  // what is no vector
  EXPECT_EQ(back, u);
}

TEST(DofMap, PartsKeepTheOrderOfTheirNodes) {
  const DofMap part = example().part({3, 4, 0});
  EXPECT_EQ(part.numDofs(), 3 + 1 + 2);
  EXPECT_EQ(part.dof(part.find("temperature"), 0, 0), 2);
  EXPECT_EQ(part.firstDof(2), 4);
}
