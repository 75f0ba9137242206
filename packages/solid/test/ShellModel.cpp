#include "ShellModel.hpp"

#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Vector.hpp>

#include "atrapos/fem/ReferenceCell.hpp"
#include "atrapos/linear/MakeTangentSolver.hpp"

namespace atrapos::solid::test {

Numbers linearSolution(fem::FeProblem& problem) {
  auto F = fem::test::zeroVector(problem), u = fem::test::zeroVector(problem);
  const auto K = problem.tangent(*fem::test::zeroVector(problem), 0, *F);
  linear::TangentSolverOptions options;
  options.symmetric = problem.symmetric();
  const auto solver = linear::makeTangentSolver(options);
  solver->analyze(K);
  solver->factor(K);
  solver->solve(*F, *u);
  return fem::FeProblem::values(*u);
}

void addAreaLoad(const ShellGrid& grid, const Vec3& perArea, std::vector<double>& force) {
  const ShellElements elements = grid.elements();
  const fem::Tabulation t = fem::tabulateFace(fem::Face::Quad8, 5);
  for (int e = 0; e < elements.count(); ++e)
    for (int q = 0; q < t.numPoints; ++q) {
      double g[2][3] = {};
      for (int a = 0; a < 8; ++a)
        for (int d = 0; d < 2; ++d)
          for (int i = 0; i < 3; ++i)
            g[d][i] += t.gradients[(q * 8 + a) * 2 + d] * elements.midsurface[24 * e + 3 * a + i];
      double area = 0;
      for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        const double c = g[0][j] * g[1][k] - g[0][k] * g[1][j];
        area += c * c;
      }
      area = std::sqrt(area) * t.weights[q];
      for (int a = 0; a < 8; ++a)
        for (int i = 0; i < 3; ++i)
          force[3 * elements.nodes[16 * e + a] + i] += area * t.values[q * 8 + a] * perArea[i];
    }
}

}  // namespace atrapos::solid::test
