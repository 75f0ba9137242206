// Iterative solves: what residual they reach, when they give up, what their memory is, and the choice by
// memory.
#include <gtest/gtest.h>

#include <Tpetra_CrsMatrix.hpp>

#include "KrylovSolver.hpp"
#include "Matrices.hpp"
#include "MumpsSolver.hpp"
#include "SingleFactor.hpp"
#include "atrapos/linear/Choice.hpp"
#include "atrapos/linear/Error.hpp"
#include "atrapos/linear/MakeTangentSolver.hpp"

namespace atrapos::linear::test {
namespace {

using Preconditioner = KrylovOptions::Preconditioner;

constexpr std::array<int, 3> kBox{12, 11, 10};
constexpr int kPoints = 12 * 11 * 10;

KrylovOptions with(Preconditioner preconditioner) {
  KrylovOptions options;
  options.preconditioner = preconditioner;
  return options;
}

/// |b - K x| / |b|.
double residual(const CrsMatrix& K, const Vector& x, const Vector& b, bool transposed = false) {
  Vector r(b, Teuchos::Copy);
  K.apply(x, r, transposed ? Teuchos::TRANS : Teuchos::NO_TRANS, -1, 1);
  return r.norm2() / b.norm2();
}

struct Solved {
  std::unique_ptr<KrylovSolver> solver;
  RCP<Vector> b, x;
};

Solved solve(const KrylovOptions& options, bool symmetric, const RCP<CrsMatrix>& K) {
  Solved s{std::make_unique<KrylovSolver>(options, symmetric),
           makeReference(K->getRowMap())->getVectorNonConst(0), rcp(new Vector(K->getRowMap()))};
  s.solver->analyze(K);
  s.solver->factor(K);
  s.solver->solve(*s.b, *s.x);
  return s;
}

TEST(Krylov, ResidualIsBelowTheTolerance) {
  for (const auto preconditioner : {Preconditioner::singleFactor, Preconditioner::ilu})
    for (const double tolerance : {1e-4, 1e-9}) {
      KrylovOptions options = with(preconditioner);
      options.tolerance = tolerance;
      const auto K = makeMatrix(kPoints, laplacian3d(kBox, 0), Layout::scattered);
      const auto s = solve(options, true, K);
      EXPECT_LE(residual(*K, *s.x, *s.b), tolerance);
      EXPECT_FALSE(s.solver->inertia());
      const auto U = makeMatrix(203, convection(203, 0.4));
      const auto u = solve(options, false, U);
      EXPECT_LE(residual(*U, *u.x, *u.b), tolerance);
    }
}

TEST(Krylov, SingleFactorTakesIndefiniteUnsymmetricAndSaddlePointMatrices) {
  const auto options = with(Preconditioner::singleFactor);
  for (const auto& K : {makeMatrix(kPoints, laplacian3d(kBox, 3.1)), makeMatrix(260, saddlePoint(200, 60))}) {
    const auto s = solve(options, true, K);
    EXPECT_LE(residual(*K, *s.x, *s.b), options.tolerance);
  }
  const auto K = makeMatrix(203, convection(203, 0.4));
  const auto s = solve(options, false, K);
  Vector x(K->getRowMap());
  s.solver->solveTransposed(*s.b, x);
  EXPECT_LE(residual(*K, x, *s.b, true), options.tolerance);
  EXPECT_GT(residual(*K, x, *s.b), 1e-3);  // it is another system
}

/// Condition 4 n^2 / pi^2 = 1.6e8: more than single precision holds, and eps times it is more than the
/// tolerance.
TEST(Krylov, BadlyConditionedMatricesAreSolvedToRounding) {
  constexpr int n = 20000;
  const auto K = makeMatrix(n, chain(n));
  const auto s = solve(with(Preconditioner::singleFactor), true, K);
  // eps |K| |x| in 2-norms is eps sqrt(n) at most in maximum norms: 3e-14, and as much again for its
  // evaluation.
  EXPECT_LT(backwardError(*K, *s.x, *s.b), 1e-13);
}

TEST(Krylov, RightHandSidesMayExceedSinglePrecision) {
  const auto K = makeMatrix(kPoints, laplacian3d(kBox, 0));
  const auto s = solve(with(Preconditioner::singleFactor), true, K);
  s.b->scale(1e80);
  s.solver->solve(*s.b, *s.x);
  EXPECT_LE(residual(*K, *s.x, *s.b), 1e-9);
}

TEST(Krylov, EarlierSolutionsAreStartVectors) {
  const auto K = makeMatrix(kPoints, laplacian3d(kBox, 0));
  const auto many = makeReference(K->getRowMap(), 3);
  KrylovOptions options = with(Preconditioner::ilu);
  const auto cost = [&](int startVectors) {
    options.startVectors = startVectors;
    KrylovSolver solver(options, true);
    solver.analyze(K);
    solver.factor(K);
    MultiVector x(K->getRowMap(), 3);
    solver.solve(*many, x);
    const auto before = solver.iterations()->total;
    Vector b(K->getRowMap()), y(K->getRowMap());
    for (int j = 0; j < 3; ++j) b.update(1.0 + j, *many->getVector(j), 1);
    solver.solve(b, y);
    EXPECT_LE(residual(*K, y, b), options.tolerance);
    return solver.iterations()->total - before;
  };
  // A combination of earlier right-hand sides needs the one correction that is always made.
  EXPECT_EQ(cost(20), 1);
  EXPECT_GT(cost(0), 3);
  // With the latest two of three it is not such a combination.
  EXPECT_GT(cost(2), 3);
}

TEST(Krylov, NoConvergenceIsOneLineAndNotTheEnd) {
  const auto K = makeMatrix(kPoints, laplacian3d(kBox, 0));
  KrylovOptions options = with(Preconditioner::ilu);
  options.maxIterations = 3;
  KrylovSolver solver(options, true);
  solver.analyze(K);
  solver.factor(K);
  const auto b = makeReference(K->getRowMap());
  Vector x(K->getRowMap());
  try {
    solver.solve(*b, x);
    FAIL();
  } catch (const SolverError& e) {
    EXPECT_NE(std::string(e.what()).find("no convergence"), std::string::npos) << e.what();
    EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos) << e.what();
  }
  // An easier one, the identity next to it, is solved.
  const auto easy = makeMatrix(kPoints, laplacian3d(kBox, -1e6));
  solver.factor(easy);
  solver.solve(*b, x);
  EXPECT_LE(residual(*easy, x, *b->getVector(0)), options.tolerance);
}

TEST(Krylov, AFactorInSinglePrecisionTakesHalfTheMemory) {
  const auto K = makeMatrix(20 * 20 * 20, laplacian3d({20, 20, 20}, 0));
  MumpsSolver direct;
  SingleFactor single(true, 0), compressed(true, 1e-2);
  direct.analyze(K);
  direct.factor(K);
  for (auto* factor : {&single, &compressed}) {
    factor->analyze(K);
    factor->factor(K);
    // Half, and MUMPS' integers and megabytes rounded up.
    EXPECT_LT(factor->spent()->bytes, 0.7 * direct.spent()->bytes);
    EXPECT_LT(factor->estimate()->bytes, 0.7 * direct.estimate()->bytes);
  }
}

TEST(Krylov, OptionsOutOfRangeThrow) {
  KrylovOptions options;
  options.tolerance = 0;
  EXPECT_THROW(KrylovSolver(options, true), SolverError);
  options = {};
  options.fill = 0.5;
  EXPECT_THROW(KrylovSolver(options, true), SolverError);
}

TEST(Auto, PicksByMemoryAndSaysWhy) {
  const int n = 20 * 20 * 20;
  const auto K = makeMatrix(n, laplacian3d({20, 20, 20}, 0));
  TangentSolverOptions options;
  options.krylov.subspace = 10;  // so that its vectors, which count too, are few beside the factor
  options.krylov.startVectors = 0;
  const auto bytes = [&](const char* type, Preconditioner preconditioner) {
    TangentSolverOptions o = options;
    o.type = type;
    o.krylov.preconditioner = preconditioner;
    const auto solver = makeTangentSolver(o);
    solver->analyze(K);
    return estimate(*solver)->bytes;
  };
  const double mumps = bytes("mumps", {}), single = bytes("belos", Preconditioner::singleFactor),
               ilu = bytes("belos", Preconditioner::ilu);
  ASSERT_LT(single, mumps);
  ASSERT_LT(ilu, single);

  options.type = "auto";
  const auto b = makeReference(K->getRowMap());
  const std::vector<std::pair<double, std::string>> cases{
      {0, "MUMPS SYM"}, {mumps, "MUMPS SYM"}, {single, "single precision"}, {ilu, "ILUT"}};
  for (const auto& [memory, name] : cases) {
    options.memory = memory;
    std::vector<std::string> told;
    options.tell = [&](const std::string& line) { told.push_back(line); };
    const auto solver = makeTangentSolver(options);
    EXPECT_EQ(choice(*solver), "");
    solver->analyze(K);
    solver->factor(K);
    Vector x(K->getRowMap());
    solver->solve(*b, x);
    EXPECT_LE(residual(*K, x, *b->getVector(0)), options.krylov.tolerance);
    EXPECT_NE(solver->name().find(name), std::string::npos) << solver->name();
    ASSERT_EQ(told.size(), 1u);
    EXPECT_EQ(told[0], choice(*solver));
    EXPECT_EQ(told[0].find('\n'), std::string::npos);
    EXPECT_LE(estimate(*solver)->bytes, memory == 0 ? mumps : memory);
    EXPECT_EQ(solver->inertia().has_value(), memory == 0 || memory == mumps);
    EXPECT_EQ(iterations(*solver).has_value(), !solver->inertia());
  }
  options.memory = 0.5 * ilu;
  EXPECT_THROW(makeTangentSolver(options)->analyze(K), SolverError);
}

}  // namespace
}  // namespace atrapos::linear::test
