// Pressures that follow the edges of plane bodies.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "atrapos/fem/LawTerm.hpp"
#include "atrapos/fem/ReferenceCell.hpp"
#include "atrapos/fem/StructuredPlane.hpp"
#include "atrapos/solid/EdgePressure.hpp"
#include "atrapos/solid/NeoHookean.hpp"
#include "atrapos/solid/SaintVenantKirchhoff.hpp"
#include "support/Checks.hpp"
#include "support/Meshes.hpp"
#include "support/Vectors.hpp"

using namespace atrapos;
using namespace atrapos::solid;
using namespace atrapos::fem::test;
using Kind = PlaneSection::Kind;

namespace {

constexpr LoadAmount amount{0.5, 2};
constexpr double lambda = 0.75, pressure = 2;

fem::Mesh ringMesh(fem::Topology cell, double degrees, std::array<int, 2> divisions = {2, 5}) {
  fem::AnnulusOptions options;
  options.topology = cell;
  options.angleMax = degrees;
  options.divisions = divisions;
  return fem::annulusMesh(options);
}

fem::SideSet allEdges(const fem::Mesh& mesh) {
  fem::SideSet all;
  for (const fem::SideSet& set : mesh.sideSets)
    all.sides.insert(all.sides.end(), set.sides.begin(), set.sides.end());
  return all;
}

/// Terms of a pressure alone.
fem::FeModel pressed(const fem::Mesh& mesh, const fem::SideSet& set, const PlaneSection& section,
                     bool potential) {
  fem::FeModel model;
  model.dofs = fem::DofMap::displacements(mesh.numNodes(), 2);
  for (auto& term : followerPressure(mesh, set, section, amount, potential))
    model.terms.push_back(std::move(term));
  return model;
}

/// Nodal forces of all terms.
Numbers forces(fem::FeModel model, const Numbers& u) {
  const fem::FeProblem problem(std::move(model));
  Numbers all(u.size(), 0.0);
  for (int t = 0; t < problem.numTerms(); ++t)
    all = sum(all, 1, problem.forces(problem.term(t), {vectorOf(problem, u), lambda}));
  return all;
}

/// Volume of a deformed body, integrated over its cells.
double volume(const fem::Mesh& mesh, const PlaneSection& section, const Numbers& u) {
  fem::Mesh moved = mesh;
  for (int n = 0; n < mesh.numNodes(); ++n)
    for (int i = 0; i < 2; ++i) moved.coordinates[3 * n + i] += u[2 * n + i];
  const auto cell =
      fem::tabulate(mesh.blocks[0].topology, 6);  // r times the Jacobian: 2 + 3 in each direction
  double sum = 0;
  for (const double w : planeValuePoints(moved, mesh.blocks[0], cell, section).weights) sum += w;
  return sum;
}

class EdgePressures : public testing::TestWithParam<fem::Topology> {};

}  // namespace

// Around a whole body the pressure is the derivative of pressure times the volume inside, which is integrated
// over the cells.
TEST_P(EdgePressures, IsTheDerivativeOfTheVolume) {
  for (const double degrees : {90.0, 360.0})
    for (const Kind kind : {Kind::strain, Kind::axisymmetric}) {
      if (kind == Kind::axisymmetric && degrees > 90) continue;  // on both sides of the axis
      const PlaneSection section{kind, 0.2};
      const fem::Mesh mesh = ringMesh(GetParam(), degrees);
      const fem::SideSet all = allEdges(mesh);
      Numbers u = randomNumbers(2 * mesh.numNodes(), 0.02, 3);
      for (int n = 0; n < mesh.numNodes(); ++n)
        if (mesh.coordinates[3 * n] < 1e-9 && degrees < 360) u[2 * n] = 0;
      const Numbers direct = forces(pressed(mesh, all, section, true), u);
      const Numbers direction = randomNumbers(u.size(), 1, 4);
      // A volume is a polynomial of degree 3 in h: its difference quotient is off by h^2 / 6 of its third
      // derivative.
      const auto error = [&](double h) {
        return std::abs(
            pressure *
                (volume(mesh, section, sum(u, h, direction)) - volume(mesh, section, sum(u, -h, direction))) /
                (2 * h) -
            dot(direct, direction));
      };
      const double size = norm(direct) * norm(direction);
      EXPECT_LT(error(1e-4), 1e-7 * size);
      if (kind == Kind::axisymmetric) {
        EXPECT_NEAR(error(2e-2) / error(1e-2), 4, 0.01);
      } else {
        EXPECT_LT(error(1e-2), 1e-12 * size);  // the area has degree 2
      }
    }
}

// Where all ends are held as hasPotential wants it the assembled tangent is symmetric, at the supports too
// where their rows are; where one is free it is not.
TEST_P(EdgePressures, TangentIsSymmetricAtHeldEnds) {
  for (const Kind kind : {Kind::strain, Kind::axisymmetric})
    for (const bool held : {true, false}) {
      const fem::Mesh mesh = ringMesh(GetParam(), 90);
      fem::FeModel model;
      model.dofs = fem::DofMap::displacements(mesh.numNodes(), 2);
      for (const int n : nodesOfSet(mesh, "angle_min")) model.prescribe(n, 1, 0.01, 0.02);
      if (held)
        for (const int n : nodesOfSet(mesh, "angle_max")) model.prescribe(n, 0, 0.1, 0);
      EXPECT_EQ(hasPotential(mesh, sideSet(mesh, "inner"), model.dofs, model.supports), held);
      Numbers u = randomNumbers(2 * mesh.numNodes(), 0.02, 3);
      for (std::size_t d = 0; d < u.size(); ++d)
        if (model.supports.fixed(d)) u[d] = model.supports.at(d, lambda);
      for (auto& term : followerPressure(mesh, sideSet(mesh, "inner"), {kind, 0.2}, amount, held))
        model.terms.push_back(std::move(term));
      fem::FeProblem problem(std::move(model));
      EXPECT_EQ(problem.symmetric(), held);
      const Tangent K = tangent(problem, u, lambda);
      double largestGap = 0, largest = 0;
      for (std::size_t i = 0; i < u.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
          largestGap = std::max(largestGap, std::abs(K.at(i, j) - K.at(j, i)));
          largest = std::max(largest, std::abs(K.at(i, j)));
        }
      EXPECT_GT(largest, 0.05);
      if (held) {
        EXPECT_LT(largestGap, 1e-14 * largest);  // rounding of two sums
      } else {
        EXPECT_GT(largestGap, 1e-3 * largest);
      }
    }
}

TEST_P(EdgePressures, TangentAndOrders) {
  const fem::Mesh mesh = ringMesh(GetParam(), 80);
  for (const Kind kind : {Kind::strain, Kind::axisymmetric})
    for (const bool potential : {true, false}) {
      const PlaneSection section{kind, 0.2};
      const auto model = [&] {
        fem::FeModel m;
        m.dofs = fem::DofMap::displacements(mesh.numNodes(), 2);
        const fem::Block& block = mesh.blocks[0];
        m.terms.push_back(
            fem::lawTerm(planeLaw(fem::pointLaw(SaintVenantKirchhoff::fromYoung(1, 0.3)), section.kind),
                         planePoints(mesh, block, fem::tabulate(block.topology), section)));
        for (const int n : nodesOfSet(mesh, "angle_min")) m.prescribe(n, 1, 0, 0.1);
        for (const int n : nodesOfSet(mesh, "angle_max")) m.prescribe(n, 0, 0.02, 0);
        for (auto& term : followerPressure(mesh, sideSet(mesh, "inner"), section, {0.1, 0.2}, potential))
          m.terms.push_back(std::move(term));
        EXPECT_EQ(m.terms.back()->symmetric(), potential);
        return m;
      };
      checkTangent(model());
      checkOrders(model());
    }
}

INSTANTIATE_TEST_SUITE_P(All, EdgePressures,
                         testing::Values(fem::Topology::Quad4, fem::Topology::Quad8, fem::Topology::Quad9,
                                         fem::Topology::Tri3, fem::Topology::Tri6),
                         [](const auto& info) { return std::string(fem::topologyName(info.param)); });

namespace {

/// Fad types against differences and the first order of a series.
template <bool ring>
void checkLaw() {
  constexpr int L = taylor::nativeLanes;
  const EdgePressure<ring> law{amount};
  const Numbers in = randomNumbers(5, 1, 6), data = randomNumbers(3, 1, 7),
                direction = randomNumbers(5, 1, 8);
  Numbers out(4), jacobian(20);
  taylor::tangent(law, in.data(), data.data(), out.data(), jacobian.data());
  const auto at = [&](const Numbers& x) {
    Numbers y(4);
    taylor::value(law, x.data(), data.data(), y.data());
    return y;
  };
  Numbers along(4, 0.0);
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 5; ++j) along[i] += jacobian[5 * i + j] * direction[j];
  const auto error = [&](double h) {
    const Numbers quotient = sum(at(sum(in, h, direction)), -1, at(sum(in, -h, direction)));
    return norm(sum(quotient, -2 * h, along)) / (2 * h);
  };
  EXPECT_LT(error(1e-4), 1e-7);
  if (ring) {
    EXPECT_NEAR(error(0.02) / error(0.01), 4, 1e-6);  // degree 3: h^2 alone
  } else {
    EXPECT_LT(error(0.01), 1e-13);  // degree 2: rounding
  }

  using Values = taylor::Lanes<L>;
  taylor::Context<L> context;
  context.shape = taylor::historyShape(law);
  Numbers memory(context.shape.template doubles<L>(1), std::nan(""));
  context.memory = memory.data();
  Values x[5], d[3], y[4];
  for (int j = 0; j < 5; ++j) x[j] = in[j];
  for (int j = 0; j < 3; ++j) d[j] = data[j];
  taylor::start(law, context, x, d, y);
  context.order = 1;
  for (int j = 0; j < 5; ++j) x[j] = direction[j];
  taylor::sweepKnown(law, context, x, d, y);
  for (int i = 0; i < 4; ++i)
    for (int l = 0; l < L; ++l) EXPECT_NEAR(y[i][l], along[i], 1e-14);
}

/// Largest error of the displacement at nodes of a hollow sphere 1 < r < 2 under a small inner pressure,
/// against Lame's, as a part of it: n cells through the wall, 2 n along the quarter.
double sphereError(fem::Topology cell, int n) {
  const double E = 1, nu = 0.3, p = 1e-9, a = 1, b = 2;
  const fem::Mesh mesh = ringMesh(cell, 90, {n, 2 * n});
  const PlaneSection section{Kind::axisymmetric, 1};
  fem::FeModel model;
  model.dofs = fem::DofMap::displacements(mesh.numNodes(), 2);
  for (const int node : nodesOfSet(mesh, "angle_min")) model.prescribe(node, 1, 0, 0);
  for (const int node : nodesOfSet(mesh, "angle_max")) model.prescribe(node, 0, 0, 0);
  model.terms.push_back(
      fem::lawTerm(planeLaw(fem::pointLaw(SaintVenantKirchhoff::fromYoung(E, nu)), section.kind),
                   planePoints(mesh, mesh.blocks[0], fem::tabulate(cell), section)));
  const fem::SideSet& inner = sideSet(mesh, "inner");
  for (auto& term :
       followerPressure(mesh, inner, section, {0, p}, hasPotential(mesh, inner, model.dofs, model.supports)))
    model.terms.push_back(std::move(term));
  fem::FeProblem problem(std::move(model));
  EXPECT_TRUE(problem.symmetric());
  const auto state = equilibrium(problem, 1.0, Numbers(problem.model().dofs.numDofs(), 0.0));
  double worst = 0;
  for (int m = 0; m < mesh.numNodes(); ++m) {
    const double x = mesh.coordinates[3 * m], y = mesh.coordinates[3 * m + 1], r = std::hypot(x, y);
    const double exact = p * a * a * a / (E * (b * b * b - a * a * a)) *
                         ((1 - 2 * nu) * r + (1 + nu) * b * b * b / (2 * r * r));
    worst = std::max(worst,
                     std::hypot(state.u[2 * m] - exact * x / r, state.u[2 * m + 1] - exact * y / r) / exact);
  }
  return worst;
}

}  // namespace

TEST(EdgePressure, LawsThreeWays) {
  checkLaw<false>();
  checkLaw<true>();
}

// Lame's hollow sphere: displacements are good to the degree and one more; QUAD8 with 2 x 2 points and QUAD9
// to more at nodes.
TEST(EdgePressure, HollowSphereIsLames) {
  struct Expected {
    fem::Topology cell;
    double error, rate;
  };
  for (const Expected& e : {Expected{fem::Topology::Quad4, 1.5e-2, 1.8},
                            {fem::Topology::Quad8, 2e-4, 2.5},
                            {fem::Topology::Quad9, 1e-4, 3.7},
                            {fem::Topology::Tri3, 6e-2, 1.3},
                            {fem::Topology::Tri6, 1.5e-3, 2.5}}) {
    const double coarse = sphereError(e.cell, 4), fine = sphereError(e.cell, 8);
    EXPECT_LT(fine, e.error) << fem::topologyName(e.cell);
    RecordProperty(fem::topologyName(e.cell), std::to_string(std::log2(coarse / fine)));
    EXPECT_GT(std::log2(coarse / fine), e.rate) << fem::topologyName(e.cell);
  }
}

// The supports of a quarter of a ring carry the pressure's resultant, a radius times the thickness each.
TEST(EdgePressure, ReactionsAreThoseOfThePressure) {
  const fem::Mesh mesh = ringMesh(fem::Topology::Quad8, 90, {2, 4});
  const PlaneSection section{Kind::strain, 0.2};
  fem::FeModel model;
  model.dofs = fem::DofMap::displacements(mesh.numNodes(), 2);
  for (const int node : nodesOfSet(mesh, "angle_min")) model.prescribe(node, 1, 0, 0);
  for (const int node : nodesOfSet(mesh, "angle_max")) model.prescribe(node, 0, 0, 0);
  model.terms.push_back(
      fem::lawTerm(planeLaw(fem::pointLaw(SaintVenantKirchhoff::fromYoung(100, 0.3)), section.kind),
                   planePoints(mesh, mesh.blocks[0], fem::tabulate(fem::Topology::Quad8), section)));
  for (auto& term : followerPressure(mesh, sideSet(mesh, "inner"), section, {0, 2}, true))
    model.terms.push_back(std::move(term));
  fem::FeProblem problem(std::move(model));
  const auto state = equilibrium(problem, 1.0, Numbers(problem.model().dofs.numDofs(), 0.0));
  const Numbers reactions = problem.reactions({vectorOf(problem, state.u), 1.0});
  double x = 0, y = 0, deformed = 0;
  for (const int n : nodesOfSet(mesh, "angle_max")) x += reactions[2 * n];
  for (const int n : nodesOfSet(mesh, "angle_min")) {
    y += reactions[2 * n + 1];
    if (std::abs(mesh.coordinates[3 * n] - 1) < 1e-9) deformed = 1 + state.u[2 * n];
  }
  EXPECT_GT(deformed, 1.01);
  EXPECT_NEAR(y, -2 * deformed * 0.2, 1e-10);  // Newton's tolerance times the stiffness
  EXPECT_NEAR(x, y, 1e-10);
}

TEST(EdgePressure, WhereThereIsNoPotential) {
  const fem::Mesh mesh = ringMesh(fem::Topology::Quad8, 90);
  const fem::SideSet& inner = sideSet(mesh, "inner");
  fem::Supports none;
  const fem::DofMap dofs = fem::DofMap::displacements(mesh.numNodes(), 2);
  EXPECT_FALSE(hasPotential(mesh, inner, dofs, none));
  const fem::Mesh closed = ringMesh(fem::Topology::Quad8, 360);
  EXPECT_TRUE(
      hasPotential(closed, sideSet(closed, "inner"), fem::DofMap::displacements(closed.numNodes(), 2), none));
  const auto with = [&](double valueAtMax, double rateAtMax, double valueAtMin) {
    fem::FeModel model;
    model.dofs = dofs;
    for (const int n : nodesOfSet(mesh, "angle_max")) model.prescribe(n, 0, valueAtMax, rateAtMax);
    for (const int n : nodesOfSet(mesh, "angle_min")) model.prescribe(n, 0, valueAtMin, 0);
    return hasPotential(mesh, inner, model.dofs, model.supports);
  };
  EXPECT_TRUE(with(1, 0, 0));     // both ends slide along x = 1
  EXPECT_FALSE(with(0, 0, 0));    // x = 0 and x = 1
  EXPECT_FALSE(with(1, 0.5, 0));  // one moves along x
}

TEST(EdgePressure, WhatCannotBeIsNamed) {
  const auto messageOf = [](const auto& f) -> std::string {
    try {
      f();
    } catch (const std::invalid_argument& e) {
      return e.what();
    }
    return "";
  };
  const fem::Mesh mesh = ringMesh(fem::Topology::Quad4, 90);
  EXPECT_EQ(
      messageOf([&] {
        followerPressure(mesh, sideSet(mesh, "inner"), {Kind::stress, 1}, amount, false);
      }),
      "a pressure that follows acts on the thickness of the deformed edge, which plane stress leaves open; "
      "expected kind: strain or axisymmetric, or a pressure that does not follow");
  const fem::Mesh solid = box(fem::Topology::Hex8);
  EXPECT_EQ(messageOf([&] { followerPressure(solid, sideSet(solid, "x_min"), {}, amount, false); }),
            "side set 'x_min': side 4 of element 1 is no edge of a plane cell");
}

TEST(AnnulusMesh, AreaSetsAndOrientation) {
  for (const auto cell : {fem::Topology::Quad4, fem::Topology::Quad8, fem::Topology::Quad9,
                          fem::Topology::Tri3, fem::Topology::Tri6}) {
    const PlaneSection section{Kind::strain, 1};
    const double pi = std::acos(-1.0);
    const auto error = [&](int n) {
      const fem::Mesh mesh = ringMesh(cell, 90, {1, n});
      EXPECT_EQ(mesh.dimension, 2);
      return std::abs(volume(mesh, section, Numbers(2 * mesh.numNodes(), 0.0)) - 0.75 * pi);  // and det > 0
    };
    // Chords are good to h^2, parabolas through three points of an arc to h^4.
    EXPECT_NEAR(std::log2(error(4) / error(8)),
                cell == fem::Topology::Quad4 || cell == fem::Topology::Tri3 ? 2 : 4, 0.05);
  }
  const fem::Mesh open = ringMesh(fem::Topology::Quad8, 90), closed = ringMesh(fem::Topology::Quad8, 360);
  EXPECT_EQ(nodesOfSet(open, "inner").size(), 11u);
  EXPECT_EQ(nodesOfSet(closed, "outer").size(), 10u);
  EXPECT_EQ(open.sideSets.size(), 4u);
  EXPECT_EQ(closed.sideSets.size(), 2u);
  EXPECT_THROW(ringMesh(fem::Topology::Hex8, 90), std::invalid_argument);
}
