// Loads of shells: resultants, work, and followers in their three uses.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "ShellChecks.hpp"
#include "support/Meshes.hpp"

using namespace atrapos;
using namespace atrapos::solid;
using namespace atrapos::solid::test;
using namespace atrapos::fem::test;

namespace {

constexpr double thickness = 0.1;

/// Sum of forces on v, and its moment about the origin with that of the forces on w (arm: D + w).
struct Resultant {
  Vec3 force{}, moment{};
};
Resultant resultant(const ShellGrid& grid, const Numbers& f, const Numbers& u) {
  Resultant r;
  const auto add = [&](const Vec3& arm, const double* force) {
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      r.moment[i] += arm[j] * force[k] - arm[k] * force[j];
    }
  };
  for (int n = 0; n < grid.numNodes(); ++n) {
    const Vec3 D = grid.D(n);
    const int w = grid.director(n);
    Vec3 x, d;
    for (int i = 0; i < 3; ++i) {
      x[i] = grid.x[n][i] + u[3 * n + i];
      d[i] = D[i] + u[3 * w + i];
      r.force[i] += f[3 * n + i];
    }
    add(x, &f[3 * n]);
    add(d, &f[3 * w]);
  }
  return r;
}

ShellGrid curved() { return shellGrid(3, 2, thickness, cylinder(1, 0, 1, 0, 0.7)); }

struct Loaded {
  ShellGrid grid = curved();
  fem::FeModel model = shellModel(grid, SaintVenantKirchhoff::fromYoung(1, 0.3));

  Loaded() { clamp(model, grid, grid.lineI(0)); }
};

/// -1 times the term's forces: the load on the body.
Numbers loadOf(const fem::FeProblem& problem, int term, const Numbers& u, double lambda) {
  Numbers f = problem.forces(problem.term(term), {vectorOf(problem, u), lambda});
  for (double& x : f) x = -x;
  return f;
}

void expectNear(const Vec3& a, const Vec3& b, double tolerance) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], tolerance) << "component " << i;
}

}  // namespace

// Weight of a curved shell: R t theta L on v; on w the part of the volume outside the mid-surface, which is
// larger than that inside: t^2/(6 R) of the area.
TEST(ShellLoads, BodyForce) {
  const auto errors = [](int n) {
    const ShellGrid grid = shellGrid(n, 2, thickness, cylinder(1, 0, 1, 0, 0.7));
    Numbers f(6 * grid.numNodes(), 0.0);
    addShellBodyForce(grid.elements(), {0, 3, 0}, f);
    double onV = 0, onW = 0;
    for (int k = 0; k < grid.numNodes(); ++k) {
      onV += f[3 * k + 1];
      onW += f[3 * grid.director(k) + 1];
      EXPECT_EQ(f[3 * k], 0);
    }
    return std::array<double, 2>{std::abs(onV / (3 * 0.7 * thickness) - 1),
                                 std::abs(onW / (3 * 0.7 * thickness * thickness / 6) - 1)};
  };
  const auto coarse = errors(3), fine = errors(6);
  for (int i : {0, 1}) {
    EXPECT_LT(coarse[i], 5e-3);
    EXPECT_LT(fine[i], coarse[i] / 7);  // third order or better: parabolas for arcs
  }
}

// Dead loads: forces and moments of the surfaces they act on. Nodal sums of numbers of size one: rounding.
TEST(ShellLoads, DeadResultants) {
  const ShellGrid grid = shellGrid(3, 2, thickness, flat(2, 1));
  const ShellElements elements = grid.elements();
  const Numbers none(6 * grid.numNodes(), 0.0);
  Numbers f = none;
  addShellAreaForce(elements, topSurface, {3, 0, 0}, f);
  Resultant r = resultant(grid, f, none);
  expectNear(r.force, {6, 0, 0}, 1e-13);
  expectNear(r.moment, {0, 6 * thickness / 2, -6 * 0.5}, 1e-13);
  f = none;
  addShellPressure(elements, bottomSurface, 2, f);
  expectNear(resultant(grid, f, none).force, {0, 0, -4}, 1e-13);
  f = none;
  addShellEdgeForce(elements, grid.side(2), {0, 5, 0}, f);
  expectNear(resultant(grid, f, none).force, {0, 10, 0}, 1e-13);
  EXPECT_NEAR(lengthOf(elements, grid.side(1)), 1, 1e-14);
}

// Squeezed between equal pressures: E_33 = -p/E, E_11 = E_22 = nu p/E.
TEST(ShellLoads, SqueezedPlate) {
  const ShellGrid grid = shellGrid(2, 2, thickness, flat(1, 1));
  fem::FeModel model = shellModel(grid, SaintVenantKirchhoff::fromYoung(2, 0.3));
  addShellPressure(grid.elements(), topSurface, 0.01, model.load);
  addShellPressure(grid.elements(), bottomSurface, -0.01, model.load);
  hold(model, {grid.node(0, 0)}, "xyz");
  hold(model, {grid.node(4, 0)}, "yz");
  hold(model, {grid.node(0, 4)}, "z");
  fem::FeProblem problem(std::move(model));
  const Numbers u = linearSolution(problem);
  const int corner = grid.node(4, 4);
  EXPECT_NEAR(u[3 * corner], 0.3 * 0.005, 1e-14);  // rounding times the plate's condition, (1/t)^2
  EXPECT_NEAR(u[3 * corner + 1], 0.3 * 0.005, 1e-14);
  for (int n = 0; n < grid.numNodes(); ++n)
    EXPECT_NEAR(u[3 * grid.director(n) + 2], -0.005 * thickness / 2, 1e-14);
}

// On a deformed flat plate x = F X the area vector is cof(F) times the undeformed one.
TEST(ShellLoads, FollowerPressureIsThatOfTheDeformedArea) {
  const ShellGrid grid = shellGrid(2, 3, thickness, flat(2, 1));
  fem::FeModel model = shellModel(grid, SaintVenantKirchhoff::fromYoung(1, 0));
  for (double zeta : {bottomSurface, midSurface, topSurface})
    model.terms.push_back(followerPressure(grid.elements(), {0, 1, 2, 3, 4, 5}, zeta, {0.5, 2}));
  fem::FeProblem problem(std::move(model));
  Numbers u(6 * grid.numNodes(), 0.0);
  const double F[9] = {1.1, 0.2, 0.3, -0.1, 0.9, 0.2, 0.4, -0.3, 1.2};
  for (int n = 0; n < grid.numNodes(); ++n)
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        u[3 * n + i] += (F[3 * i + j] - (i == j)) * grid.x[n][j];
        u[3 * grid.director(n) + i] += (F[3 * i + j] - (i == j)) * grid.D(n)[j];
      }
  const Vec3 area{2 * (F[3] * F[7] - F[6] * F[4]), 2 * (F[6] * F[1] - F[0] * F[7]),
                  2 * (F[0] * F[4] - F[3] * F[1])};
  for (int t = 1; t <= 3; ++t)
    expectNear(resultant(grid, loadOf(problem, t, u, 0.75), u).force,
               {-2 * area[0], -2 * area[1], -2 * area[2]}, 1e-13);
}

// The couple of a dead moment is that moment, however the directors have turned, up to its part about them.
TEST(ShellLoads, MomentsAreCouples) {
  Loaded l;
  DeadEdgeMoment moment;
  moment.y.rate = 3;
  l.model.terms.push_back(deadEdgeMoment(l.grid.elements(), l.grid.side(1), moment));
  FollowerEdgeLoad follower;
  follower.moment.rate = 3;
  l.model.terms.push_back(followerEdgeLoad(l.grid.elements(), l.grid.side(1), follower));
  fem::FeProblem problem(std::move(l.model));
  Numbers u(6 * l.grid.numNodes(), 0.0);
  for (double angle : {0.0, 1.0, 4.0}) {
    // All directors turned about y: the edge's own axis.
    for (int n = 0; n < l.grid.numNodes(); ++n) {
      const Vec3 D = l.grid.D(n);
      double* w = &u[3 * l.grid.director(n)];
      w[0] = (std::cos(angle) - 1) * D[0] + std::sin(angle) * D[2];
      w[2] = -std::sin(angle) * D[0] + (std::cos(angle) - 1) * D[2];
    }
    for (int term : {1, 2}) {
      const Resultant r = resultant(l.grid, loadOf(problem, term, u, 1), u);
      expectNear(r.force, {0, 0, 0}, 1e-14);
      expectNear(r.moment, {0, 3 * 0.7, 0}, 1e-13);
    }
  }
}

TEST(ShellLoads, EdgeForcesTurnWithTheEdge) {
  Loaded l;
  FollowerEdgeLoad load;
  load.outward.constant = 1;
  load.director.constant = 2;
  load.along.constant = 4;
  l.model.terms.push_back(followerEdgeLoad(l.grid.elements(), l.grid.side(1), load));
  fem::FeProblem problem(std::move(l.model));
  const Numbers u(6 * l.grid.numNodes(), 0.0);
  // The edge at angle 1: director (sin 1, 0, cos 1), outward (cos 1, 0, -sin 1), along y; length 0.7.
  const double c = std::cos(1.0), s = std::sin(1.0);
  expectNear(resultant(l.grid, loadOf(problem, 1, u, 0), u).force,
             {0.7 * (c + 2 * s), 0.7 * 4, 0.7 * (2 * c - s)}, 1e-14);
}

TEST(ShellLoads, FollowersTangentsAndOrders) {
  Loaded l;
  const auto elements = l.grid.elements();
  l.model.terms.push_back(followerPressure(elements, {1, 3, 4, 5}, topSurface, {0.001, 0.004}));
  FollowerEdgeLoad load;
  load.outward.rate = 0.002;
  load.director.constant = 0.001;
  load.along.rate = -0.001;
  load.moment = {1e-4, 2e-4};
  l.model.terms.push_back(followerEdgeLoad(elements, l.grid.side(1), load));
  DeadEdgeMoment moment;
  moment.y = {1e-4, 1e-4};
  l.model.terms.push_back(deadEdgeMoment(elements, {{0, 0}}, moment));
  const Numbers u = randomState(l.model, 0.02, 17), direction = randomState(l.model, 0.02, 18);
  fem::FeProblem problem(std::move(l.model));
  EXPECT_FALSE(problem.symmetric());
  expectTangent(problem, u, direction, 0.4);
  expectOrders(problem, u, 0.4);
}

TEST(ShellLoads, Refused) {
  const ShellGrid grid = curved();
  DeadEdgeMoment drilling;
  drilling.z.rate = 1;
  try {
    deadEdgeMoment(grid.elements(), grid.side(3), drilling);
    FAIL() << "not refused";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(
        error.what(),
        "the moment on edge 4 of shell element 1 has a part about the director: shells take no drilling "
        "moments");
  }
  EXPECT_THROW(followerPressure(grid.elements(), {6}, midSurface, {}), std::invalid_argument);
  EXPECT_THROW(followerEdgeLoad(grid.elements(), {{0, 4}}, {}), std::invalid_argument);
}
