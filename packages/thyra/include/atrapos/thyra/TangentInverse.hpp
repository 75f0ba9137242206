#pragma once

#include <Thyra_LinearOpWithSolveBase.hpp>
#include <Thyra_LinearOpWithSolveFactoryBase.hpp>

#include "atrapos/linear/TangentSolver.hpp"

namespace atrapos::thyra {

/// A Tpetra matrix with its inverse by a linear::TangentSolver, as Thyra sees it.
///
/// The solver holds one factorization: of several inverses made with one solver only the one initialised last
/// can solve, the others throw linear::SolverError.
class TangentInverse : public ::Thyra::LinearOpWithSolveBase<double> {
 public:
  explicit TangentInverse(linear::TangentSolver& solver) : solver_(solver) {}

  /// Factors the operator, which must wrap a Tpetra::CrsMatrix. The graph is analysed once per
  /// TangentInverse.
  void initialize(const Teuchos::RCP<const ::Thyra::LinearOpBase<double>>& op);
  void uninitialize() { op_ = Teuchos::null; }
  const Teuchos::RCP<const ::Thyra::LinearOpBase<double>>& op() const { return op_; }

  Teuchos::RCP<const ::Thyra::VectorSpaceBase<double>> range() const override;
  Teuchos::RCP<const ::Thyra::VectorSpaceBase<double>> domain() const override;

 protected:
  bool opSupportedImpl(::Thyra::EOpTransp transpose) const override;
  void applyImpl(::Thyra::EOpTransp transpose, const ::Thyra::MultiVectorBase<double>& X,
                 const Teuchos::Ptr<::Thyra::MultiVectorBase<double>>& Y, double alpha,
                 double beta) const override;
  bool solveSupportsImpl(::Thyra::EOpTransp) const override { return true; }
  bool solveSupportsNewImpl(::Thyra::EOpTransp,
                            const Teuchos::Ptr<const ::Thyra::SolveCriteria<double>>) const override {
    return true;
  }
  bool solveSupportsSolveMeasureTypeImpl(::Thyra::EOpTransp,
                                         const ::Thyra::SolveMeasureType&) const override {
    return true;
  }
  ::Thyra::SolveStatus<double> solveImpl(
      ::Thyra::EOpTransp transpose, const ::Thyra::MultiVectorBase<double>& B,
      const Teuchos::Ptr<::Thyra::MultiVectorBase<double>>& X,
      const Teuchos::Ptr<const ::Thyra::SolveCriteria<double>> criteria) const override;

 private:
  linear::TangentSolver& solver_;
  Teuchos::RCP<const ::Thyra::LinearOpBase<double>> op_;
  long long factorization_ = 0;  ///< the solver's, after initialize
};

/// Makes TangentInverse objects for NOX.
class TangentInverseFactory : public ::Thyra::LinearOpWithSolveFactoryBase<double> {
 public:
  explicit TangentInverseFactory(linear::TangentSolver& solver) : solver_(solver) {}

  bool isCompatible(const ::Thyra::LinearOpSourceBase<double>& source) const override;
  Teuchos::RCP<::Thyra::LinearOpWithSolveBase<double>> createOp() const override;
  void initializeOp(const Teuchos::RCP<const ::Thyra::LinearOpSourceBase<double>>& source,
                    ::Thyra::LinearOpWithSolveBase<double>* op, ::Thyra::ESupportSolveUse use) const override;
  void uninitializeOp(::Thyra::LinearOpWithSolveBase<double>* op,
                      Teuchos::RCP<const ::Thyra::LinearOpSourceBase<double>>* source,
                      Teuchos::RCP<const ::Thyra::PreconditionerBase<double>>* preconditioner,
                      Teuchos::RCP<const ::Thyra::LinearOpSourceBase<double>>* approximate,
                      ::Thyra::ESupportSolveUse* use) const override;

  // There are no parameters: the solver is made by the caller.
  void setParameterList(const Teuchos::RCP<Teuchos::ParameterList>& list) override { list_ = list; }
  Teuchos::RCP<Teuchos::ParameterList> getNonconstParameterList() override { return list_; }
  Teuchos::RCP<Teuchos::ParameterList> unsetParameterList() override {
    auto list = list_;
    list_ = Teuchos::null;
    return list;
  }

 private:
  linear::TangentSolver& solver_;
  Teuchos::RCP<Teuchos::ParameterList> list_;
};

}  // namespace atrapos::thyra
