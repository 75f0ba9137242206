// What every tangent solver must do, for all that this build has, symmetric and unsymmetric.
#include <gtest/gtest.h>

#include <Tpetra_CrsMatrix.hpp>
#include <limits>

#include "Matrices.hpp"
#include "atrapos/linear/Error.hpp"
#include "atrapos/linear/MakeTangentSolver.hpp"

namespace atrapos::linear::test {
namespace {

struct Case {
  std::string type;
  bool symmetric;
  friend std::ostream& operator<<(std::ostream& out, const Case& c) {
    return out << c.type << (c.symmetric ? ", symmetric" : ", unsymmetric");
  }
};

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const auto& type : availableTangentSolvers())
    // What iterations do is in TestKrylov.cpp: their accuracy is a choice, and they find no singular matrix.
    for (bool symmetric : {true, false})
      if (type != "belos" && (symmetric || type != "amesos2:tacho")) all.push_back({type, symmetric});
  return all;
}

class Solvers : public testing::TestWithParam<Case> {
 protected:
  void SetUp() override {
    if (needsDefinite() && makeMap(1, Layout::contiguous)->getComm()->getSize() > 1)
      GTEST_SKIP() << "Tacho's adapter runs on one rank";
  }
  std::unique_ptr<TangentSolver> make() const {
    TangentSolverOptions options;
    options.type = GetParam().type;
    options.symmetric = GetParam().symmetric;
    return makeTangentSolver(options);
  }
  bool needsDefinite() const { return GetParam().type == "amesos2:tacho"; }

  /// A matrix of the kind the solver under test is for: unsymmetric, or symmetric and if possible indefinite.
  RowFunction typicalRows(int n) const {
    if (!GetParam().symmetric) return convection(n, 0.4);
    return needsDefinite() ? chain(n, 0.5) : chain(n, -1.3);
  }
};

TEST_P(Solvers, SolveToRounding) {
  const auto K = makeMatrix(203, typicalRows(203));
  const auto b = makeReference(K->getRowMap());
  Vector x(K->getRowMap());
  const auto solver = make();
  solver->analyze(K);
  solver->factor(K);
  solver->solve(*b, x);
  EXPECT_LT(backwardError(*K, x, *b), roundingBound);
}

TEST_P(Solvers, SolveTransposedToRounding) {
  const auto K = makeMatrix(203, typicalRows(203));
  const auto b = makeReference(K->getRowMap());
  Vector x(K->getRowMap()), xt(K->getRowMap());
  const auto solver = make();
  solver->analyze(K);
  solver->factor(K);
  solver->solveTransposed(*b, xt);
  EXPECT_LT(backwardError(*K, xt, *b, true), roundingBound);
  // An ordinary solve after a transposed one is ordinary again.
  solver->solve(*b, x);
  EXPECT_LT(backwardError(*K, x, *b), roundingBound);
  if (!GetParam().symmetric) {
    EXPECT_GT(backwardError(*K, xt, *b), 1e-3);  // it is another system
  }
}

TEST_P(Solvers, TransposedSolveBelongsToTheLastFactor) {
  const auto K = makeMatrix(64, typicalRows(64));
  const auto factored = rcp(new CrsMatrix(*K, Teuchos::Copy));
  const auto b = makeReference(K->getRowMap(), 3);
  MultiVector x(K->getRowMap(), 3);
  const auto solver = make();
  solver->analyze(K);
  for (double scale : {1.0, 2.0}) {
    K->resumeFill();
    K->scale(scale);
    K->fillComplete();
    factored->resumeFill();
    factored->scale(scale);
    factored->fillComplete();
    solver->factor(K);
    // The caller is free to change the values after factor().
    K->resumeFill();
    K->scale(8);
    K->fillComplete();
    solver->solveTransposed(*b, x);
    EXPECT_LT(backwardError(*factored, x, *b, true), roundingBound);
    solver->solve(*b, x);
    EXPECT_LT(backwardError(*factored, x, *b), roundingBound);
    K->resumeFill();
    K->scale(0.125);
    K->fillComplete();
  }
}

TEST_P(Solvers, ManyColumnsAndAliasing) {
  const auto K = makeMatrix(97, typicalRows(97));
  const auto b = makeReference(K->getRowMap(), 7);
  MultiVector x(K->getRowMap(), 7);
  const auto solver = make();
  solver->analyze(K);
  solver->factor(K);
  solver->solve(*b, x);
  EXPECT_LT(backwardError(*K, x, *b), roundingBound);
  EXPECT_EQ(solver->counters().solves, 7);

  MultiVector inPlace(*b, Teuchos::Copy);
  solver->solve(inPlace, inPlace);
  EXPECT_LT(backwardError(*K, inPlace, *b), roundingBound);

  // Some columns of a larger block, not evenly spaced.
  const Teuchos::Array<std::size_t> some = Teuchos::tuple<std::size_t>(1, 2, 5);
  MultiVector block(K->getRowMap(), 7);
  const auto part = block.subViewNonConst(some());
  solver->solve(*b->subView(some()), *part);
  EXPECT_LT(backwardError(*K, *part, *b->subView(some())), roundingBound);
  EXPECT_EQ(block.getVector(0)->normInf(), 0);
}

TEST_P(Solvers, SaddlePoint) {
  if (needsDefinite()) GTEST_SKIP() << "Cholesky";
  const auto K = makeMatrix(260, saddlePoint(200, 60));
  const auto b = makeReference(K->getRowMap());
  Vector x(K->getRowMap());
  const auto solver = make();
  solver->analyze(K);
  solver->factor(K);
  solver->solve(*b, x);
  EXPECT_LT(backwardError(*K, x, *b), roundingBound);
}

TEST_P(Solvers, ScatteredGlobalIndices) {
  const auto K = makeMatrix(150, typicalRows(150), Layout::scattered);
  const auto b = makeReference(K->getRowMap());
  Vector x(K->getRowMap());
  const auto solver = make();
  solver->analyze(K);
  solver->factor(K);
  solver->solve(*b, x);
  EXPECT_LT(backwardError(*K, x, *b), roundingBound);
  solver->solveTransposed(*b, x);
  EXPECT_LT(backwardError(*K, x, *b, true), roundingBound);
}

TEST_P(Solvers, FactorAgainOnTheSameGraph) {
  const auto first = makeMatrix(120, typicalRows(120));
  const auto b = makeReference(first->getRowMap());
  const auto solver = make();
  solver->analyze(first);
  Vector x(first->getRowMap());
  for (double scale : {1.0, 3.0, 0.25}) {
    first->resumeFill();
    first->scale(scale);
    first->fillComplete();
    solver->factor(first);
    solver->solve(*b, x);
    EXPECT_LT(backwardError(*first, x, *b), roundingBound);
  }
  // Another matrix object with an equal graph is as good.
  const auto second = makeMatrix(120, typicalRows(120));
  solver->factor(second);
  solver->solve(*b, x);
  EXPECT_LT(backwardError(*second, x, *b), roundingBound);
  EXPECT_EQ(solver->counters().analyses, 1);
  EXPECT_EQ(solver->counters().factorizations, 4);
  EXPECT_EQ(solver->counters().solves, 4);
}

TEST_P(Solvers, AnotherGraphThrows) {
  const auto K = makeMatrix(60, chain(60));
  const auto solver = make();
  solver->analyze(K);
  EXPECT_THROW(solver->factor(makeMatrix(60, ring(60))), SolverError);   // other entries
  EXPECT_THROW(solver->factor(makeMatrix(61, chain(61))), SolverError);  // other map
  solver->factor(K);
  solver->analyze(makeMatrix(61, chain(61)));
  EXPECT_THROW(solver->factor(K), SolverError);
}

TEST_P(Solvers, SingularThrows) {
  const auto K = makeMatrix(90, ring(90));
  const auto solver = make();
  solver->analyze(K);
  EXPECT_THROW(solver->factor(K), SolverError);
  const auto b = makeReference(K->getRowMap());
  Vector x(K->getRowMap());
  EXPECT_THROW(solver->solve(*b, x), SolverError);

  // The same solver goes on with a regular matrix.
  const auto regular = makeMatrix(90, [](int i) {
    auto row = ring(90)(i);
    row[0].second += 1;
    return row;
  });
  solver->factor(regular);
  solver->solve(*b, x);
  EXPECT_LT(backwardError(*regular, x, *b), roundingBound);
}

TEST_P(Solvers, NearlySingularStillSolves) {
  // Smallest eigenvalue 1e-9 of the largest: what a path meets next to a critical point.
  const auto K = makeMatrix(90, [](int i) {
    auto row = ring(90)(i);
    row[0].second += 4e-9;
    return row;
  });
  const auto b = makeReference(K->getRowMap());
  Vector x(K->getRowMap());
  const auto solver = make();
  solver->analyze(K);
  solver->factor(K);
  solver->solve(*b, x);
  EXPECT_LT(backwardError(*K, x, *b), roundingBound);
}

TEST_P(Solvers, NotFiniteThrows) {
  const auto K = makeMatrix(30, [](int i) {
    auto row = chain(30)(i);
    if (i == 17) row[0].second = std::numeric_limits<double>::quiet_NaN();
    return row;
  });
  const auto solver = make();
  solver->analyze(K);
  EXPECT_THROW(solver->factor(K), SolverError);
}

TEST_P(Solvers, SymmetryIsChecked) {
  if (!GetParam().symmetric) GTEST_SKIP() << "unsymmetric mode";
  const auto K = makeMatrix(80, convection(80, 1e-6));
  const auto solver = make();
  solver->analyze(K);
  EXPECT_THROW(solver->factor(K), SolverError);
}

TEST_P(Solvers, CallsOutOfOrderThrow) {
  const auto K = makeMatrix(20, chain(20));
  const auto b = makeReference(K->getRowMap());
  Vector x(K->getRowMap());
  const auto solver = make();
  EXPECT_THROW(solver->factor(K), SolverError);
  EXPECT_THROW(solver->solve(*b, x), SolverError);
  solver->analyze(K);
  EXPECT_THROW(solver->solve(*b, x), SolverError);
  solver->factor(K);
  Vector tooLong(makeMap(21, Layout::contiguous));
  EXPECT_THROW(solver->solve(*b, tooLong), SolverError);
  MultiVector twoColumns(K->getRowMap(), 2);
  EXPECT_THROW(solver->solve(*b, twoColumns), SolverError);
}

INSTANTIATE_TEST_SUITE_P(All, Solvers, testing::ValuesIn(cases()),
                         [](const testing::TestParamInfo<Case>& info) {
                           std::string name = info.param.type + (info.param.symmetric ? "_sym" : "_unsym");
                           for (char& c : name)
                             if (c == ':') c = '_';
                           return name;
                         });

TEST(MakeTangentSolver, UnknownTypeListsWhatThereIs) {
  for (const char* type : {"pardiso", "amesos2:nosuch", "amesos2:"}) {
    TangentSolverOptions options;
    options.type = type;
    try {
      makeTangentSolver(options);
      FAIL() << type;
    } catch (const SolverError& e) {
      EXPECT_NE(std::string(e.what()).find("klu2"), std::string::npos) << e.what();
      EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos) << e.what();
    }
  }
}

}  // namespace
}  // namespace atrapos::linear::test
