#include "atrapos/thyra/PathModel.hpp"

#include <Thyra_DefaultSpmdVectorSpace.hpp>
#include <Thyra_TpetraThyraWrappers.hpp>
#include <Thyra_VectorStdOps.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Vector.hpp>
#include <stdexcept>

#include "atrapos/thyra/TangentInverse.hpp"

namespace atrapos::thyra {

using path::CrsMatrix;
using path::Vector;
using Base = ::Thyra::ModelEvaluatorBase;
using Space = ::Thyra::VectorSpaceBase<double>;
using Extraction = ::Thyra::TpetraOperatorVectorExtraction<double, linear::LocalIndex, linear::GlobalIndex>;
using Teuchos::RCP;
using Teuchos::rcp;

struct PathModel::Impl {
  path::Problem& problem;
  linear::TangentSolver* solver;
  RCP<const Space> xSpace, pSpace;
  RCP<Vector> start;
  double startLambda;
  Counters counters;
  path::ResidualNorm residual;

  // The tangent computed last, and where.
  RCP<const CrsMatrix> K;
  RCP<Vector> F, at;
  double atLambda = 0;

  void tangentAt(const Vector& u, double lambda) {
    if (!K.is_null() && lambda == atLambda) {
      Vector difference(u, Teuchos::Copy);
      difference.update(-1, *at, 1);
      if (difference.normInf() == 0) return;
    }
    ++counters.tangents;
    K = Teuchos::null;
    Tpetra::deep_copy(*at, u);
    K = problem.tangent({at, lambda}, *F);
    atLambda = lambda;
  }
};

PathModel::PathModel(path::Problem& problem, linear::TangentSolver* solver, const Vector& start,
                     double lambda)
    : impl_(new Impl{problem,
                     solver,
                     ::Thyra::createVectorSpace<double>(problem.map()),
                     Teuchos::null,
                     Teuchos::null,
                     lambda,
                     {},
                     {},
                     Teuchos::null,
                     Teuchos::null,
                     Teuchos::null}) {
  if (!start.getMap()->isSameAs(*problem.map()))
    throw std::invalid_argument("PathModel: the start is not on the Problem's map");
  impl_->start = rcp(new Vector(start, Teuchos::Copy));
  impl_->F = rcp(new Vector(problem.map()));
  impl_->at = rcp(new Vector(problem.map()));
  impl_->pSpace = ::Thyra::locallyReplicatedDefaultSpmdVectorSpace<double>(
      ::Thyra::convertTpetraToThyraComm(problem.map()->getComm()), 1);
}

PathModel::~PathModel() = default;

RCP<const Space> PathModel::get_x_space() const { return impl_->xSpace; }
RCP<const Space> PathModel::get_f_space() const { return impl_->xSpace; }
RCP<const Space> PathModel::get_p_space(int) const { return impl_->pSpace; }
RCP<const Teuchos::Array<std::string>> PathModel::get_p_names(int) const {
  return rcp(new Teuchos::Array<std::string>(1, "load factor"));
}

Base::InArgs<double> PathModel::createInArgs() const {
  Base::InArgsSetup<double> in;
  in.setModelEvalDescription("path::Problem");
  in.set_Np(1);
  in.setSupports(Base::IN_ARG_x);
  return in;
}

Base::InArgs<double> PathModel::getNominalValues() const {
  auto in = createInArgs();
  const auto x = ::Thyra::createMember(*impl_->xSpace);
  Tpetra::deep_copy(*Extraction::getTpetraVector(x), *impl_->start);
  const auto p = ::Thyra::createMember(*impl_->pSpace);
  ::Thyra::put_scalar(impl_->startLambda, p.ptr());
  in.set_x(x);
  in.set_p(0, p);
  return in;
}

Base::OutArgs<double> PathModel::createOutArgsImpl() const {
  Base::OutArgsSetup<double> out;
  out.setModelEvalDescription("path::Problem");
  out.set_Np_Ng(1, 0);
  out.setSupports(Base::OUT_ARG_f);
  out.setSupports(Base::OUT_ARG_W_op);
  out.setSupports(Base::OUT_ARG_DfDp, 0, Base::DerivativeSupport(Base::DERIV_MV_BY_COL));
  return out;
}

RCP<::Thyra::LinearOpBase<double>> PathModel::create_W_op() const {
  if (impl_->K.is_null()) impl_->tangentAt(*impl_->start, impl_->startLambda);  // for its graph
  const auto W = rcp(new CrsMatrix(impl_->K->getCrsGraph()));
  W->fillComplete(impl_->K->getDomainMap(), impl_->K->getRangeMap());
  return ::Thyra::createLinearOp<double>(
      Teuchos::rcp_implicit_cast<Tpetra::Operator<double, linear::LocalIndex, linear::GlobalIndex>>(W),
      impl_->xSpace, impl_->xSpace);
}

RCP<const ::Thyra::LinearOpWithSolveFactoryBase<double>> PathModel::get_W_factory() const {
  if (!impl_->solver) return Teuchos::null;
  return rcp(new TangentInverseFactory(*impl_->solver));
}

const PathModel::Counters& PathModel::counters() const { return impl_->counters; }
const path::ResidualNorm& PathModel::lastResidual() const { return impl_->residual; }

void PathModel::evalModelImpl(const Base::InArgs<double>& in, const Base::OutArgs<double>& out) const {
  const auto u = Extraction::getConstTpetraVector(in.get_x());
  const double lambda = in.get_p(0).is_null() ? impl_->startLambda : ::Thyra::get_ele(*in.get_p(0), 0);
  if (const RCP<::Thyra::VectorBase<double>> f = out.get_f(); !f.is_null()) {
    ++impl_->counters.residuals;
    impl_->residual = impl_->problem.residual({rcp(new Vector(*u, Teuchos::Copy)), lambda},
                                              *Extraction::getTpetraVector(f));
  }
  const auto W = out.get_W_op();
  const auto DfDp = out.get_DfDp(0).getMultiVector();
  if (W.is_null() && DfDp.is_null()) return;
  impl_->tangentAt(*u, lambda);
  if (!W.is_null()) {
    const auto matrix = Teuchos::rcp_dynamic_cast<CrsMatrix>(Extraction::getTpetraOperator(W), true);
    Kokkos::deep_copy(matrix->getLocalMatrixDevice().values, impl_->K->getLocalMatrixDevice().values);
  }
  if (!DfDp.is_null()) {
    const auto column = Extraction::getTpetraMultiVector(DfDp);
    column->getVectorNonConst(0)->update(-1, *impl_->F, 0);
  }
}

}  // namespace atrapos::thyra
