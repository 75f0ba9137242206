#pragma once

#include <Thyra_StateFuncModelEvaluatorBase.hpp>

#include "atrapos/linear/TangentSolver.hpp"
#include "atrapos/path/Problem.hpp"

namespace atrapos::thyra {

/// A path::Problem as a Thyra model evaluator, for NOX, LOCA and whatever else speaks Thyra: f(x, p) = R(U,
/// lambda) with x = U on the Problem's map and one parameter vector p of one entry, lambda.
///
/// Gives f, W_op = K_T (a matrix of its own: values of one evaluation are not changed by the next), W where a
/// tangent solver is given, and DfDp = -F as a multivector of one column. Tangent and load direction come
/// from one call of the Problem, which is remembered: asking for them one after the other at the same state
/// costs one assembly.
///
/// Problem and solver are the caller's and must outlive the model. What the Problem throws passes through.
/// Solves with a tangent that the solver found singular come back as not converged.
class PathModel : public ::Thyra::StateFuncModelEvaluatorBase<double> {
 public:
  /// `start`: nominal values of x and lambda. With a null solver W is not supported, W_op is.
  PathModel(path::Problem& problem, linear::TangentSolver* solver, const path::Vector& start, double lambda);
  ~PathModel() override;

  Teuchos::RCP<const ::Thyra::VectorSpaceBase<double>> get_x_space() const override;
  Teuchos::RCP<const ::Thyra::VectorSpaceBase<double>> get_f_space() const override;
  Teuchos::RCP<const ::Thyra::VectorSpaceBase<double>> get_p_space(int l) const override;
  Teuchos::RCP<const Teuchos::Array<std::string>> get_p_names(int l) const override;  ///< "load factor"
  ::Thyra::ModelEvaluatorBase::InArgs<double> getNominalValues() const override;
  ::Thyra::ModelEvaluatorBase::InArgs<double> createInArgs() const override;
  Teuchos::RCP<::Thyra::LinearOpBase<double>> create_W_op() const override;
  Teuchos::RCP<const ::Thyra::LinearOpWithSolveFactoryBase<double>> get_W_factory() const override;

  /// Calls of the Problem so far.
  struct Counters {
    long long residuals = 0, tangents = 0;
  };
  const Counters& counters() const;

  /// Size of the residual at the last evaluation of f.
  const path::ResidualNorm& lastResidual() const;

 private:
  ::Thyra::ModelEvaluatorBase::OutArgs<double> createOutArgsImpl() const override;
  void evalModelImpl(const ::Thyra::ModelEvaluatorBase::InArgs<double>& in,
                     const ::Thyra::ModelEvaluatorBase::OutArgs<double>& out) const override;

  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace atrapos::thyra
