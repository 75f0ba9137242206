// Eigenvalues next to zero of unsymmetric matrices, against closed forms; the sign of the determinant.
#include <gtest/gtest.h>

#include <Tpetra_CrsMatrix.hpp>
#include <algorithm>
#include <cmath>

#include "Matrices.hpp"
#include "atrapos/linear/Determinant.hpp"
#include "atrapos/linear/Eigenvalues.hpp"
#include "atrapos/linear/MakeTangentSolver.hpp"
#include "atrapos/linear/TangentSolver.hpp"

namespace atrapos::linear::test {
namespace {

struct Nearest {
  NearestEigenvalues found;
  std::optional<int> sign;
  long long solves = 0;
};

Nearest nearest(const RCP<CrsMatrix>& K, int count) {
  TangentSolverOptions options;
  options.symmetric = false;
  const auto solver = makeTangentSolver(options);
  solver->analyze(K);
  solver->factor(K);
  const Inverse inverse = [&](const MultiVector& x, MultiVector& y) { solver->solve(x, y); };
  Nearest result;
  const long long before = solver->counters().solves;
  result.found = nearestEigenvalues(inverse, K->getRowMap(), count);
  result.solves = solver->counters().solves - before;
  result.sign = determinantSign(*solver);
  return result;
}

/// (-1 - c, 2 - shift, -1 + c) has the eigenvalues 2 - shift - 2 sqrt(1 - c^2) cos(k pi / (n + 1)), all real.
TEST(Eigenvalues, OfAChainWithConvection) {
  const double c = 0.01;
  // 40 is small enough for all of K^-1, 300 is not.
  for (const int n : {40, 300})
    for (const int negative : {0, 1, 3, 4}) {
      const auto value = [&](double k) {
        return 2 - 2 * std::sqrt(1 - c * c) * std::cos(k * M_PI / (n + 1));
      };
      const double shift = negative == 0 ? 0 : value(negative + 0.3);
      const auto K = makeMatrix(n, [&](int i) {
        Row row{{i, 2 - shift}};
        if (i > 0) row.emplace_back(i - 1, -1 - c);
        if (i + 1 < n) row.emplace_back(i + 1, -1 + c);
        return row;
      });
      const auto [found, sign, solves] = nearest(K, 6);
      EXPECT_EQ(found.complete, n == 40);
      ASSERT_GE(found.values.size(), 6u);
      std::vector<double> exact;
      for (int k = 1; k <= n; ++k) exact.push_back(value(k) - shift);
      std::sort(exact.begin(), exact.end(), [](double x, double y) { return std::abs(x) < std::abs(y); });
      for (int k = 0; k < 6; ++k) {
        // 1e-8 is asked for, times the condition of an eigenvalue, (1 + c)^n = 20 at most.
        EXPECT_NEAR(found.values[k].real(), exact[k], 2e-7 * std::abs(exact[k]));
        EXPECT_EQ(found.values[k].imag(), 0);
      }
      EXPECT_EQ(sign, negative % 2 == 0 ? 1 : -1);
      EXPECT_LE(solves, 60);
    }
}

/// Blocks [a b; -b a]: conjugate pairs; and a double real eigenvalue, which one direction alone would not
/// see.
TEST(Eigenvalues, ConjugatePairsAndADoubleOne) {
  const int n = 400;
  const auto K = makeMatrix(n, [&](int i) {
    const int k = i / 2;
    if (k == 0) return Row{{i, -0.5}};
    const double a = k == 1 ? -1 : k + 1.0, b = k + 0.25;
    return Row{{2 * k, i % 2 == 0 ? a : -b}, {2 * k + 1, i % 2 == 0 ? b : a}};
  });
  const auto [found, sign, solves] = nearest(K, 6);
  ASSERT_GE(found.values.size(), 6u);
  const double accuracy = 1e-7;  // 1e-8 is asked for; the matrix is normal
  for (int k = 0; k < 2; ++k) EXPECT_NEAR(std::abs(found.values[k] + 0.5), 0, accuracy);
  for (int k = 2; k < 4; ++k) {
    EXPECT_NEAR(found.values[k].real(), -1, accuracy);
    EXPECT_NEAR(std::abs(found.values[k].imag()), 1.25, accuracy);
  }
  EXPECT_NEAR(found.values[2].imag(), -found.values[3].imag(), accuracy);
  for (int k = 4; k < 6; ++k) EXPECT_NEAR(found.values[k].real(), 3, accuracy);
  EXPECT_EQ(sign, 1);  // pairs and the double one do not change it
  EXPECT_LE(solves, 120);
}

/// K x = mu M x with a pressure-like unknown for every three: [A, -B^T; B, 0] with A of 2 x 2 blocks and M of
/// ones there, so that the eigenvalues that are left are those of A on the kernel of B, and two infinite ones
/// come with each row of zeros in M.
TEST(Eigenvalues, InfiniteOnesAreLeftOut) {
  for (const int cells : {10, 100}) {
    // Of each cell: a pair of unknowns that turn, one that B holds at zero, and its multiplier.
    const auto pair = [](int c) { return std::complex<double>(c == 0 ? -0.5 : c, 1 + 0.5 * c); };
    const auto K = makeMatrix(4 * cells, [&](int i) {
      const int c = i / 4;
      const double a = pair(c).real(), b = pair(c).imag();
      if (i % 4 == 0) return Row{{i, a}, {i + 1, b}, {i + 2, 0.3}};
      if (i % 4 == 1) return Row{{i - 1, -b}, {i, a}, {i + 2, 0.0}};
      if (i % 4 == 2) return Row{{i - 2, 0.7}, {i, 2.0}, {i + 1, -3.0}};
      return Row{{i - 1, 3.0}, {i, 0.0}};
    });
    const auto M = makeMatrix(4 * cells, [&](int i) { return Row{{i, i % 4 == 3 ? 0.0 : 1.0}}; });
    TangentSolverOptions options;
    options.symmetric = false;
    const auto solver = makeTangentSolver(options);
    solver->analyze(K);
    solver->factor(K);
    const Inverse inverse = [&](const MultiVector& x, MultiVector& y) {
      MultiVector weighed(x.getMap(), x.getNumVectors());
      M->apply(x, weighed);
      solver->solve(weighed, y);
    };
    const auto found = nearestEigenvalues(inverse, K->getRowMap(), 6, Mass::singular);
    EXPECT_EQ(found.complete, cells == 10);
    ASSERT_GE(found.values.size(), 6u);
    if (found.complete) {
      EXPECT_EQ(found.values.size(), 2u * cells);
    }
    for (int k = 0; k < 6; ++k) {
      const auto expected = pair(k / 2);
      EXPECT_NEAR(found.values[k].real(), expected.real(), 1e-7);  // 1e-8 is asked for
      EXPECT_NEAR(std::abs(found.values[k].imag()), expected.imag(), 1e-7);
    }
  }
}

/// LAPACK takes no NaN for a Schur form, and Anasazi throws.
TEST(Eigenvalues, NoneOfWhatAreNoNumbers) {
  const auto K = makeMatrix(300, [](int i) { return Row{{i, 1.0 + i}}; });
  int calls = 0;
  const Inverse inverse = [&](const MultiVector& x, MultiVector& y) {
    y.update(++calls < 5 ? 1 : std::nan(""), x, 0);
  };
  EXPECT_TRUE(nearestEigenvalues(inverse, K->getRowMap(), 4).values.empty());
  EXPECT_GE(calls, 5);
}

/// The sign does not depend on how rows are numbered and scaled, nor on who has them.
TEST(Eigenvalues, SignOfTheDeterminant) {
  for (const auto layout : {Layout::contiguous, Layout::scattered})
    for (const int negative : {0, 1, 2, 57}) {
      const int n = 100;
      const auto K = makeMatrix(
          n,
          [&](int i) {
            Row row{{i, (i < negative ? -1 : 1) * std::pow(10.0, i % 7 - 3)}};
            // Upper triangular; small, so that K stays far from singular (columns grow by 0.5 / |diagonal|).
            if (i + 1 < n) row.emplace_back(i + 1, 0.5);
            return row;
          },
          layout);
      TangentSolverOptions options;
      options.symmetric = false;
      const auto solver = makeTangentSolver(options);
      EXPECT_FALSE(determinantSign(*solver));
      solver->analyze(K);
      solver->factor(K);
      EXPECT_EQ(determinantSign(*solver), negative % 2 == 0 ? 1 : -1) << negative;
    }
}

}  // namespace
}  // namespace atrapos::linear::test
