// Limits of the Amesos2 adapters that are reported instead of met.
#include <gtest/gtest.h>

#include <Tpetra_CrsMatrix.hpp>
#include <algorithm>

#include "Amesos2Solver.hpp"
#include "Matrices.hpp"
#include "atrapos/linear/Error.hpp"

namespace atrapos::linear::test {
namespace {

bool has(const char* solver) {
  const auto names = Amesos2Solver::available();
  return std::find(names.begin(), names.end(), solver) != names.end();
}

TEST(Amesos2, KluIsThere) { EXPECT_TRUE(has("klu2")); }

TEST(Amesos2, NamesIgnoreCase) { EXPECT_EQ(Amesos2Solver(Amesos2Options{"KLU2"}).name(), "Amesos2 klu2"); }

TEST(Amesos2, NoInertia) {
  const auto K = makeMatrix(10, chain(10));
  Amesos2Solver solver;
  solver.analyze(K);
  solver.factor(K);
  EXPECT_FALSE(solver.inertia());
}

TEST(Amesos2, TachoIsForSymmetricDefinite) {
  if (!has("tacho")) GTEST_SKIP() << "not in this Trilinos";
  EXPECT_THROW(Amesos2Solver(Amesos2Options{"tacho", false}), SolverError);
  const auto indefinite = makeMatrix(100, chain(100, -1.3));
  Amesos2Solver solver(Amesos2Options{"tacho", true});
  EXPECT_THROW(
      {
        solver.analyze(indefinite);
        solver.factor(indefinite);
      },
      SolverError);
}

TEST(Amesos2, TachoIsRefusedWhereItWouldCrash) {
  if (!has("tacho")) GTEST_SKIP() << "not in this Trilinos";
  Amesos2Solver solver(Amesos2Options{"tacho", true});
  EXPECT_THROW(solver.analyze(makeMatrix(1024, chain(1024))), SolverError);
  const auto small = makeMatrix(1023, chain(1023));
  if (small->getComm()->getSize() > 1)
    EXPECT_THROW(solver.analyze(small), SolverError);
  else
    EXPECT_NO_THROW(solver.analyze(small));
}

TEST(Amesos2, ColumnWithoutEntriesThrows) {
  // The column map is then shorter than the row map, or rows depend on each other: an error in either case.
  const auto K = makeMatrix(12, [](int i) { return i == 4 ? Row{{5, 1.0}} : Row{{i, 1.0 + i}}; });
  Amesos2Solver solver(Amesos2Options{"klu2", false});
  EXPECT_THROW(
      {
        solver.analyze(K);
        solver.factor(K);
      },
      SolverError);
}

}  // namespace
}  // namespace atrapos::linear::test
