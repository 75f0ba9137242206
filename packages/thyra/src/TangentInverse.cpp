#include "atrapos/thyra/TangentInverse.hpp"

#include <Thyra_DefaultLinearOpSource.hpp>
#include <Thyra_TpetraLinearOp.hpp>
#include <Thyra_TpetraThyraWrappers.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_MultiVector.hpp>

#include "atrapos/linear/Error.hpp"

namespace atrapos::thyra {

namespace {

using Extraction = ::Thyra::TpetraOperatorVectorExtraction<double, linear::LocalIndex, linear::GlobalIndex>;

Teuchos::RCP<const linear::CrsMatrix> matrixOf(const Teuchos::RCP<const ::Thyra::LinearOpBase<double>>& op) {
  const auto tpetra = Extraction::getConstTpetraOperator(op);
  const auto matrix = Teuchos::rcp_dynamic_cast<const linear::CrsMatrix>(tpetra);
  if (matrix.is_null()) throw linear::SolverError("TangentInverse: the operator is no Tpetra::CrsMatrix");
  return matrix;
}

}  // namespace

void TangentInverse::initialize(const Teuchos::RCP<const ::Thyra::LinearOpBase<double>>& op) {
  const auto K = matrixOf(op);
  if (factorization_ == 0) solver_.analyze(K);
  factorization_ = -1;
  op_ = op;
  solver_.factor(K);
  factorization_ = solver_.counters().factorizations;
}

Teuchos::RCP<const ::Thyra::VectorSpaceBase<double>> TangentInverse::range() const {
  return op_.is_null() ? Teuchos::null : op_->range();
}
Teuchos::RCP<const ::Thyra::VectorSpaceBase<double>> TangentInverse::domain() const {
  return op_.is_null() ? Teuchos::null : op_->domain();
}
bool TangentInverse::opSupportedImpl(::Thyra::EOpTransp transpose) const {
  return ::Thyra::opSupported(*op_, transpose);
}
void TangentInverse::applyImpl(::Thyra::EOpTransp transpose, const ::Thyra::MultiVectorBase<double>& X,
                               const Teuchos::Ptr<::Thyra::MultiVectorBase<double>>& Y, double alpha,
                               double beta) const {
  ::Thyra::apply(*op_, transpose, X, Y, alpha, beta);
}

::Thyra::SolveStatus<double> TangentInverse::solveImpl(
    ::Thyra::EOpTransp transpose, const ::Thyra::MultiVectorBase<double>& B,
    const Teuchos::Ptr<::Thyra::MultiVectorBase<double>>& X,
    const Teuchos::Ptr<const ::Thyra::SolveCriteria<double>>) const {
  ::Thyra::SolveStatus<double> status;
  // A factorization that failed is a failed solve: NOX then ends its iterations, and LOCA shortens the step.
  status.solveStatus = ::Thyra::SOLVE_STATUS_UNCONVERGED;
  if (factorization_ == -1) return status;
  if (factorization_ != solver_.counters().factorizations)
    throw linear::SolverError("TangentInverse: the solver has factored another tangent since");
  const auto b = Extraction::getConstTpetraMultiVector(Teuchos::rcpFromRef(B));
  const auto x = Extraction::getTpetraMultiVector(Teuchos::rcpFromPtr(X));
  if (transpose == ::Thyra::NOTRANS || transpose == ::Thyra::CONJ)
    solver_.solve(*b, *x);
  else
    solver_.solveTransposed(*b, *x);
  status.solveStatus = ::Thyra::SOLVE_STATUS_CONVERGED;
  return status;
}

bool TangentInverseFactory::isCompatible(const ::Thyra::LinearOpSourceBase<double>& source) const {
  const auto op = source.getOp();
  return !op.is_null() &&
         !Teuchos::rcp_dynamic_cast<
              const ::Thyra::TpetraLinearOp<double, linear::LocalIndex, linear::GlobalIndex>>(op)
              .is_null();
}

Teuchos::RCP<::Thyra::LinearOpWithSolveBase<double>> TangentInverseFactory::createOp() const {
  return Teuchos::rcp(new TangentInverse(solver_));
}

void TangentInverseFactory::initializeOp(
    const Teuchos::RCP<const ::Thyra::LinearOpSourceBase<double>>& source,
    ::Thyra::LinearOpWithSolveBase<double>* op, ::Thyra::ESupportSolveUse) const {
  try {
    dynamic_cast<TangentInverse&>(*op).initialize(source->getOp());
  } catch (const linear::SingularTangentError&) {
    // The solves say that they failed.
  }
}

void TangentInverseFactory::uninitializeOp(
    ::Thyra::LinearOpWithSolveBase<double>* op,
    Teuchos::RCP<const ::Thyra::LinearOpSourceBase<double>>* source,
    Teuchos::RCP<const ::Thyra::PreconditionerBase<double>>* preconditioner,
    Teuchos::RCP<const ::Thyra::LinearOpSourceBase<double>>* approximate,
    ::Thyra::ESupportSolveUse* use) const {
  auto& inverse = dynamic_cast<TangentInverse&>(*op);
  if (source)
    *source = inverse.op().is_null() ? Teuchos::null : ::Thyra::defaultLinearOpSource<double>(inverse.op());
  if (preconditioner) *preconditioner = Teuchos::null;
  if (approximate) *approximate = Teuchos::null;
  if (use) *use = ::Thyra::SUPPORT_SOLVE_UNSPECIFIED;
  inverse.uninitialize();
}

}  // namespace atrapos::thyra
