// Plane strain, plane stress and axisymmetry: closed forms, derivatives, orders of convergence.
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>

#include "atrapos/fem/LawTerm.hpp"
#include "atrapos/fem/Loads.hpp"
#include "atrapos/fem/ReferenceCell.hpp"
#include "atrapos/fem/StructuredPlane.hpp"
#include "atrapos/solid/PlaneBody.hpp"
#include "atrapos/solid/SaintVenantKirchhoff.hpp"
#include "support/Checks.hpp"
#include "support/Meshes.hpp"
#include "support/Vectors.hpp"

using namespace atrapos;
using namespace atrapos::solid;
using namespace atrapos::fem::test;
using Kind = PlaneSection::Kind;

namespace {

const std::vector<fem::Topology> cells{fem::Topology::Quad4, fem::Topology::Quad8, fem::Topology::Quad9,
                                       fem::Topology::Tri3, fem::Topology::Tri6};

fem::Mesh rectangle(fem::Topology cell, std::array<int, 2> divisions, double x0 = 0, double size = 1) {
  fem::RectangleOptions options;
  options.topology = cell;
  options.divisions = divisions;
  options.lengths = {size, size / 2};
  options.origin = {x0, 0};
  return fem::rectangleMesh(options);
}

/// Nodes inside moved in the plane, the same at every run.
fem::Mesh distortedInside(fem::Mesh mesh, double amount) {
  const auto moves = randomNumbers(mesh.coordinates.size(), amount, 3);
  std::vector<char> outside(mesh.numNodes(), 0);
  for (const fem::SideSet& set : mesh.sideSets)
    for (const int n : fem::nodesOf(mesh, set)) outside[n] = 1;
  for (int n = 0; n < mesh.numNodes(); ++n)
    for (int i = 0; i < 2 && !outside[n]; ++i) mesh.coordinates[3 * n + i] += moves[3 * n + i];
  return mesh;
}

fem::FeModel body(const fem::Mesh& mesh, const PlaneSection& section, double E, double nu) {
  fem::FeModel model;
  model.dofs = fem::DofMap::displacements(mesh.numNodes(), 2);
  const fem::Block& block = mesh.blocks[0];
  model.terms.push_back(
      fem::lawTerm(planeLaw(fem::pointLaw(SaintVenantKirchhoff::fromYoung(E, nu)), section.kind),
                   planePoints(mesh, block, fem::tabulate(block.topology), section)));
  return model;
}

double pi() { return std::acos(-1.0); }

class PlaneCells : public testing::TestWithParam<fem::Topology> {};

}  // namespace

// A homogeneous deformation is in equilibrium inside whatever the mesh, and the strain energy's derivative is
// the force that closed forms give.
TEST_P(PlaneCells, PatchTest) {
  const fem::Mesh mesh = distortedInside(rectangle(GetParam(), {3, 2}), 0.03);
  for (const Kind kind : {Kind::strain, Kind::stress}) {
    fem::FeProblem problem(body(mesh, {kind, 0.2}, 10, 0.3));
    Numbers u(problem.model().dofs.numDofs());
    for (int n = 0; n < mesh.numNodes(); ++n) {
      const double x = mesh.coordinates[3 * n], y = mesh.coordinates[3 * n + 1];
      u[2 * n] = 0.1 * x + 0.05 * y;
      u[2 * n + 1] = -0.02 * x + 0.07 * y;
    }
    const Numbers r = residual(problem, u, 0).r;
    std::vector<char> outside(mesh.numNodes(), 0);
    for (const fem::SideSet& set : mesh.sideSets)
      for (const int n : fem::nodesOf(mesh, set)) outside[n] = 1;
    for (int n = 0; n < mesh.numNodes(); ++n)
      for (int i = 0; i < 2 && !outside[n]; ++i) EXPECT_NEAR(r[2 * n + i], 0, 1e-15) << n;
    // The force on x_max: P_xx and P_yx times the area 0.5 x 0.2.
    const double lambda = 10 * 0.3 / (1.3 * 0.4), mu = 10 / 2.6;
    const double F[2][2] = {{1.1, 0.05}, {-0.02, 1.07}};
    double E[2][2], S[2][2];
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j) E[i][j] = 0.5 * (F[0][i] * F[0][j] + F[1][i] * F[1][j] - (i == j ? 1 : 0));
    // Plane stress: S_zz = 0 gives E_zz.
    const double Ezz = kind == Kind::stress ? -lambda / (lambda + 2 * mu) * (E[0][0] + E[1][1]) : 0;
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j)
        S[i][j] = 2 * mu * E[i][j] + (i == j ? lambda * (E[0][0] + E[1][1] + Ezz) : 0);
    for (int i = 0; i < 2; ++i) {
      double force = 0;
      for (const int n : nodesOfSet(mesh, "x_max")) force += r[2 * n + i];
      // What corners have of y_min and y_max cancels.
      const double P = F[i][0] * S[0][0] + F[i][1] * S[1][0];
      EXPECT_NEAR(force, P * 0.5 * 0.2, 1e-14);
    }
  }
}

TEST_P(PlaneCells, TangentAndOrders) {
  const fem::Mesh mesh = distortedInside(rectangle(GetParam(), {3, 2}, 1, 2), 0.04);
  for (const Kind kind : {Kind::strain, Kind::stress, Kind::axisymmetric}) {
    SCOPED_TRACE(static_cast<int>(kind));
    const auto model = [&] {
      fem::FeModel m = body(mesh, {kind, 0.2}, 1, 0.3);
      for (const int n : nodesOfSet(mesh, "y_min")) m.prescribe(n, 1, 0, 0.3);
      for (const int n : nodesOfSet(mesh, "x_min")) m.prescribe(n, 0, 0.02, 0);
      m.load = randomNumbers(m.dofs.numDofs(), 0.01, 5);
      return m;
    };
    checkTangent(model());
    checkOrders(model());
  }
}

INSTANTIATE_TEST_SUITE_P(All, PlaneCells, testing::ValuesIn(cells),
                         [](const auto& info) { return std::string(fem::topologyName(info.param)); });

namespace {

/// Largest error of the displacement u(x) of a ring 1 < r < 2 of unit height between frictionless plates,
/// under a small inner pressure, against Lame's, as a part of it. Axisymmetric, n cells through the wall.
double lameError(fem::Topology cell, int n) {
  const double E = 1, nu = 0.3, p = 1e-9, a = 1, b = 2;
  fem::RectangleOptions options;
  options.topology = cell;
  options.divisions = {n, n / 2};
  options.origin = {a, 0};
  const fem::Mesh mesh = fem::rectangleMesh(options);
  const PlaneSection section{Kind::axisymmetric, 1};
  fem::FeModel model = body(mesh, section, E, nu);
  for (const char* set : {"y_min", "y_max"})
    for (const int node : nodesOfSet(mesh, set)) model.prescribe(node, 1, 0, 0);
  std::vector<double> force(mesh.coordinates.size(), 0.0);
  fem::addPressure(planeEdgePoints(mesh, sideSet(mesh, "x_min"), section, 4), p, force);
  model.load = model.dofs.fromVectors(force);
  fem::FeProblem problem(std::move(model));
  const auto state = equilibrium(problem, 1.0, Numbers(problem.model().dofs.numDofs(), 0.0));
  double worst = 0;
  for (int m = 0; m < mesh.numNodes(); ++m) {
    const double r = mesh.coordinates[3 * m];
    const double exact = (1 + nu) / E * p * a * a / (b * b - a * a) * ((1 - 2 * nu) * r + b * b / r);
    worst = std::max(worst, std::abs(state.u[2 * m] / exact - 1));
  }
  return worst;
}

}  // namespace

// Lame's thick cylinder. Displacements of QUAD4 are good to h^2, those of QUAD9 at nodes to h^4, and QUAD8
// with its 2 x 2 points is exact there: what is left of it is the pressure that is not infinitely small.
// Errors of triangles come to their orders 2 and 3 slowly, from below (1.4 and 2.8 here).
TEST(PlaneBody, ThickCylinderIsLames) {
  struct Expected {
    fem::Topology cell;
    double error, rate;
  };
  for (const Expected& e : {Expected{fem::Topology::Quad4, 1e-3, 1.95},
                            {fem::Topology::Quad8, 1e-8, -1},
                            {fem::Topology::Quad9, 1e-6, 3.8},
                            {fem::Topology::Tri3, 5e-3, 1.3},
                            {fem::Topology::Tri6, 5e-5, 2.7}}) {
    const double coarse = lameError(e.cell, 8), fine = lameError(e.cell, 16);
    EXPECT_LT(fine, e.error) << fem::topologyName(e.cell);
    EXPECT_GT(std::log2(coarse / fine), e.rate) << fem::topologyName(e.cell);
  }
}

TEST(PlaneBody, AreasVolumesAndNormals) {
  const fem::Mesh mesh = rectangle(fem::Topology::Tri6, {3, 2}, 2);
  const auto sum = [](const Numbers& x) {
    double s = 0;
    for (const double y : x) s += y;
    return s;
  };
  const fem::Tabulation cell = fem::tabulate(fem::Topology::Tri6);
  EXPECT_NEAR(sum(planePoints(mesh, mesh.blocks[0], cell, {Kind::stress, 0.2}).weights), 0.1, 1e-15);
  // Pappus: the area times the way of its centre.
  const PlaneSection ring{Kind::axisymmetric, 1};
  EXPECT_NEAR(sum(planeValuePoints(mesh, mesh.blocks[0], cell, ring).weights), 0.5 * 2 * pi() * 2.5, 1e-13);
  EXPECT_NEAR(fem::areaOf(planeEdgePoints(mesh, sideSet(mesh, "x_max"), ring, 3)), 2 * pi() * 3 * 0.5, 1e-13);
  const std::pair<const char*, std::array<double, 2>> outward[] = {
      {"x_min", {-1, 0}}, {"x_max", {1, 0}}, {"y_min", {0, -1}}, {"y_max", {0, 1}}};
  for (const auto& [set, n] : outward)
    for (const auto& p : planeEdgePoints(mesh, sideSet(mesh, set), {}, 3))
      for (int q = 0; q < p.numPoints(); ++q)
        for (int i = 0; i < 2; ++i) EXPECT_NEAR(p.normals[3 * q + i], n[i], 1e-14) << set;
}

TEST(PlaneBody, WhatCannotBeIsNamed) {
  const auto messageOf = [](const auto& f) -> std::string {
    try {
      f();
    } catch (const std::exception& e) {
      return e.what();
    }
    return "";
  };
  fem::Mesh mesh = rectangle(fem::Topology::Quad4, {1, 1}, -2);
  const fem::Tabulation cell = fem::tabulate(fem::Topology::Quad4);
  EXPECT_EQ(messageOf([&] {
              planePoints(mesh, mesh.blocks[0], cell, {Kind::axisymmetric, 1});
            }),
            "block 'body', element 1 (of the block): the radius x is not positive; the axis is x = 0");
  std::swap(mesh.blocks[0].nodes[1], mesh.blocks[0].nodes[3]);
  EXPECT_EQ(messageOf([&] { planePoints(mesh, mesh.blocks[0], cell, {}); }),
            "block 'body', element 1 (of the block): the Jacobian is not positive at a cubature point; check "
            "node order (counter-clockwise) and shape");
  const fem::Mesh solid = box(fem::Topology::Hex8);
  EXPECT_EQ(messageOf([&] { planeEdgePoints(solid, sideSet(solid, "x_min"), {}, 2); }),
            "side set 'x_min': side 4 of element 1 is no edge of a plane cell");
}
