#include "ShellModel.hpp"

#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Vector.hpp>

#include "atrapos/fem/EnhancedTerm.hpp"
#include "atrapos/linear/MakeTangentSolver.hpp"
#include "atrapos/solid/ShellTerms.hpp"

namespace atrapos::solid::test {

std::unique_ptr<fem::Term> shellTerm(const ShellElements& elements, const SaintVenantKirchhoff& material,
                                     const ShellCubature& cubature, Shear shear) {
  const double poisson = material.lambda / (2 * (material.lambda + material.mu));
  if (shear == Shear::mitc3)
    return fem::enhancedTerm(fem::pointLaw(Mitc3Law<SaintVenantKirchhoff>{material}),
                             mitc3Points(elements, poisson, cubature));
  if (shear == Shear::mitc6)
    return fem::enhancedTerm(
        sixNodeShellLaw(fem::pointLaw(ShellMaterialStage<SaintVenantKirchhoff>{material})),
        mitc6Points(elements, cubature));
  if (shear == Shear::mitc4)
    return fem::enhancedTerm(fem::pointLaw(Mitc4Law<SaintVenantKirchhoff>{material}),
                             mitc4Points(elements, poisson, cubature));
  if (shear == Shear::assumed)
    return fem::enhancedTerm(fem::pointLaw(AssumedShearLaw<SaintVenantKirchhoff>{material}),
                             assumedShearPoints(elements, cubature));
  return fem::enhancedTerm(fem::pointLaw(ShellLaw<SaintVenantKirchhoff>{material}),
                           shellPoints(elements, cubature));
}

Numbers linearSolution(fem::FeProblem& problem) {
  auto F = fem::test::zeroVector(problem), u = fem::test::zeroVector(problem);
  const auto K = problem.tangent({fem::test::zeroVector(problem), 0}, *F);
  linear::TangentSolverOptions options;
  options.symmetric = problem.symmetric();
  const auto solver = linear::makeTangentSolver(options);
  solver->analyze(K);
  solver->factor(K);
  solver->solve(*F, *u);
  return fem::FeProblem::values(*u);
}

Matrix rotation(double angle) {
  const double c = std::cos(angle), s = std::sin(angle), a[3] = {1 / 3., 2 / 3., 2 / 3.};
  Matrix Q{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) Q[3 * i + j] = (1 - c) * a[i] * a[j] + (i == j ? c - 1 : 0);
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    Q[3 * k + j] += s * a[i];
    Q[3 * j + k] -= s * a[i];
  }
  return Q;
}

Numbers homogeneous(const ShellGrid& grid, const Matrix& A) {
  Numbers u(6 * grid.numNodes(), 0.0);
  for (int n = 0; n < grid.numNodes(); ++n) {
    const Vec3 D = grid.D(n);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        u[3 * n + i] += A[3 * i + j] * grid.x[n][j];
        u[3 * grid.director(n) + i] += A[3 * i + j] * D[j];
      }
  }
  return u;
}

}  // namespace atrapos::solid::test
