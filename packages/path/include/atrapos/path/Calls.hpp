#pragma once

#include "atrapos/path/Pieces.hpp"
#include "atrapos/path/Report.hpp"

namespace atrapos::path {

/// The Problem and the tangent solver of one path: every call goes through here, is timed and counted, and
/// failures come out as PathError.
class Calls {
 public:
  Calls(Problem& problem, linear::TangentSolver& solver) : problem_(problem), solver_(solver) {}

  const Problem& problem() const { return problem_; }
  const linear::TangentSolver& solver() const { return solver_; }

  /// r = R(state); the result may hold values that are not finite.
  ResidualNorm residual(const State& state, Vector& r);

  /// Problem::scaleAlong.
  double scaleAlong(const Vector& v, const State& state);

  /// Factors K_T(state) and fills F. Throws PathError: singularTangent or solverFailed, with the solver's
  /// message.
  void factor(const State& state, Vector& F);
  /// Factors a matrix with the graph of the tangent.
  void factor(const RCP<const CrsMatrix>& K);

  /// x = K_T^-1 b with the last factorization.
  void solve(const Vector& b, Vector& x);
  /// The same column by column; b and x are different objects.
  void solve(const linear::MultiVector& b, linear::MultiVector& x);
  /// x = K_T^-T b with the last factorization.
  void solveTransposed(const Vector& b, Vector& x);

  /// K_T(state) without factoring it, and F.
  RCP<const CrsMatrix> tangent(const State& state, Vector& F);

  /// Problem::mass.
  RCP<const CrsMatrix> mass(const State& state);
  /// Problem::eigenvalueWeights where the tangent is not symmetric, else null.
  RCP<const Vector> eigenvalueWeights(const State& state);

  void beginSeries(const State& state, int maxOrder);
  void orderRhs(int k, Vector& Fk);
  /// (v, internal variables of order k for U_k = v, lambda_k = mu).
  Increment internalOrder(int k, RCP<Vector> v, double mu);
  void completeOrder(int k, const Vector& Uk, double lambdaK);

  std::vector<std::vector<double>> memoryOrders();
  State settled(const State& state);

  double weight(const Increment& Xhat, std::optional<double> given);
  void weighFields(const std::vector<double>& factors);
  std::vector<double> fieldChanges(const State& from, const State& to);

  /// Coefficient k of the Problem's event functions.
  std::vector<double> eventOrder(int k);
  State afterEvent(const std::vector<int>& indices, const State& state);
  std::vector<int> eventsBeside(const std::vector<int>& indices, const State& state);
  bool eventGradient(int index, const State& state, double& value, Vector& byU, double& byLambda);
  std::vector<int> eventsAt(const State& start);

  /// Those of the Problem; call the other three only where there are some.
  bool hasPieces() const { return problem_.pieces() != nullptr; }
  ResidualNorm residualOfSeries(const State& state, Vector& r);
  bool eventsAstray(const State& state, const std::vector<int>& events);
  std::vector<Break> breaks(const Series& series, double end);
  bool continues(const State& state, int index);
  std::string breakText(int index) const;

  /// Of the last factorization, without the pivots owed to constraints.
  std::optional<linear::Inertia> inertia() const;

  /// A new zero vector on the Problem's map.
  RCP<Vector> newVector() const;

  const Work& work() const { return work_; }

 private:
  Problem& problem_;
  linear::TangentSolver& solver_;
  bool analysed_ = false;
  Work work_;
};

}  // namespace atrapos::path
