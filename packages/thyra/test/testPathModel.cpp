// The model evaluator and its inverse against the Problem itself.
#include <gtest/gtest.h>

#include <Thyra_TpetraThyraWrappers.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Vector.hpp>

#include "atrapos/linear/Error.hpp"
#include "atrapos/thyra/PathModel.hpp"
#include "atrapos/thyra/TangentInverse.hpp"
#include "problems/DenseSolver.hpp"
#include "problems/JetProblem.hpp"
#include "problems/Laws.hpp"

using namespace atrapos;
using namespace atrapos::thyra;

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
  const auto norm = same.residual({u, 0.2}, *r);
  const auto K = same.tangent({u, 0.2}, *F);
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

}  // namespace
