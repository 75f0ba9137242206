// Patch tests at finite deformation: on distorted meshes of every cell a homogeneous state is a solution to
// rounding, and finite rotations of the body cost no force.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "SolidModel.hpp"
#include "atrapos/fem/Loads.hpp"

using namespace atrapos;
using namespace atrapos::solid;
using namespace atrapos::solid::test;
using namespace atrapos::fem::test;

namespace {

using Matrix = std::array<double, 9>;

const auto material = SaintVenantKirchhoff::fromYoung(1.0, 0.3);

/// u = A x.
Numbers homogeneous(const fem::Mesh& mesh, const Matrix& A) {
  Numbers u(mesh.coordinates.size(), 0.0);
  for (int n = 0; n < mesh.numNodes(); ++n)
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) u[3 * n + i] += A[3 * i + j] * mesh.coordinates[3 * n + j];
  return u;
}

/// Stretch, shear and a rotation of 30 degrees about z: F = R (I + E).
Matrix finiteDeformation() {
  const double c = std::cos(M_PI / 6), s = std::sin(M_PI / 6);
  const Matrix R{c, -s, 0, s, c, 0, 0, 0, 1}, U{1.2, 0.1, 0, 0.05, 0.9, 0.08, -0.04, 0, 1.1};
  Matrix A{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      for (int k = 0; k < 3; ++k) A[3 * i + j] += R[3 * i + k] * U[3 * k + j];
      A[3 * i + j] -= i == j;
    }
  return A;
}

Matrix rotationBy(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c - 1, 0, s, 0, 0, 0, -s, 0, c - 1};
}

/// Moves the nodes between corners to where straight edges and the linear cell's map have them.
fem::Mesh straightened(fem::Mesh mesh) {
  fem::Block& block = mesh.blocks[0];
  using fem::Topology;
  const Topology cell = block.topology;
  const bool hex = cell == Topology::Hex20 || cell == Topology::Hex27;
  const Topology corners = hex ? Topology::Hex8 : cell == Topology::Tet10 ? Topology::Tet4 : Topology::Wedge6;
  const auto map = fem::tabulateAt(corners, fem::referenceNodes(cell));
  const int N = fem::nodesPerElement(cell), C = map.numNodes;
  for (std::size_t e = 0; e < block.nodes.size() / N; ++e)
    for (int n = C; n < N; ++n)
      for (int i = 0; i < 3; ++i) {
        double x = 0;
        for (int c = 0; c < C; ++c)
          x += map.values[n * C + c] * mesh.coordinates[3 * block.nodes[e * N + c] + i];
        mesh.coordinates[3 * block.nodes[e * N + n] + i] = x;
      }
  return mesh;
}

class Patch : public testing::TestWithParam<fem::Topology> {
 protected:
  fem::Mesh curved = distorted(box(GetParam()), 0.03);
  fem::Mesh mesh = isQuadratic(GetParam()) ? straightened(curved) : curved;
};

/// Cauchy stress at all points is that of H = A.
void expectHomogeneous(const fem::FeProblem& problem, const Numbers& u, const Matrix& A, double tolerance) {
  double expected[6];
  material.observe(A.data(), nullptr, expected);
  const auto seen = problem.term(0).observe(fem::field(*vectorOf(problem, u)), 0);
  ASSERT_GT(seen.values.size(), 0u);
  double worst = 0, size = 0;
  for (double sigma : expected) size = std::max(size, std::abs(sigma));
  for (std::size_t p = 0; p < seen.values.size() / 6; ++p)
    for (int m = 0; m < 6; ++m) worst = std::max(worst, std::abs(seen.values[6 * p + m] - expected[m]));
  EXPECT_LT(worst, tolerance);
  EXPECT_GT(size, 0.01) << "a state without stress tests nothing";
}

/// All boundary nodes driven to lambda A x, the inner ones solved for, from the undeformed state to A in five
/// loads.
void prescribedPatch(const fem::Mesh& mesh, const fem::Tabulation& cell) {
  const Matrix A = finiteDeformation();
  const Numbers exact = homogeneous(mesh, A);
  fem::FeModel model = solidModel(mesh, material, &cell);
  std::vector<char> outside(mesh.numNodes(), 0);
  for (int n : boundaryNodes(mesh)) {
    if (outside[n]++) continue;
    for (int i = 0; i < 3; ++i) model.prescribe(n, i, 0.0, exact[3 * n + i]);
  }
  fem::FeProblem problem(std::move(model));
  ASSERT_GT(problem.numFreeDofs(), 0);
  Numbers u(exact.size(), 0.0);
  for (int i = 1; i <= 5; ++i) u = equilibrium(problem, 0.2 * i, u).u;
  // Displacements of size one: rounding times the condition of a small mesh.
  EXPECT_LT(largest(sum(u, -1, exact)), 1e-13);
  expectHomogeneous(problem, u, A, 1e-12);  // gradients: the same divided by a third of a cell of width 1/3
}

}  // namespace

// Straight edges: the default cubature, reduced for HEX20 and WEDGE15, integrates the forces of a constant
// stress exactly.
TEST_P(Patch, PrescribedLinearDisplacement) { prescribedPatch(mesh, fem::tabulate(GetParam())); }

// Curved edges need more points: degree 6 is enough for every cell, the default is not for HEX20, TET10 and
// WEDGE15 (docs/theory/solid.md).
TEST_P(Patch, PrescribedLinearDisplacementOnCurvedCells) {
  prescribedPatch(curved, fem::tabulate(GetParam(), 6));
}

// Held without stress, pulled by the tractions P N of a homogeneous state on all faces: uniaxial stretch
// along y by s, s_t across.
TEST_P(Patch, Tractions) {
  fem::Mesh cube = curved;  // plane faces: move inner nodes only
  const fem::Mesh regular = box(GetParam());
  for (int n : boundaryNodes(regular))
    for (int i = 0; i < 3; ++i) cube.coordinates[3 * n + i] = regular.coordinates[3 * n + i];
  if (isQuadratic(GetParam())) cube = straightened(cube);
  const double s = 1.2, across = std::sqrt(1 - 0.3 * (s * s - 1));
  const Matrix A{across - 1, 0, 0, 0, s - 1, 0, 0, 0, across - 1};
  fem::FeModel model = solidModel(cube, material);
  const char* planes[3] = {"x_min", "y_min", "z_min"};
  for (int i = 0; i < 3; ++i)
    for (int n : nodesOfSet(cube, planes[i])) model.prescribe(n, i, 0.0, 0.0);
  fem::addTraction(cube, sideSet(cube, "y_max"), {0, s * (s * s - 1) / 2, 0}, model.load);
  fem::FeProblem problem(std::move(model));
  const Numbers exact = homogeneous(cube, A);
  Numbers u(exact.size(), 0.0);
  for (int i = 1; i <= 4; ++i) u = equilibrium(problem, 0.25 * i, u).u;
  EXPECT_LT(largest(sum(u, -1, exact)), 1e-13);
  expectHomogeneous(problem, u, A, 1e-12);
}

// Any angle, here about y: internal forces vanish to rounding of stresses that cancel, 1e-16 times E times
// face area.
TEST_P(Patch, FiniteRotationCostsNoForce) {
  fem::FeProblem problem(solidModel(mesh, material));
  for (double angle : {0.3, M_PI / 2, M_PI}) {
    const Numbers u = homogeneous(mesh, rotationBy(angle));
    EXPECT_LT(largest(residual(problem, u, 0.0).r), 1e-15);
    EXPECT_GT(largest(u), 0.2);
  }
  // The linearised rotation of the same angle does cost.
  EXPECT_GT(largest(residual(problem, homogeneous(mesh, {0, 0, 0.3, 0, 0, 0, -0.3, 0, 0}), 0.0).r), 1e-3);
}

// A body turned as a whole has the same forces, turned: K of the turned state turns too, so inertia is the
// same.
TEST_P(Patch, ForcesTurnWithTheBody) {
  fem::FeProblem problem(solidModel(mesh, material));
  const Numbers u = randomNumbers(mesh.coordinates.size(), 0.03, 9);
  const double c = std::cos(0.8), s = std::sin(0.8);
  Numbers turned(u.size());
  for (int n = 0; n < mesh.numNodes(); ++n) {
    const double* X = &mesh.coordinates[3 * n];
    const double x[3] = {X[0] + u[3 * n], X[1] + u[3 * n + 1], X[2] + u[3 * n + 2]};
    turned[3 * n] = c * x[0] + s * x[2] - X[0];
    turned[3 * n + 1] = x[1] - X[1];
    turned[3 * n + 2] = -s * x[0] + c * x[2] - X[2];
  }
  const Numbers f = residual(problem, u, 0.0).r, g = residual(problem, turned, 0.0).r;
  double worst = 0;
  for (int n = 0; n < mesh.numNodes(); ++n) {
    worst = std::max(worst, std::abs(g[3 * n] - (c * f[3 * n] + s * f[3 * n + 2])));
    worst = std::max(worst, std::abs(g[3 * n + 1] - f[3 * n + 1]));
    worst = std::max(worst, std::abs(g[3 * n + 2] - (-s * f[3 * n] + c * f[3 * n + 2])));
  }
  EXPECT_LT(worst, 1e-14);
  EXPECT_GT(largest(f), 1e-3);
}

INSTANTIATE_TEST_SUITE_P(All, Patch, testing::ValuesIn(allCells()),
                         [](const auto& info) { return std::string(fem::topologyName(info.param)); });
