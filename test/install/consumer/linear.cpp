// One system solved by the installed library's default solver: K = [2 -1; -1 2], b = [1 4], x = [2 3].
#include <Tpetra_Core.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_MultiVector.hpp>
#include <cmath>
#include <cstdio>

#include "atrapos/linear/MakeTangentSolver.hpp"

namespace linear = atrapos::linear;

static int solve() {
  const auto map = linear::rcp(new linear::Map(2, 0, Tpetra::getDefaultComm()));
  const auto matrix = linear::rcp(new linear::CrsMatrix(map, 2));
  for (linear::GlobalIndex row = 0; row < 2; ++row) {
    const linear::GlobalIndex columns[] = {row, 1 - row};
    const double values[] = {2, -1};
    matrix->insertGlobalValues(row, 2, values, columns);
  }
  matrix->fillComplete();
  linear::MultiVector b(map, 1), x(map, 1);
  b.replaceGlobalValue(0, 0, 1.0);
  b.replaceGlobalValue(1, 0, 4.0);
  const auto solver = linear::makeTangentSolver({});
  solver->analyze(matrix);
  solver->factor(matrix);
  solver->solve(b, x);
  const auto values = x.getData(0);
  // A 2 x 2 system of condition 3: some units in the last place.
  const double tolerance = 1e-14;
  if (std::abs(values[0] - 2) < tolerance && std::abs(values[1] - 3) < tolerance) return 0;
  std::printf("x = %.17g %.17g instead of 2 3\n", values[0], values[1]);
  return 1;
}

int main(int argc, char** argv) {
  const Tpetra::ScopeGuard guard(&argc, &argv);
  return solve();
}
