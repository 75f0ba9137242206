// Pressures that follow the faces of solids.
#include <gtest/gtest.h>

#include <cmath>

#include "ShellChecks.hpp"
#include "SolidModel.hpp"
#include "atrapos/fem/StructuredShell.hpp"
#include "atrapos/solid/FacePressure.hpp"

using namespace atrapos;
using namespace atrapos::solid;
using namespace atrapos::solid::test;
using namespace atrapos::fem::test;

namespace {

fem::SideSet allFaces(const fem::Mesh& mesh) {
  fem::SideSet all;
  for (const fem::SideSet& set : mesh.sideSets)
    all.sides.insert(all.sides.end(), set.sides.begin(), set.sides.end());
  return all;
}

/// -1 times the forces of the terms after the first: the pressure's.
Numbers loadOf(const fem::FeProblem& problem, const Numbers& u, double lambda) {
  Numbers sum(u.size(), 0.0);
  for (int t = 1; t < problem.numTerms(); ++t) {
    const Numbers f = problem.forces(problem.term(t), {vectorOf(problem, u), lambda});
    for (std::size_t d = 0; d < sum.size(); ++d) sum[d] -= f[d];
  }
  return sum;
}

fem::FeModel pressed(const fem::Mesh& mesh, const fem::SideSet& set, LoadAmount pressure) {
  fem::FeModel model = solidModel(mesh, SaintVenantKirchhoff::fromYoung(10, 0.3));
  for (auto& term : followerPressure(mesh, set, pressure)) model.terms.push_back(std::move(term));
  return model;
}

}  // namespace

// On a closed surface neither force nor moment, whatever its shape: the cubature is exact.
TEST(FacePressure, ClosedSurfaceIsInBalanceInEveryState) {
  for (fem::Topology cell : allCells()) {
    if (fem::isShell(cell)) continue;
    SCOPED_TRACE(fem::topologyName(cell));
    const fem::Mesh mesh = distorted(box(cell, {2, 2, 2}), 0.03);
    const fem::FeProblem problem(pressed(mesh, allFaces(mesh), {0.5, 2}));
    const Numbers u = randomNumbers(3 * mesh.numNodes(), 0.1, 3);
    const Numbers f = loadOf(problem, u, 0.75);
    double force[3] = {}, moment[3] = {}, size = 0;
    for (int n = 0; n < mesh.numNodes(); ++n)
      for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        force[i] += f[3 * n + i];
        moment[i] += (mesh.coordinates[3 * n + j] + u[3 * n + j]) * f[3 * n + k] -
                     (mesh.coordinates[3 * n + k] + u[3 * n + k]) * f[3 * n + j];
        size += std::abs(f[3 * n + i]);
      }
    EXPECT_GT(size, 5);  // a pressure of 2 on six faces of area 1
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(force[i], 0, 1e-13 * size);  // rounding
      // N_a N_b x_xi x x_eta is two degrees higher: exact on straight faces only.
      if (!isQuadratic(cell)) {
        EXPECT_NEAR(moment[i], 0, 1e-13 * size);
      }
    }
  }
}

// One face of area 1 at rest: the pressure's size and side.
TEST(FacePressure, PushesOnTheBody) {
  const fem::Mesh mesh = box(fem::Topology::Hex20, {2, 2, 2});
  const fem::FeProblem problem(pressed(mesh, sideSet(mesh, "z_max"), {0.5, 2}));
  const Numbers f = loadOf(problem, Numbers(3 * mesh.numNodes(), 0.0), 0.75);
  double z = 0;
  for (int n = 0; n < mesh.numNodes(); ++n) z += f[3 * n + 2];
  EXPECT_NEAR(z, -2, 1e-13);  // rounding
}

TEST(FacePressure, TangentAndOrders) {
  const fem::Mesh mesh = distorted(box(fem::Topology::Hex8, {2, 2, 2}), 0.03);
  fem::FeModel model = pressed(mesh, sideSet(mesh, "z_max"), {0.1, 0.3});
  for (int n : nodesOfSet(mesh, "z_min"))
    for (int i = 0; i < 3; ++i) model.prescribe(n, i, 0, 0);
  const Numbers u = randomState(model, 0.05, 5), direction = randomState(model, 1, 6);
  fem::FeProblem problem(std::move(model));
  EXPECT_FALSE(problem.symmetric());
  expectTangent(problem, u, direction, 0.4);
  expectOrders(problem, u, 0.4);
}

TEST(FacePressure, RefusesShells) {
  const fem::Mesh mesh = fem::shellPlateMesh({});
  EXPECT_THROW(followerPressure(mesh, sideSet(mesh, "top"), {}), std::invalid_argument);
}
