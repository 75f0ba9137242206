// What only MUMPS tells: inertia and null pivots; and its own machinery.
#include <gtest/gtest.h>

#include <Tpetra_CrsMatrix.hpp>
#include <algorithm>
#include <cmath>

#include "Matrices.hpp"
#include "MumpsSolver.hpp"
#include "atrapos/linear/Error.hpp"

namespace atrapos::linear::test {
namespace {

Inertia inertiaOf(const RCP<CrsMatrix>& K) {
  MumpsSolver solver;
  solver.analyze(K);
  solver.factor(K);
  EXPECT_TRUE(solver.inertia());
  return solver.inertia().value_or(Inertia{-1, -1});
}

/// The analysis foresees what the factorization takes: no pivoting is needed here.
TEST(Mumps, ForeseesTheFactor) {
  const std::array<int, 3> points{24, 24, 24};
  const auto K = makeMatrix(24 * 24 * 24, laplacian3d(points, 0));
  for (const bool symmetric : {true, false}) {
    MumpsOptions options;
    options.symmetric = symmetric;
    MumpsSolver solver(options);
    EXPECT_FALSE(solver.estimate());
    solver.analyze(K);
    ASSERT_TRUE(solver.estimate());
    EXPECT_FALSE(solver.spent());
    solver.factor(K);
    ASSERT_TRUE(solver.spent());
    const FactorCost foreseen = *solver.estimate(), spent = *solver.spent();
    EXPECT_NEAR(spent.entries, foreseen.entries, 0.01 * foreseen.entries);
    EXPECT_NEAR(spent.operations, foreseen.operations, 0.05 * foreseen.operations);
    // At most the relaxation of the work space by 30 %, its default, and the rounding to whole MB.
    EXPECT_LE(spent.bytes, foreseen.bytes + 1e6);
    EXPECT_GE(spent.bytes, 0.6 * foreseen.bytes);
    // At least the factors themselves.
    EXPECT_GE(spent.bytes, 8 * spent.entries);
  }
}

TEST(Mumps, InertiaOfChains) {
  const int n = 211;
  for (double diag : {1.0, -0.5, -2.0, -3.3, -4.5}) {
    long long negative = 0;
    for (int i = 1; i <= n; ++i) {
      const double eigenvalue = 2 + diag - 2 * std::cos(i * std::acos(-1.0) / (n + 1));
      // Where an eigenvalue is rounding, its sign is nobody's: -2 has one (i = 106).
      if (std::abs(eigenvalue) > 1e-9) negative += eigenvalue < 0;
    }
    const auto K = makeMatrix(n, chain(n, diag));
    if (diag == -2.0) {
      // Exactly singular: 2x2 pivots [0 -1; -1 0] only, and one null pivot left over.
      MumpsSolver solver;
      solver.analyze(K);
      EXPECT_THROW(solver.factor(K), SingularTangentError);
      ASSERT_TRUE(solver.inertia());
      EXPECT_EQ(solver.inertia()->negative, negative);
      EXPECT_EQ(solver.inertia()->null, 1);
    } else {
      EXPECT_EQ(inertiaOf(K).negative, negative) << diag;
      EXPECT_EQ(inertiaOf(K).null, 0) << diag;
    }
  }
}

TEST(Mumps, InertiaOfSaddlePointCountsConstraints) {
  for (auto layout : {Layout::contiguous, Layout::scattered})
    EXPECT_EQ(inertiaOf(makeMatrix(1300, saddlePoint(1000, 300), layout)).negative, 300);
}

TEST(Mumps, InertiaOfShiftedLaplacian) {
  const std::array<int, 3> points{29, 23, 19};
  const int n = points[0] * points[1] * points[2];
  // In the middle of the widest of some gaps between eigenvalues near 1.1.
  auto values = laplacian3dEigenvalues(points, 0);
  std::sort(values.begin(), values.end());
  const auto from = std::lower_bound(values.begin(), values.end(), 1.1);
  auto below = from;
  for (auto at = from; at < from + 20; ++at)
    if (at[1] - at[0] > below[1] - below[0]) below = at;
  const double shift = (below[0] + below[1]) / 2;
  const long long negative = below - values.begin() + 1;
  ASSERT_GT(below[1] - below[0], 1e-5);  // far above rounding: eps x 12 x n^(1/2) is 3e-13
  ASSERT_GT(negative, 100);

  const auto K = makeMatrix(n, laplacian3d(points, shift));
  MumpsSolver solver;
  solver.analyze(K);
  solver.factor(K);
  ASSERT_TRUE(solver.inertia());
  EXPECT_EQ(solver.inertia()->negative, negative);
  const auto b = makeReference(K->getRowMap(), 3);
  MultiVector x(K->getRowMap(), 3);
  solver.solve(*b, x);
  // 2e-13 seen: with MUMPS' pivot threshold 0.01 elements may grow 100 times in one step.
  EXPECT_LT(backwardError(*K, x, *b), 100 * roundingBound);
}

TEST(Mumps, NullPivotsAreCounted) {
  // Two separate rings: two rigid motions.
  const int half = 70;
  const auto K = makeMatrix(2 * half, [](int i) {
    auto row = ring(half)(i % half);
    for (auto& entry : row) entry.first += i < half ? 0 : half;
    return row;
  });
  for (bool symmetric : {true, false}) {
    MumpsOptions options;
    options.symmetric = symmetric;
    MumpsSolver solver(options);
    solver.analyze(K);
    try {
      solver.factor(K);
      FAIL();
    } catch (const SingularTangentError& e) {
      EXPECT_EQ(e.nullPivots(), 2) << e.what();
    }
    EXPECT_EQ(solver.inertia().has_value(), symmetric);
  }
}

TEST(Mumps, EmptyRowAndColumnIsANullPivot) {
  const auto K = makeMatrix(40, [](int i) { return i == 11 ? Row{} : Row{{i, 1.0 + i}}; });
  MumpsSolver solver;
  solver.analyze(K);
  EXPECT_THROW(solver.factor(K), SingularTangentError);
}

TEST(Mumps, InstancesAreIndependent) {
  const auto K1 = makeMatrix(300, chain(300, -1.3)), K2 = makeMatrix(260, saddlePoint(200, 60));
  const auto b1 = makeReference(K1->getRowMap()), b2 = makeReference(K2->getRowMap());
  Vector x1(K1->getRowMap()), x2(K2->getRowMap());
  MumpsSolver first;
  first.analyze(K1);
  {
    MumpsSolver second(MumpsOptions{false});
    second.analyze(K2);
    first.factor(K1);
    second.factor(K2);
    first.solve(*b1, x1);
    second.solve(*b2, x2);
    EXPECT_LT(backwardError(*K2, x2, *b2), roundingBound);
    EXPECT_FALSE(second.inertia());
  }
  EXPECT_LT(backwardError(*K1, x1, *b1), roundingBound);
  first.solve(*b1, x1);
  EXPECT_LT(backwardError(*K1, x1, *b1), roundingBound);
  EXPECT_EQ(first.inertia()->null, 0);
}

TEST(Mumps, NameSaysWhatWasDone) {
  const auto K = makeMatrix(500, chain(500));
  MumpsSolver symmetric, general(MumpsOptions{false});
  symmetric.analyze(K);
  general.analyze(K);
  EXPECT_EQ(symmetric.name(), "MUMPS SYM=2, METIS");
  EXPECT_EQ(general.name(), "MUMPS SYM=0, METIS");
}

TEST(Mumps, WorkspaceIsEnlargedWhenTooSmall) {
  // The diagonal is zero, so that pivots are delayed far beyond the estimate.
  const int n = 3000;
  const auto K = makeMatrix(n, [](int i) {
    Row row{{(i + n / 2) % n, 1.0}};
    for (int k : {1, 7, 83, 391}) {
      row.emplace_back((i + k) % n, 0.5);
      row.emplace_back((i + n - k) % n, 0.5);
    }
    return row;
  });
  MumpsOptions options;
  options.workspacePercent = 1;
  MumpsSolver solver(options);
  solver.analyze(K);
  solver.factor(K);
  EXPECT_GT(solver.memoryRetries(), 0);
  EXPECT_EQ(solver.counters().factorizations, 1);
  const auto b = makeReference(K->getRowMap());
  Vector x(K->getRowMap());
  solver.solve(*b, x);
  // Thousands of delayed pivots, each with growth up to 100: 8e-12 seen. The work space is the point here.
  EXPECT_LT(backwardError(*K, x, *b), 1e-9);
  // What was enlarged stays so.
  const int retries = solver.memoryRetries();
  solver.factor(K);
  EXPECT_EQ(solver.memoryRetries(), retries);
}

}  // namespace
}  // namespace atrapos::linear::test
