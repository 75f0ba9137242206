// Patch tests and rigid motions of the shell element.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "ShellModel.hpp"
#include "support/Meshes.hpp"

using namespace atrapos;
using namespace atrapos::solid;
using namespace atrapos::solid::test;
using namespace atrapos::fem::test;

namespace {

const auto material = SaintVenantKirchhoff::fromYoung(1.0, 0.3);
constexpr double thickness = 0.05;

std::vector<char> outline(const ShellGrid& grid) {
  std::vector<char> outer(grid.numNodes(), 0);
  for (const auto& line : {grid.lineI(0), grid.lineI(2 * grid.nu), grid.lineJ(0), grid.lineJ(2 * grid.nv)})
    for (int n : line) outer[n] = 1;
  return outer;
}

/// Distorted quadrilaterals in a unit square, edges straight.
ShellGrid quadrilaterals(Shear shear = Shear::compatible) {
  return shaken(shellGrid(3, 3, thickness, flat(1, 1), undistorted, nodesOf(shear)), 0.08);
}

/// Equal parallelograms.
ShellGrid parallelograms(Shear shear = Shear::compatible) {
  return shellGrid(
      3, 3, thickness,
      [](double s, double t) {
        return SurfacePoint{{s + 0.4 * t, 0.1 * s + 0.9 * t, 0}, {0, 0, 1}};
      },
      undistorted, nodesOf(shear));
}

/// v and w of the plate theory: curvatures k = (w_xx, w_yy, w_xy) of z = -(...)/2, sections stay normal.
Numbers bent(const ShellGrid& grid, const Vec3& k) {
  Numbers u(6 * grid.numNodes(), 0.0);
  for (int n = 0; n < grid.numNodes(); ++n) {
    const double x = grid.x[n][0], y = grid.x[n][1];
    u[3 * n + 2] = -(k[0] * x * x + k[1] * y * y + 2 * k[2] * x * y) / 2;
    u[3 * grid.director(n)] = thickness / 2 * (k[0] * x + k[2] * y);
    u[3 * grid.director(n) + 1] = thickness / 2 * (k[2] * x + k[1] * y);
  }
  return u;
}

/// The linear problem with the outline driven to `exact`: largest error inside, in units of the largest u.
double patchError(fem::FeModel model, const ShellGrid& grid, const Numbers& exact) {
  const auto outer = outline(grid);
  for (int n = 0; n < grid.numNodes(); ++n)
    for (int i = 0; i < 3 && outer[n]; ++i) {
      model.prescribe(n, i, 0, exact[3 * n + i]);
      model.prescribe(grid.director(n), i, 0, exact[3 * grid.director(n) + i]);
    }
  fem::FeProblem problem(std::move(model));
  EXPECT_GT(problem.numFreeDofs(), 0);
  return largest(sum(linearSolution(problem), -1, exact)) / largest(exact);
}

double patchError(const ShellGrid& grid, const Numbers& exact, Shear shear = Shear::compatible) {
  return patchError(shellModel(grid, material, {}, shear), grid, exact);
}

/// Strain energy u.K u/2 of the linear element.
double energy(const ShellGrid& grid, const Numbers& u) {
  fem::FeProblem problem(shellModel(grid, material));
  return 0.5 * dot(u, tangent(problem, Numbers(u.size(), 0.0), 0).times(u));
}

/// Q U - I: plane stretch and shear U with the thickness stretch that leaves S_33 = 0, turned by Q.
Matrix membraneState() {
  const double a = 1.2, b = 0.1, c = 0.05, d = 1.1, nu = 0.3;  // in-plane part of U
  const double E11 = (a * a + c * c - 1) / 2, E22 = (b * b + d * d - 1) / 2;
  const double stretch = std::sqrt(1 - 2 * nu / (1 - nu) * (E11 + E22));
  const Matrix U{a, b, 0, c, d, 0, 0, 0, stretch};
  Matrix Q = rotation(0.5), A{};
  for (int i = 0; i < 3; ++i) Q[4 * i] += 1;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      for (int k = 0; k < 3; ++k) A[3 * i + j] += Q[3 * i + k] * U[3 * k + j];
      A[3 * i + j] -= i == j;
    }
  return A;
}

}  // namespace

// Membrane patch test at finite strain and rotation: a homogeneous state with free faces. The thickness finds
// its stretch, the enhanced strain stays zero.
void expectHomogeneousState(Shear shear) {
  const ShellGrid grid = quadrilaterals(shear);
  const Matrix A = membraneState();
  const Numbers exact = homogeneous(grid, A);
  fem::FeModel model = shellModel(grid, material, {}, shear);
  const auto outer = outline(grid);
  for (int n = 0; n < grid.numNodes(); ++n)
    for (int i = 0; i < 3 && outer[n]; ++i) {
      model.prescribe(n, i, 0, exact[3 * n + i]);
      model.prescribe(grid.director(n), i, 0, exact[3 * grid.director(n) + i]);
    }
  fem::FeProblem problem(std::move(model));
  ASSERT_GT(problem.numFreeDofs(), 0);
  const Numbers off = randomNumbers(exact.size(), 0.1 * thickness, 5);
  Numbers start = exact;
  for (int n = 0; n < grid.numNodes(); ++n)
    for (int i = 0; i < 3 && !outer[n]; ++i)
      for (int d : {3 * n + i, 3 * grid.director(n) + i}) start[d] += off[d];
  const Numbers u = equilibrium(problem, 1.0, start, 1e-11).u;
  // Displacements of size 0.1: rounding times the condition of a thin mesh, (1/thickness)^2.
  EXPECT_LT(largest(sum(u, -1, exact)), 1e-12);
  double expected[6];
  material.observe(A.data(), nullptr, expected);
  const auto seen = problem.term(0).observe(fem::field(*vectorOf(problem, u)), 0);
  const std::size_t points = isTriangle(nodesOf(shear)) ? 18 * 6 : 9 * 8;
  ASSERT_EQ(seen.values.size(), points * 6);
  double worst = 0;
  for (std::size_t i = 0; i < seen.values.size(); ++i)
    worst = std::max(worst, std::abs(seen.values[i] - expected[i % 6]));
  EXPECT_LT(worst, 1e-10);  // the same divided by the thickness
}

TEST(ShellPatch, HomogeneousStateOnQuadrilaterals) { expectHomogeneousState(Shear::compatible); }
TEST(ShellPatch, HomogeneousStateWithAssumedShear) { expectHomogeneousState(Shear::assumed); }
TEST(ShellPatch, HomogeneousStateWithFourNodes) { expectHomogeneousState(Shear::mitc4); }
TEST(ShellPatch, HomogeneousStateWithThreeNodes) { expectHomogeneousState(Shear::mitc3); }
TEST(ShellPatch, HomogeneousStateWithSixNodes) { expectHomogeneousState(Shear::mitc6); }

// Constant bending and twist: exact on parallelograms.
TEST(ShellPatch, BendingAndTwistOnParallelograms) {
  // Linear solutions on a thin mesh: rounding times (1/thickness)^2 times a few nodes.
  for (Shear shear : {Shear::compatible, Shear::assumed, Shear::mitc4, Shear::mitc3, Shear::mitc6}) {
    const ShellGrid grid = parallelograms(shear);
    EXPECT_LT(patchError(grid, bent(grid, {1, 0, 0}), shear), 1e-11);
    EXPECT_LT(patchError(grid, bent(grid, {0, 1, 0}), shear), 1e-11);
    EXPECT_LT(patchError(grid, bent(grid, {0, 0, 1}), shear), 1e-11);
    EXPECT_LT(patchError(grid, bent(grid, {0.3, -0.8, 0.5}), shear), 1e-11);
  }
}

// On other quadrilaterals an eight-node element has no complete quadratic (xi^2 eta^2 is missing): not exact,
// but small, and converging where refinement leaves elements less distorted.
TEST(ShellPatch, BendingOnQuadrilateralsConverges) {
  const auto grid = [](int n) {
    return shellGrid(n, n, thickness, [](double s, double t) {
      return SurfacePoint{{s + 0.4 * s * t, t - 0.2 * s * t, 0}, {0, 0, 1}};
    });
  };
  for (const Vec3& k : {Vec3{1, 0, 0}, Vec3{0, 0, 1}}) {
    const double coarse = patchError(grid(3), bent(grid(3), k)), fine = patchError(grid(6), bent(grid(6), k));
    EXPECT_LT(coarse, 1e-4);
    EXPECT_GT(coarse, 1e-8);  // otherwise the documentation is wrong
    EXPECT_GT(std::log2(coarse / fine), 3);
  }
}

// Four nodes: curvatures constant along x and y are exact on any quadrilaterals, as for Bathe and Dvorkin's
// element.
TEST(ShellPatch, BendingOfFourNodesOnQuadrilaterals) {
  const ShellGrid grid = quadrilaterals(Shear::mitc4);
  for (const Vec3& k : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}})
    EXPECT_LT(patchError(grid, bent(grid, k), Shear::mitc4), 1e-11);
}

// Three and six nodes: the same on any triangles, whichever corners come first.
TEST(ShellPatch, BendingOnTriangles) {
  for (Shear shear : {Shear::mitc3, Shear::mitc6}) {
    ShellGrid grid = quadrilaterals(shear);
    for (grid.turn = 0; grid.turn < 3; ++grid.turn)
      for (const Vec3& k : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}})
        EXPECT_LT(patchError(grid, bent(grid, k), shear), 1e-11);  // rounding times (1/t)^2
  }
}

ShellElements some(const ShellElements& all, const std::vector<int>& which) {
  ShellElements result;
  const int N = result.nodesPerElement = all.nodesPerElement;
  for (const int e : which) {
    result.nodes.insert(result.nodes.end(), &all.nodes[2 * N * e], &all.nodes[2 * N * e] + 2 * N);
    result.midsurface.insert(result.midsurface.end(), all.R(e), all.R(e) + 3 * N);
    result.directors.insert(result.directors.end(), all.D(e), all.D(e) + 3 * N);
  }
  return result;
}

// Squares of one SHELL4 and of two SHELL3 in turn: the same constant bending, and the same membrane.
TEST(ShellPatch, MixedThreeAndFourNodes) {
  ShellGrid grid = quadrilaterals(Shear::mitc4);
  const ShellElements four = some(grid.elements(), {0, 2, 4, 6, 8});
  grid.nodesPerElement = 3;
  const ShellElements three = some(grid.elements(), {2, 3, 6, 7, 10, 11, 14, 15});
  Matrix small{1e-3, 2e-4, 0, -4e-4, 5e-4, 0, 0, 0, 0};
  small[8] = -0.3 / 0.7 * (small[0] + small[4]);  // S_33 = 0
  for (const Numbers& exact : {bent(grid, {1, 0, 0}), bent(grid, {0, 0, 1}), homogeneous(grid, small)}) {
    fem::FeModel model = shellModel(grid, material, {}, Shear::mitc3);
    model.terms.clear();
    model.terms.push_back(
        fem::enhancedTerm(fem::pointLaw(Mitc4Law<SaintVenantKirchhoff>{material}), mitc4Points(four, 0.3)));
    model.terms.push_back(
        fem::enhancedTerm(fem::pointLaw(Mitc3Law<SaintVenantKirchhoff>{material}), mitc3Points(three, 0.3)));
    EXPECT_LT(patchError(std::move(model), grid, exact), 1e-11);
  }
}

// The forces of any state do not depend on which corners come first.
TEST(ShellPatch, TrianglesHaveNoFirstCorner) {
  for (Shear shear : {Shear::mitc3, Shear::mitc6}) {
    // Cylinders: edges of six nodes are curved.
    ShellGrid grid = shellGrid(3, 3, thickness, cylinder(1, 0, 1, 0, 1), undistorted, nodesOf(shear));
    const Numbers u = randomNumbers(6 * grid.numNodes(), 0.01, 5);
    const auto forces = [&](int turn) {
      grid.turn = turn;
      fem::FeProblem problem(shellModel(grid, material, {}, shear));
      return residual(problem, u, 0).r;
    };
    const Numbers first = forces(0);
    EXPECT_GT(largest(first), 1e-3);
    for (int turn : {1, 2}) EXPECT_LT(largest(sum(forces(turn), -1, first)) / largest(first), 1e-12);
  }
}

// Energy of constant bending = that of the plate, D ((kx + ky)^2 - 2 (1 - nu)(kx ky - kxy^2))/2 per area,
// D = E t^3/(12 (1 - nu^2)). Without the enhanced strain the thickness would lock: the factor (1 - nu)^2/(1 -
// 2 nu) = 1.225 at nu = 0.3.
TEST(ShellPatch, PlateStiffness) {
  const ShellGrid grid = parallelograms();
  const double area = 0.9 - 0.04, nu = 0.3, D = std::pow(thickness, 3) / (12 * (1 - nu * nu));
  for (const Vec3& k : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}, Vec3{0.3, -0.8, 0.5}}) {
    const double plate =
        D * area / 2 * (std::pow(k[0] + k[1], 2) - 2 * (1 - nu) * (k[0] * k[1] - k[2] * k[2]));
    EXPECT_NEAR(energy(grid, bent(grid, k)) / plate, 1, 1e-11);  // rounding of energies that cancel (1/t)^2
  }
}

// Rotations of any angle cost nothing, on curved and distorted elements.
TEST(ShellPatch, FiniteRotationCostsNoForce) {
  for (Shear shear : {Shear::compatible, Shear::assumed, Shear::mitc4, Shear::mitc3, Shear::mitc6}) {
    for (const ShellGrid& grid : {quadrilaterals(shear), shellGrid(2, 2, thickness, cylinder(1, 0, 1, 0, 1),
                                                                   undistorted, nodesOf(shear))}) {
      fem::FeProblem problem(shellModel(grid, material, {}, shear));
      for (double angle : {0.4, 2.0, M_PI}) {
        const Numbers u = homogeneous(grid, rotation(angle));
        EXPECT_GT(largest(u), 0.1);
        EXPECT_LT(largest(residual(problem, u, 0).r), 1e-15);  // rounding of strains times element area
      }
    }
  }
}

// A node's director may be another multiple of the element's own: w then is in its units. The same body, the
// same forces on v, and forces on w times the multiple.
TEST(ShellPatch, ScaledDirectors) {
  const ShellGrid grid = shellGrid(3, 2, thickness, cylinder(1, 0, 1, 0, 1));
  const ShellElements plain = grid.elements();
  ShellElements scaled = plain;
  Numbers scale = randomNumbers(grid.numNodes(), 0.5, 3);
  for (double& s : scale) s += 1;
  for (int e = 0; e < plain.count(); ++e)
    for (int a = 0; a < 8; ++a) scaled.directorScale.push_back(scale[plain.nodes[16 * e + a]]);
  const int nodes = 2 * grid.numNodes();
  const auto problemOf = [&](const ShellElements& elements) {
    fem::FeModel model;
    model.dofs = fem::DofMap::displacements(nodes);
    model.terms.push_back(
        fem::enhancedTerm(fem::pointLaw(ShellLaw<SaintVenantKirchhoff>{material}), shellPoints(elements)));
    model.terms.push_back(followerPressure(elements, {0, 2, 5}, topSurface, {0.01, 0}));
    FollowerEdgeLoad load;
    load.moment.constant = 0.01;
    model.terms.push_back(followerEdgeLoad(elements, {{2, 1}, {5, 1}}, load));
    model.load.assign(3 * nodes, 0.0);
    addShellAreaForce(elements, bottomSurface, {0.1, 0.2, 0.3}, model.load);
    return std::make_unique<fem::FeProblem>(std::move(model));
  };
  Numbers u = randomNumbers(3 * nodes, 0.01, 4), v = u;
  for (int n = 0; n < grid.numNodes(); ++n)
    for (int i = 0; i < 3; ++i) v[3 * grid.director(n) + i] /= scale[n];
  auto first = problemOf(plain), second = problemOf(scaled);
  const Numbers f = residual(*first, u, 0.7).r, g = residual(*second, v, 0.7).r;
  double worst = 0;
  for (int n = 0; n < grid.numNodes(); ++n)
    for (int i = 0; i < 3; ++i) {
      worst = std::max(worst, std::abs(f[3 * n + i] - g[3 * n + i]));
      worst = std::max(worst, std::abs(f[3 * grid.director(n) + i] * scale[n] - g[3 * grid.director(n) + i]));
    }
  EXPECT_GT(largest(f), 1e-3);
  EXPECT_LT(worst, 1e-15);  // rounding of forces of 1e-2
}
