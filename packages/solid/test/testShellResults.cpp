// Stresses at the surfaces, stress resultants and thickness against closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "ShellModel.hpp"
#include "atrapos/solid/ShellResults.hpp"

using namespace atrapos;
using namespace atrapos::solid;
using namespace atrapos::solid::test;
using namespace atrapos::fem::test;

namespace {

constexpr double thickness = 0.02, E = 100, nu = 0.3;

/// A strip along x with its left end clamped, linear in small loads.
struct Strip {
  ShellGrid grid = shellGrid(8, 2, thickness, flat(1, 0.3));
  fem::FeModel model = shellModel(grid, SaintVenantKirchhoff::fromYoung(E, 0));

  Strip() { clamp(model, grid, grid.lineI(0)); }

  ShellResultants resultants(const std::array<double, 3>& axis = {1, 0, 0}) {
    fem::FeProblem problem(std::move(model));
    const Numbers u = linearSolution(problem);
    const auto stress = problem.term(0).observe(fem::field(*vectorOf(problem, u)), 0);
    return shellResultants(grid.elements(), stress, u, {{}, axis});
  }
};

}  // namespace

// End shear q per length: q_1 = q, m_11 = -q (1 - x). So small that E t times the square of the rotation,
// which a linear solution leaves in n_11, stays below 1e-3 q.
TEST(ShellResults, CantileverEndShear) {
  Strip strip;
  const double q = 1e-13;
  addShellEdgeForce(strip.grid.elements(), strip.grid.side(1), {0, 0, q}, strip.model.load);
  const ShellResultants r = strip.resultants();
  ASSERT_EQ(r.values.size(), 16u * 4 * 8);
  for (std::size_t p = 0; p < r.values.size() / 8; ++p) {
    const double* v = &r.values[8 * p];
    EXPECT_NEAR(v[6], q, 1e-3 * q);
    EXPECT_NEAR(v[3], -q * (1 - r.positions[3 * p]), 1e-3 * q);
    for (int m : {0, 1, 2, 4, 5, 7}) EXPECT_NEAR(v[m], 0, 1e-3 * q) << m;
  }
}

TEST(ShellResults, StretchInOtherAxes) {
  Strip strip;
  addShellEdgeForce(strip.grid.elements(), strip.grid.side(1), {1e-8, 0, 0}, strip.model.load);
  // Axis 1 at 30 degrees from the load: n_11 = n cos^2, n_22 = n sin^2, n_12 = -n sin cos.
  const double c = std::cos(M_PI / 6), s = 0.5;
  const ShellResultants r = strip.resultants({c, s, 0});
  for (std::size_t p = 0; p < r.values.size() / 8; ++p) {
    EXPECT_NEAR(r.values[8 * p], 1e-8 * c * c, 1e-13);  // strains of 1e-8: nonlinear terms and rounding
    EXPECT_NEAR(r.values[8 * p + 1], 1e-8 * s * s, 1e-13);
    EXPECT_NEAR(r.values[8 * p + 2], -1e-8 * s * c, 1e-13);
  }
}

// Constant curvature k along x, none along y: m_11 = D k, m_22 = nu D k, surface stress 6 m/t^2, none inside;
// the normal stress is zero at every point although nu is not, by the enhanced strain.
TEST(ShellResults, CylindricalBending) {
  const ShellGrid grid = shellGrid(3, 2, thickness, flat(1, 1));
  fem::FeProblem problem(shellModel(grid, SaintVenantKirchhoff::fromYoung(E, nu)));
  const double k = 1e-7, D = E * std::pow(thickness, 3) / (12 * (1 - nu * nu));
  Numbers u(6 * grid.numNodes(), 0.0);
  for (int n = 0; n < grid.numNodes(); ++n) {
    u[3 * n + 2] = -k * grid.x[n][0] * grid.x[n][0] / 2;
    u[3 * grid.director(n)] = thickness / 2 * k * grid.x[n][0];
  }
  const auto stress = problem.term(0).observe(fem::field(*vectorOf(problem, u)), 0);
  const ShellResultants r = shellResultants(grid.elements(), stress, u);
  const auto top = surfaceStress(stress, {}, 1), middle = surfaceStress(stress, {}, 0),
             bottom = surfaceStress(stress, {}, -1);
  const double surface = 6 * D * k / (thickness * thickness);
  for (std::size_t p = 0; p < r.values.size() / 8; ++p) {
    // Relative 1e-5: rotations of 1e-7 against strains of k t = 2e-9 make second-order terms of 5e-6.
    EXPECT_NEAR(r.values[8 * p + 3], D * k, 1e-5 * D * k);
    EXPECT_NEAR(r.values[8 * p + 4], nu * D * k, 1e-5 * D * k);
    EXPECT_NEAR(top[6 * p], surface, 1e-5 * surface);
    EXPECT_NEAR(bottom[6 * p + 1], -nu * surface, 1e-5 * surface);
    EXPECT_NEAR(middle[6 * p], 0, 1e-5 * surface);
    EXPECT_NEAR(top[6 * p + 2], 0, 1e-5 * surface);
  }
}

// A strip laid on a circle of curvature k, sections straight: the stretch 1 + z k gives
//     S = E (z k + z^2 k^2/2),   on the section P = (1 + z k) S,
//     n_11 = int P dz = E k^2 t^3/8,   m_11 = int z P dz = E k t^3/12   up to (k t)^2.
TEST(ShellResults, StripOnACircle) {
  const ShellGrid grid = shellGrid(8, 2, thickness, flat(1, 0.3));
  fem::FeProblem problem(shellModel(grid, SaintVenantKirchhoff::fromYoung(E, 0)));
  const double k = 0.2, cube = E * std::pow(thickness, 3);
  Numbers u(6 * grid.numNodes(), 0.0);
  for (int n = 0; n < grid.numNodes(); ++n) {
    const double x = grid.x[n][0];
    u[3 * n] = std::sin(k * x) / k - x;
    u[3 * n + 2] = (std::cos(k * x) - 1) / k;
    u[3 * grid.director(n)] = thickness / 2 * std::sin(k * x);
    u[3 * grid.director(n) + 2] = thickness / 2 * (std::cos(k * x) - 1);
  }
  const auto stress = problem.term(0).observe(fem::field(*vectorOf(problem, u)), 0);
  const ShellResultants r = shellResultants(grid.elements(), stress, u);
  for (std::size_t p = 0; p < r.values.size() / 8; ++p) {
    // Parabolas for arcs of 0.025: strains off by 1e-9, against 2e-6 of n_11.
    EXPECT_NEAR(r.values[8 * p], k * k * cube / 8, 0.01 * k * k * cube / 8);
    EXPECT_NEAR(r.values[8 * p + 3], k * cube / 12, 1e-4 * k * cube / 12);
    EXPECT_NEAR(r.values[8 * p + 6], 0, 2e-7);  // their tangents by 1e-7, times G t = 1
  }
}

TEST(ShellResults, ThicknessChange) {
  const ShellGrid grid = shellGrid(2, 1, thickness, cylinder(1, 0, 1, 0, 1));
  Numbers u(6 * grid.numNodes(), 0.0);
  for (int n = 0; n < grid.numNodes(); ++n)
    for (int i = 0; i < 3; ++i) u[3 * grid.director(n) + i] = -0.1 * grid.D(n)[i];
  const auto change = thicknessChange(grid.elements(), u);
  ASSERT_EQ(change.size(), 16u);
  for (double c : change) EXPECT_NEAR(c, -0.1 * thickness, 1e-16);
}

// What is bilinear in xi, eta at the 2 x 2 points comes back at the nodes.
TEST(ShellResults, PointsToNodes) {
  const auto f = [](double xi, double eta) { return 2 + 3 * xi - eta + 0.5 * xi * eta; };
  const double g = 1 / std::sqrt(3.0);
  const std::vector<double> points{f(-g, -g), f(g, -g), f(-g, g), f(g, g)};
  const double nodes[8] = {f(-1, -1), f(1, -1), f(1, 1), f(-1, 1), f(0, -1), f(1, 0), f(0, 1), f(-1, 0)};
  const auto toNodes = shellPointsToNodes({});
  ASSERT_EQ(toNodes.size(), 32u);
  for (int a = 0; a < 8; ++a) {
    double value = 0;
    for (int q = 0; q < 4; ++q) value += toNodes[4 * a + q] * points[q];
    EXPECT_NEAR(value, nodes[a], 1e-14);  // rounding
  }
}
