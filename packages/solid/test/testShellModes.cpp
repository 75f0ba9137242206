// Zero-energy modes of shell elements and small meshes, by the eigenvalues of their tangents.
#include <gtest/gtest.h>

#include <Teuchos_LAPACK.hpp>
#include <cmath>

#include "ShellModel.hpp"
#include "support/Meshes.hpp"

using namespace atrapos;
using namespace atrapos::solid;
using namespace atrapos::solid::test;
using namespace atrapos::fem::test;

namespace {

/// Eigenvalues of the tangent at zero displacement in units of the largest, ascending; the directors'
/// unknowns are w/(t/2), so that v and w have comparable sizes.
Numbers eigenvalues(const ShellGrid& grid, const ShellCubature& cubature, double nu,
                    Shear shear = Shear::compatible) {
  fem::FeModel model = shellModel(grid, SaintVenantKirchhoff::fromYoung(1.0, nu), cubature, shear);
  fem::FeProblem problem(std::move(model));
  const int n = 6 * grid.numNodes();
  const Tangent K = tangent(problem, Numbers(n, 0.0), 0);
  std::vector<double> A(static_cast<std::size_t>(n) * n, 0.0);
  const auto scale = [&](int d) { return d >= n / 2 ? grid.thickness / 2 : 1.0; };
  for (int i = 0; i < n; ++i)
    for (std::size_t e = K.start[i]; e < K.start[i + 1]; ++e)
      A[static_cast<std::size_t>(i) * n + K.column[e]] = K.value[e] * scale(i) * scale(K.column[e]);
  std::vector<double> values(n), work(8 * static_cast<std::size_t>(n));
  int info = 0;
  Teuchos::LAPACK<int, double>().SYEV('N', 'L', n, A.data(), n, values.data(), work.data(),
                                      static_cast<int>(work.size()), &info);
  EXPECT_EQ(info, 0);
  for (double& v : values) v /= values.back() > 0 ? values[n - 1] : 1.0;
  return values;
}

int zeros(const Numbers& eigenvalues) {
  int count = 0;
  for (double v : eigenvalues) {
    // Zero ones are rounding, 1e-16; the weakest true ones of these meshes are bending, about (t/L)^2 = 1e-4
    // to 1e-8: the gap decides, not where in it the bound lies.
    if (std::abs(v) < 1e-12) ++count;
    EXPECT_TRUE(std::abs(v) < 1e-12 || v > 1e-9) << v;
  }
  return count;
}

ShellGrid flatGrid(int nu, int nv, double thickness = 0.1, int nodes = 8) {
  return shellGrid(nu, nv, thickness, flat(nu, nv), undistorted, nodes);
}

ShellGrid skewQuadrilateral(int nodes = 8) {
  return shellGrid(
      1, 1, 0.1,
      [](double s, double t) {
        return SurfacePoint{{s + 0.3 * t + 0.2 * s * t, t - 0.1 * s * t, 0}, {0, 0, 1}};
      },
      undistorted, nodes);
}

ShellGrid arc(int n, int nodes = 8) {
  return shellGrid(n, n, 0.1, cylinder(1, 0, 0.6 * n, 0, 0.8 * n), undistorted, nodes);
}

constexpr int rigid = 6;
constexpr ShellCubature reduced{2, 2}, full{3, 2};

}  // namespace

// One element with reduced cubature: the rigid motions, the plane hourglass u = xi (1 - 3 eta^2),
// v = -eta (1 - 3 xi^2), and the same field in the director.
TEST(ShellModes, OneElementHasTwoHourglassModes) {
  for (double nu : {0.0, 0.3}) {
    EXPECT_EQ(zeros(eigenvalues(flatGrid(1, 1), reduced, nu)), rigid + 2);
    EXPECT_EQ(zeros(eigenvalues(skewQuadrilateral(), reduced, nu)), rigid + 2);
    EXPECT_EQ(zeros(eigenvalues(arc(1), reduced, nu)), rigid + 2);
    EXPECT_EQ(zeros(eigenvalues(flatGrid(1, 1), full, nu)), rigid);
    EXPECT_EQ(zeros(eigenvalues(skewQuadrilateral(), full, nu)), rigid);
  }
}

// Neighbours cannot share them: two elements have the six rigid motions and no others.
TEST(ShellModes, TwoElementsHaveRigidModesOnly) {
  for (double nu : {0.0, 0.3}) {
    EXPECT_EQ(zeros(eigenvalues(flatGrid(2, 1), reduced, nu)), rigid);
    EXPECT_EQ(zeros(eigenvalues(flatGrid(4, 1), reduced, nu)), rigid);
    EXPECT_EQ(zeros(eigenvalues(flatGrid(2, 2), reduced, nu)), rigid);
    EXPECT_EQ(zeros(eigenvalues(flatGrid(3, 3, 0.01), reduced, nu)), rigid);
    EXPECT_EQ(zeros(eigenvalues(shaken(flatGrid(2, 2), 0.2), reduced, nu)), rigid);
    EXPECT_EQ(zeros(eigenvalues(arc(2), reduced, nu)), rigid);
  }
}

// The assumed shear strains take no mode away: the same counts.
TEST(ShellModes, AssumedShear) {
  for (double nu : {0.0, 0.3}) {
    const auto count = [&](const ShellGrid& grid) {
      return zeros(eigenvalues(grid, reduced, nu, Shear::assumed));
    };
    EXPECT_EQ(count(flatGrid(1, 1)), rigid + 2);
    EXPECT_EQ(count(skewQuadrilateral()), rigid + 2);
    EXPECT_EQ(count(flatGrid(2, 1)), rigid);
    EXPECT_EQ(count(flatGrid(2, 2)), rigid);
    EXPECT_EQ(count(flatGrid(3, 3, 0.01)), rigid);
    EXPECT_EQ(count(shaken(flatGrid(2, 2), 0.2)), rigid);
    EXPECT_EQ(count(arc(2)), rigid);
  }
}

// Triangles of three and six nodes: no others either.
TEST(ShellModes, Triangles) {
  for (double nu : {0.0, 0.3})
    for (Shear shear : {Shear::mitc3, Shear::mitc6}) {
      const int nodes = nodesOf(shear);
      const auto count = [&](const ShellGrid& grid) { return zeros(eigenvalues(grid, reduced, nu, shear)); };
      EXPECT_EQ(count(flatGrid(1, 1, 0.1, nodes)), rigid);
      EXPECT_EQ(count(skewQuadrilateral(nodes)), rigid);
      EXPECT_EQ(count(arc(1, nodes)), rigid);
      EXPECT_EQ(count(flatGrid(3, 3, 0.01, nodes)), rigid);
      EXPECT_EQ(count(shaken(flatGrid(2, 2, 0.1, nodes), 0.2)), rigid);
    }
}

// Four nodes: one element alone has no others either.
TEST(ShellModes, FourNodes) {
  for (double nu : {0.0, 0.3}) {
    const auto count = [&](const ShellGrid& grid) {
      return zeros(eigenvalues(grid, reduced, nu, Shear::mitc4));
    };
    EXPECT_EQ(count(flatGrid(1, 1, 0.1, 4)), rigid);
    EXPECT_EQ(count(skewQuadrilateral(4)), rigid);
    EXPECT_EQ(count(arc(1, 4)), rigid);
    EXPECT_EQ(count(flatGrid(2, 1, 0.1, 4)), rigid);
    EXPECT_EQ(count(flatGrid(3, 3, 0.01, 4)), rigid);
    EXPECT_EQ(count(shaken(flatGrid(2, 2, 0.1, 4), 0.2)), rigid);
    EXPECT_EQ(count(arc(2, 4)), rigid);
  }
}
