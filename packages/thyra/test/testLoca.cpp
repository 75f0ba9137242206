// The paths of both own methods beside LOCA's: same problems, same tangent solver.
#include <gtest/gtest.h>

#include <Thyra_TpetraThyraWrappers.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Vector.hpp>
#include <cmath>

#include "HingedRoof.hpp"
#include "LocaRun.hpp"
#include "atrapos/linear/MakeTangentSolver.hpp"
#include "atrapos/path/NewtonFollower.hpp"
#include "atrapos/path/PathFollower.hpp"
#include "atrapos/thyra/PathModel.hpp"
#include "atrapos/thyra/TangentInverse.hpp"
#include "problems/ChebyshevBratu.hpp"
#include "problems/DenseSolver.hpp"
#include "problems/JetProblem.hpp"
#include "problems/Laws.hpp"

using namespace atrapos;
using namespace atrapos::thyra;
using namespace atrapos::thyra::test;

namespace {

/// f, W_op and DfDp of the model are those of the Problem; the copy of the tangent is not changed by the next
/// evaluation, and the same state is assembled once.
using Extraction = ::Thyra::TpetraOperatorVectorExtraction<double, int, long long>;

std::vector<double> numbers(const Teuchos::RCP<::Thyra::VectorBase<double>>& x) {
  const auto v = Extraction::getTpetraVector(x);
  const auto data = v->getData();
  return {data.begin(), data.end()};
}

/// f, W_op and DfDp are those of the Problem; the tangent's copy keeps its values, and a state is assembled
/// once.
TEST(PathModel, GivesWhatTheProblemGives) {
  const TrussOnSpring law{0.3};
  JetProblem<TrussOnSpring> problem(law), same(law);
  PathModel model(problem, nullptr, *problem.vector({0.3, 0.7}), 0.2);
  EXPECT_EQ((*model.get_p_names(0))[0], "load factor");
  EXPECT_TRUE(model.get_W_factory().is_null());
  const auto in = model.getNominalValues();
  auto out = model.createOutArgs();
  const auto f = ::Thyra::createMember(*model.get_f_space());
  const auto dfdp = ::Thyra::createMembers(*model.get_f_space(), 1);
  const auto W = model.create_W_op();
  EXPECT_EQ(model.counters().tangents, 1);  // for its graph
  out.set_f(f);
  out.set_W_op(W);
  out.set_DfDp(0, ::Thyra::ModelEvaluatorBase::Derivative<double>(dfdp));
  model.evalModel(in, out);
  EXPECT_EQ(model.counters().tangents, 1);  // the start is where the graph was made

  const auto u = same.vector({0.3, 0.7}), r = same.vector({}), F = same.vector({}), Kx = same.vector({});
  const auto norm = same.residual(*u, 0.2, *r);
  const auto K = same.tangent(*u, 0.2, *F);
  const auto x = ::Thyra::createMember(*model.get_x_space()), y = ::Thyra::createMember(*model.get_f_space());
  Tpetra::deep_copy(*Extraction::getTpetraVector(x), *same.vector({1, -2}));
  K->apply(*same.vector({1, -2}), *Kx);
  const auto checkTangent = [&] {
    ::Thyra::apply<double>(*W, ::Thyra::NOTRANS, *x, y.ptr());
    for (int i = 0; i < 2; ++i) EXPECT_EQ(numbers(y)[i], Kx->getData()[i]);
  };
  checkTangent();
  EXPECT_EQ(model.lastResidual().norm, norm.norm);
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(numbers(f)[i], r->getData()[i]);
    EXPECT_EQ(numbers(dfdp->col(0))[i], -F->getData()[i]);
  }

  // Elsewhere: DfDp is new, W_op keeps what it was given.
  auto elsewhere = model.createInArgs();
  elsewhere.set_x(x);
  elsewhere.set_p(0, in.get_p(0));
  auto derivative = model.createOutArgs();
  derivative.set_DfDp(0, ::Thyra::ModelEvaluatorBase::Derivative<double>(dfdp));
  model.evalModel(elsewhere, derivative);
  EXPECT_EQ(model.counters().tangents, 2);
  checkTangent();
}

TEST(PathModel, TakesOnlyItsOwnMap) {
  JetProblem<TrussOnSpring> two(TrussOnSpring{0.3});
  JetProblem<Truss> one(Truss{});
  EXPECT_THROW(PathModel(two, nullptr, *one.vector({0}), 0), std::invalid_argument);
}

/// Of two inverses with one solver only the last can solve.
TEST(TangentInverse, KnowsThatItsFactorsAreGone) {
  JetProblem<TrussOnSpring> problem(TrussOnSpring{0.3});
  DenseSolver solver;
  PathModel model(problem, &solver, *problem.vector({}), 0);
  const auto in = model.getNominalValues();
  auto out = model.createOutArgs();
  const auto op = model.create_W_op();
  out.set_W_op(op);
  model.evalModel(in, out);
  TangentInverse first(solver), second(solver);
  first.initialize(op);
  const auto b = ::Thyra::createMember(*model.get_x_space()), x = ::Thyra::createMember(*model.get_x_space()),
             r = ::Thyra::createMember(*model.get_x_space());
  Tpetra::deep_copy(*Extraction::getTpetraVector(b), *problem.vector({1, 3}));
  ::Thyra::solve<double>(first, ::Thyra::NOTRANS, *b, x.ptr());
  ::Thyra::apply<double>(first, ::Thyra::NOTRANS, *x, r.ptr());
  for (int i = 0; i < 2; ++i) EXPECT_NEAR(numbers(r)[i], numbers(b)[i], 1e-14);  // 2 x 2, condition 10
  second.initialize(op);
  EXPECT_THROW(::Thyra::solve<double>(first, ::Thyra::NOTRANS, *b, x.ptr()), linear::SolverError);
  EXPECT_EQ(solver.counters().analyses, 2);
}

/// Keeps the limit points.
struct Limits final : path::Observer {
  std::vector<double> lambda;
  bool onStep(const path::StepReport& report, const path::Series&) override {
    for (const auto& p : report.limitPoints) lambda.push_back(p.lambda);
    return true;
  }
};

/// Costs of a path, for the test's report.
void record(const std::string& who, int steps, long long factorizations, long long solves) {
  testing::Test::RecordProperty(who + "_steps", steps);
  testing::Test::RecordProperty(who + "_factorizations", std::to_string(factorizations));
  testing::Test::RecordProperty(who + "_solves", std::to_string(solves));
}

path::Outcome withSeries(path::Problem& problem, const path::State& start, const path::Stops& stops,
                         Limits& limits, linear::TangentSolver& solver) {
  const auto outcome = path::PathFollower(problem, solver, {}, stops).run(start, limits);
  EXPECT_EQ(outcome.reason, path::EndReason::stopReached) << outcome.text;
  record("series", outcome.steps, outcome.factorizations, outcome.solves);
  return outcome;
}

path::Outcome withNewton(path::Problem& problem, const path::State& start, const path::Stops& stops,
                         Limits& limits, linear::TangentSolver& solver, path::NewtonOptions options) {
  const auto outcome = path::NewtonFollower(problem, solver, options, stops).run(start, limits);
  EXPECT_EQ(outcome.reason, path::EndReason::stopReached) << outcome.text;
  record("newton", outcome.steps, outcome.factorizations, outcome.solves);
  return outcome;
}

/// One limit point by three codes, and the literature's.
TEST(Loca, BratuFold) {
  const ChebyshevBratu law(24, 1);
  JetProblem<ChebyshevBratu> problem(law);
  const int middle = law.size() - 1;
  std::vector<double> weights(law.size(), 0.0);
  weights[middle] = 1;
  path::Stops stops;
  stops.functionals.push_back({"middle", problem.vector(weights), 2.5});
  const path::State start{problem.vector({}), 0};
  Limits series, newton;
  DenseSolver a, b, c;
  withSeries(problem, start, stops, series, a);
  path::NewtonOptions options;
  options.accuracy = 1e-5;
  withNewton(problem, start, stops, newton, b, options);
  LocaOptions loca;
  loca.stop = [&](const path::State& s) { return s.u->getData()[middle] > 2.5; };
  const LocaRun run = followWithLoca(problem, c, start, loca);
  EXPECT_TRUE(run.stopped);
  record("loca", run.steps, run.factorizations, run.solves);
  const double exact = 3.513830719125161;
  ASSERT_EQ(series.lambda.size(), 1u);
  EXPECT_NEAR(series.lambda[0], exact, 1e-5);  // residual bound 1e-6 x scale
  ASSERT_EQ(newton.lambda.size(), 1u);
  EXPECT_NEAR(newton.lambda[0], exact, 2e-5);  // the cubic's accuracy
  const LocaFold fold = foldByLoca(problem, c, run.points, 1, 1e-8);
  EXPECT_TRUE(fold.converged);
  EXPECT_NEAR(fold.lambda, exact, 1e-7);  // the discrete fold is exact to 1e-8, LOCA's residual 1e-8
}

/// Both limit points of the hinged roof and the end of the path by three codes.
TEST(Loca, HingedRoof) {
  const solid::test::HingedRoof roof(4, 12.7);
  const path::State start{roof.problem->initialState(0.0), 0.0};
  const double deflection = 30;
  const auto stops = roof.stopAtDeflection(deflection);
  const auto a = linear::makeTangentSolver(), b = linear::makeTangentSolver(),
             c = linear::makeTangentSolver();
  Limits series, newton;
  const auto bySeries = withSeries(*roof.problem, start, stops, series, *a);
  path::NewtonOptions options;
  options.accuracy = 1e-4;
  const auto byNewton = withNewton(*roof.problem, start, stops, newton, *b, options);
  LocaOptions loca;
  loca.maxStep = 0.05;
  loca.firstStep = 0.02;
  loca.stop = [&](const path::State& s) { return -s.u->getData()[roof.centreDof] > deflection; };
  const LocaRun run = followWithLoca(*roof.problem, *c, start, loca);
  record("loca", run.steps, run.factorizations, run.solves);
  ASSERT_TRUE(run.stopped);

  ASSERT_EQ(series.lambda.size(), 2u);
  ASSERT_EQ(newton.lambda.size(), 2u);
  for (int i = 0; i < 2; ++i)
    EXPECT_NEAR(newton.lambda[i], series.lambda[i], 5e-4);          // accuracy, and some room
  EXPECT_NEAR(byNewton.final.lambda, bySeries.final.lambda, 1e-4);  // residual bounds at the same deflection

  // LOCA's own limit points, from its points before and after the least load between them.
  std::size_t turn = 0;
  while (turn + 1 < run.points.size() && run.points[turn + 1].lambda > run.points[turn].lambda) ++turn;
  const std::vector<path::State> first(run.points.begin(), run.points.begin() + turn + 2),
      second(run.points.begin() + turn, run.points.end());
  const double signs[] = {1, -1};
  for (int i = 0; i < 2; ++i) {
    // Residuals in N and N/mm beside 750 N of load.
    const LocaFold fold = foldByLoca(*roof.problem, *c, i == 0 ? first : second, signs[i], 1e-6);
    EXPECT_TRUE(fold.converged) << i;
    EXPECT_NEAR(fold.lambda, series.lambda[i], 2e-6) << i;  // the series' residual bound, 1e-6
  }
  // Its end, by a secant between the points on both sides.
  const auto& last = run.points.back();
  const auto& before = run.points[run.points.size() - 2];
  const double u0 = -before.u->getData()[roof.centreDof], u1 = -last.u->getData()[roof.centreDof];
  const double end = before.lambda + (deflection - u0) / (u1 - u0) * (last.lambda - before.lambda);
  EXPECT_NEAR(end, bySeries.final.lambda, 2e-3);
}

}  // namespace
