// Bodies with displacements and pressures: derivatives, inertia, closed forms, locking, Cook's membrane.
#include "atrapos/solid/MixedBody.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "atrapos/fem/LawTerm.hpp"
#include "atrapos/fem/Loads.hpp"
#include "atrapos/fem/StructuredPlane.hpp"
#include "atrapos/solid/EdgePressure.hpp"
#include "atrapos/solid/MixedLaw.hpp"
#include "support/Checks.hpp"
#include "support/Meshes.hpp"
#include "support/Vectors.hpp"

using namespace atrapos;
using namespace atrapos::solid;
using namespace atrapos::fem::test;
using Kind = PlaneSection::Kind;
using fem::Topology;

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

NeoHookean neoHookean(double shear, double lambda) {
  NeoHookean law;
  law.mu = shear;
  law.lambda = lambda;
  return law;
}

template <class Law>
fem::FeModel mixedModel(const fem::Mesh& mesh, const std::optional<PlaneSection>& plane, const Law& law) {
  const fem::Block& block = mesh.blocks[0];
  fem::FeModel model;
  model.dofs = fem::DofMap(mesh.numNodes(), {{fem::displacementField(plane ? 2 : 3), {}},
                                             {pressureField(block), pressureNodes(block)}});
  const auto cell = mixedTabulation(block.topology);
  auto inSpace = fem::pointLaw(MixedLaw<Law>{law, pressureScale(mesh, block, law.shearModulus())});
  model.terms.push_back(fem::lawTerm(
      plane ? planeLaw(std::move(inSpace), plane->kind) : std::move(inSpace),
      withPressures(plane ? planePoints(mesh, block, cell, *plane) : fem::volumePoints(mesh, block, cell),
                    block, cell)));
  return model;
}

fem::Mesh distortedInside(fem::Mesh mesh, double amount, int dimension) {
  const auto moves = randomNumbers(mesh.coordinates.size(), amount, 3);
  std::vector<char> outside(mesh.numNodes(), 0);
  for (const fem::SideSet& set : mesh.sideSets)
    for (const int n : fem::nodesOf(mesh, set)) outside[n] = 1;
  for (int n = 0; n < mesh.numNodes(); ++n)
    for (int i = 0; i < dimension && !outside[n]; ++i) mesh.coordinates[3 * n + i] += moves[3 * n + i];
  return mesh;
}

fem::Mesh rectangle(Topology cell, std::array<int, 2> divisions, double x0 = 0) {
  fem::RectangleOptions options;
  options.topology = cell;
  options.divisions = divisions;
  options.origin = {x0, 0};
  return fem::rectangleMesh(options);
}

fem::Mesh tube(Topology cell, int n) {
  fem::AnnulusOptions options;
  options.topology = cell;
  options.divisions = {n, 2 * n};
  return fem::annulusMesh(options);
}

int numPressures(const fem::FeModel& model) {
  return static_cast<int>(model.dofs.dofsWith(fem::Role::multiplier).size());
}

/// Random forces, none on the rows of pressures.
Numbers loads(const fem::FeModel& model, double size) {
  Numbers load = randomNumbers(model.dofs.numDofs(), size, 5);
  for (const int d : model.dofs.dofsWith(fem::Role::multiplier)) load[d] = 0;
  return load;
}

class MixedPlane : public testing::TestWithParam<Topology> {};
class MixedSolid : public testing::TestWithParam<Topology> {};

std::string nameOf(const testing::TestParamInfo<Topology>& info) { return fem::topologyName(info.param); }

}  // namespace

TEST_P(MixedPlane, TangentAndOrders) {
  const fem::Mesh mesh = distortedInside(rectangle(GetParam(), {3, 2}, 1), 0.03, 2);
  for (const Kind kind : {Kind::strain, Kind::axisymmetric})
    for (const double lambda : {3.0, infinite}) {
      const auto model = [&] {
        fem::FeModel m = mixedModel(mesh, PlaneSection{kind, 0.2}, neoHookean(0.8, lambda));
        for (const int n : nodesOfSet(mesh, "y_min")) m.prescribe(n, 1, 0, 0.3);
        for (const int n : nodesOfSet(mesh, "x_min")) m.prescribe(n, 0, 0.02, 0);
        m.load = loads(m, 0.02);
        return m;
      };
      checkTangent(model());
      checkOrders(model());
    }
}

TEST_P(MixedSolid, TangentAndOrders) {
  const fem::Mesh mesh = distorted(box(GetParam(), {3, 2, 1}), 0.02);
  const auto model = [&] {
    fem::FeModel m = mixedModel(mesh, {}, neoHookean(0.8, 3));
    for (const int n : nodesOfSet(mesh, "z_min"))
      for (int i = 0; i < 3; ++i) m.prescribe(n, i, 0, i == 2 ? 0.3 : 0);
    m.load = loads(m, 0.02);
    return m;
  };
  checkTangent(model());
  checkOrders(model());
}

namespace {

/// Residual of a homogeneous deformation with the pressure that leaves no stress along z (a solid) or y: at
/// nodes inside it vanishes, as do the rows of all pressures.
void patchTest(const fem::Mesh& mesh, const std::optional<PlaneSection>& plane, int dimension) {
  const double mu = 0.8, x = 1.25, y = dimension == 3 ? 0.9 : 1 / x, z = dimension == 3 ? 1 / (x * y) : 1;
  fem::FeModel model = mixedModel(mesh, plane, neoHookean(mu, infinite));
  const double along = dimension == 3 ? z : y, pressure = mu * (1 - along * along);  // mu (l^2 - 1) + p = 0
  const double scale = pressureScale(mesh, mesh.blocks[0], mu);
  Numbers u(model.dofs.numDofs());
  const double stretch[3] = {x, y, z};
  for (int n = 0; n < mesh.numNodes(); ++n) {
    for (int i = 0; i < dimension; ++i)
      u[model.dofs.firstDof(n) + i] = (stretch[i] - 1) * mesh.coordinates[3 * n + i];
    // with some shear of constant volume
    u[model.dofs.firstDof(n)] += 0.2 * mesh.coordinates[3 * n + 1] * y;
  }
  for (const int d : model.dofs.dofsWith(fem::Role::multiplier)) u[d] = pressure / scale;
  std::vector<char> outside(mesh.numNodes(), 0);
  for (const fem::SideSet& set : mesh.sideSets)
    for (const int n : fem::nodesOf(mesh, set)) outside[n] = 1;
  const fem::DofMap dofs = model.dofs;
  fem::FeProblem problem(std::move(model));
  const Numbers r = residual(problem, u, 0).r;
  double largestOutside = 0;
  for (int n = 0; n < mesh.numNodes(); ++n)
    for (int d = dofs.firstDof(n); d < dofs.firstDof(n + 1); ++d) {
      const bool displacement = d - dofs.firstDof(n) < dimension;
      if (outside[n] && displacement)
        largestOutside = std::max(largestOutside, std::abs(r[d]));
      else
        EXPECT_NEAR(r[d], 0, 2e-15) << dofs.nameOf(d);
    }
  EXPECT_GT(largestOutside, 1e-2);
}

}  // namespace

TEST_P(MixedPlane, PatchTest) {
  patchTest(distortedInside(rectangle(GetParam(), {3, 2}), GetParam() == Topology::Tri6 ? 0 : 0.03, 2),
            PlaneSection{Kind::strain, 0.2}, 2);
}

TEST_P(MixedSolid, PatchTest) { patchTest(box(GetParam(), {2, 2, 2}), {}, 3); }

INSTANTIATE_TEST_SUITE_P(Cells, MixedPlane, testing::Values(Topology::Quad8, Topology::Quad9, Topology::Tri6),
                         nameOf);
INSTANTIATE_TEST_SUITE_P(Cells, MixedSolid,
                         testing::Values(Topology::Hex20, Topology::Hex27, Topology::Tet10,
                                         Topology::Wedge15),
                         nameOf);

namespace {

struct TubeErrors {
  double displacement = 0, pressure = 0;
  int negative = 0, owed = 0;
};

/// A thick tube 1 < R < 2 of incompressible neo-Hookean rubber in plane strain under an inner pressure:
/// r^2 = R^2 + A, and with mu = 1
///     pressure = ln(b/a) - [ln(R^2 + A) + A/(R^2 + A)]_a^b / 2,    sigma_r(R) likewise from R to b.
/// Largest errors at nodes, of displacements as a part of A, of the volumetric stress as a part of mu.
TubeErrors tubeErrors(Topology cell, int n, double lambda) {
  const double A = 0.9, a = 1, b = 2;
  const auto radial = [&](double R) {  // -sigma_r
    const auto part = [&](double x) { return 0.5 * (std::log(x * x + A) + A / (x * x + A)); };
    return std::log(b / R) - (part(b) - part(R));
  };
  const fem::Mesh mesh = tube(cell, n);
  const PlaneSection section{Kind::strain, 1};
  fem::FeModel model = mixedModel(mesh, section, neoHookean(1, lambda));
  for (const int node : nodesOfSet(mesh, "angle_min")) model.prescribe(node, 1, 0, 0);
  for (const int node : nodesOfSet(mesh, "angle_max")) model.prescribe(node, 0, 0, 0);
  const fem::SideSet& inner = sideSet(mesh, "inner");
  for (auto& term : followerPressure(mesh, inner, section, {0, radial(a)},
                                     hasPotential(mesh, inner, model.dofs, model.supports)))
    model.terms.push_back(std::move(term));
  const fem::DofMap dofs = model.dofs;
  const int owed = numPressures(model), field = dofs.find(pressureField(mesh.blocks[0]).name);
  fem::FeProblem problem(std::move(model));
  // From half way, which Newton's method finds from rest.
  Numbers start(dofs.numDofs(), 0.0);
  for (const double load : {0.3, 0.6, 0.85}) start = equilibrium(problem, load, start).u;
  const auto state = equilibrium(problem, 1.0, start);
  TubeErrors errors{0, 0, state.inertia ? static_cast<int>(state.inertia->negative) : -1, owed};
  const double scale = pressureScale(mesh, mesh.blocks[0], 1);
  for (int m = 0; m < mesh.numNodes(); ++m) {
    const double x = mesh.coordinates[3 * m], y = mesh.coordinates[3 * m + 1], R = std::hypot(x, y),
                 r = std::sqrt(R * R + A);
    const int d = dofs.firstDof(m);
    errors.displacement = std::max(
        errors.displacement, std::hypot(state.u[d] - (r / R - 1) * x, state.u[d + 1] - (r / R - 1) * y) / A);
    const int p = dofs.dof(field, m, 0);
    if (p < 0) continue;
    const double stretch = R / r, exact = -radial(R) - (stretch * stretch - 1);  // sigma_r = l_r^2 - 1 + p
    errors.pressure = std::max(errors.pressure, std::abs(scale * state.u[p] - exact));
  }
  return errors;
}

}  // namespace

// Displacements of order 3, pressures of order 2, at the largest error of all nodes; every pressure is one
// negative pivot and there is no other.
TEST(MixedBody, ThickTubeIsTheClosedForm) {
  struct Expected {
    Topology cell;
    double displacement, pressure;
  };
  for (const Expected& e :
       {Expected{Topology::Quad8, 2.7, 1.8}, {Topology::Quad9, 2.9, 1.8}, {Topology::Tri6, 2.6, 1.6}}) {
    SCOPED_TRACE(fem::topologyName(e.cell));
    const TubeErrors coarse = tubeErrors(e.cell, 4, infinite), fine = tubeErrors(e.cell, 8, infinite);
    const double ofU = std::log2(coarse.displacement / fine.displacement),
                 ofP = std::log2(coarse.pressure / fine.pressure);
    RecordProperty(std::string(fem::topologyName(e.cell)) + "_rates",
                   std::to_string(ofU) + " " + std::to_string(ofP));
    EXPECT_LT(fine.displacement, 3e-4);
    EXPECT_LT(fine.pressure, 3e-2);
    EXPECT_GT(ofU, e.displacement);
    EXPECT_GT(ofP, e.pressure);
    EXPECT_EQ(fine.negative, fine.owed);
  }
}

namespace {

/// Error of the inner radius's displacement of a tube under a small pressure against Lame's.
double lockingError(double nu, bool mixed) {
  const double E = 1, p = 1e-9, a = 1, b = 2;
  const NeoHookean law = NeoHookean::fromYoung(E, nu);
  const fem::Mesh mesh = tube(Topology::Tri6, 2);
  const PlaneSection section{Kind::strain, 1};
  fem::FeModel model;
  if (mixed) {
    model = mixedModel(mesh, section, law);
  } else {
    model.dofs = fem::DofMap::displacements(mesh.numNodes(), 2);
    model.terms.push_back(
        fem::lawTerm(planeLaw(fem::pointLaw(law), section.kind),
                     planePoints(mesh, mesh.blocks[0], fem::tabulate(Topology::Tri6), section)));
  }
  for (const int node : nodesOfSet(mesh, "angle_min")) model.prescribe(node, 1, 0, 0);
  for (const int node : nodesOfSet(mesh, "angle_max")) model.prescribe(node, 0, 0, 0);
  std::vector<double> force(mesh.coordinates.size(), 0.0);
  fem::addPressure(planeEdgePoints(mesh, sideSet(mesh, "inner"), section, 4), p, force);
  model.load = model.dofs.fromVectors(force);
  const fem::DofMap dofs = model.dofs;
  fem::FeProblem problem(std::move(model));
  const auto state = equilibrium(problem, 1.0, Numbers(dofs.numDofs(), 0.0));
  double worst = 0;
  for (const int m : nodesOfSet(mesh, "inner")) {
    const double exact = (1 + nu) / E * p * a * a / (b * b - a * a) * ((1 - 2 * nu) * a + b * b / a);
    worst = std::max(
        worst, std::abs(std::hypot(state.u[dofs.firstDof(m)], state.u[dofs.firstDof(m) + 1]) / exact - 1));
  }
  return worst;
}

}  // namespace

// The error does not grow as nu goes to 1/2; that of displacements alone does.
TEST(MixedBody, DoesNotLock) {
  const double at03 = lockingError(0.3, true);
  EXPECT_LT(at03, 0.02);
  for (const double nu : {0.49, 0.4999, 0.499999, 0.49999999})
    EXPECT_LT(lockingError(nu, true), 2 * at03) << nu;
  EXPECT_GT(lockingError(0.499999, false), 5 * lockingError(0.499999, true));
}

namespace {

/// Mean displacement at the middle of the loaded edge of Cook's membrane, lambda = 7500, mu = 0.375, a shear
/// of 1/16 per area, in plane strain at small strains.
double cook(Topology cell, int n) {
  const double small = 1e-9;
  fem::QuadrilateralOptions options;
  options.corners = {0, 0, 48, 44, 48, 60, 0, 44};
  options.divisions = {n, n};
  options.topology = cell;
  const fem::Mesh mesh = fem::quadrilateralMesh(options);
  const PlaneSection section{Kind::strain, 1};
  fem::FeModel model = mixedModel(mesh, section, neoHookean(0.375, 7500));
  for (const int node : nodesOfSet(mesh, "x_min"))
    for (int i = 0; i < 2; ++i) model.prescribe(node, i, 0, 0);
  std::vector<double> force(mesh.coordinates.size(), 0.0);
  fem::addTraction(planeEdgePoints(mesh, sideSet(mesh, "x_max"), section, 4), {0, small / 16, 0}, force);
  model.load = model.dofs.fromVectors(force);
  const fem::DofMap dofs = model.dofs;
  fem::FeProblem problem(std::move(model));
  const auto state = equilibrium(problem, 1.0, Numbers(dofs.numDofs(), 0.0));
  const int middle = nodesOfSet(mesh, "x_max_y_mid").at(0);
  return state.u[dofs.firstDof(middle) + 1] / small;
}

}  // namespace

// The converged value of other codes: 16.4326, extrapolated from linear triangles (P. Krysl's FinEALE). The
// corner at the clamp is singular: order 1 to 2.
TEST(MixedBody, CooksMembraneNearlyIncompressible) {
  for (const Topology cell : {Topology::Quad8, Topology::Quad9, Topology::Tri6}) {
    const double u8 = cook(cell, 8), u16 = cook(cell, 16), u32 = cook(cell, 32);
    RecordProperty(fem::topologyName(cell),
                   std::to_string(u8) + " " + std::to_string(u16) + " " + std::to_string(u32));
    EXPECT_NEAR(u8, 16.4326, 0.02 * 16.4326) << fem::topologyName(cell);
    EXPECT_NEAR(u32, 16.4326, 0.003 * 16.4326) << fem::topologyName(cell);
    EXPECT_LT(std::abs(u32 - u16), 0.7 * std::abs(u16 - u8)) << fem::topologyName(cell);
  }
}

TEST(MixedBody, WhatCannotBeIsNamed) {
  EXPECT_FALSE(hasPressures(Topology::Quad4));
  EXPECT_FALSE(hasPressures(Topology::Shell8));
  try {
    pressureNodes(rectangle(Topology::Quad4, {1, 1}).blocks[0]);
    FAIL();
  } catch (const std::invalid_argument& e) {
    EXPECT_STREQ(e.what(), "block 'body': QUAD4 has no pressures beside its displacements");
  }
}

// Corners of a quadrilateral, and what is none.
TEST(QuadrilateralMesh, CornersAndRefusals) {
  fem::QuadrilateralOptions options;
  options.corners = {0, 0, 48, 44, 48, 60, 0, 44};
  options.divisions = {2, 2};
  const fem::Mesh mesh = fem::quadrilateralMesh(options);
  const int node = nodesOfSet(mesh, "x_max_y_max").at(0);
  EXPECT_EQ(mesh.coordinates[3 * node], 48);
  EXPECT_EQ(mesh.coordinates[3 * node + 1], 60);
  options.corners = {0, 0, 0, 44, 48, 60, 48, 44};
  EXPECT_THROW(fem::quadrilateralMesh(options), std::invalid_argument);
}
