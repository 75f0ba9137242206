#pragma once

#include <memory>

#include "atrapos/path/Pieces.hpp"
#include "atrapos/path/State.hpp"

namespace atrapos::path {

/// A Problem with an imperfection: a small constant force, R(U, lambda) - f = 0. Everything else is the
/// perfect Problem's, which must outlive it; only one of the two is followed at a time.
///
/// The path has no solution at the perfect one's start: path following corrects it there at fixed lambda.
class ImperfectProblem : public Problem {
 public:
  /// `force` lives on the Problem's map; it is not copied. Throws std::invalid_argument where it does not.
  ImperfectProblem(Problem& perfect, RCP<const Vector> force);
  ~ImperfectProblem() override;

  RCP<const Map> map() const override { return perfect_.map(); }
  bool symmetric() const override { return perfect_.symmetric(); }
  ResidualNorm residual(const State& state, Vector& r) override;
  RCP<const CrsMatrix> tangent(const State& state, Vector& F) override { return perfect_.tangent(state, F); }
  void beginSeries(const State& state, int maxOrder) override { perfect_.beginSeries(state, maxOrder); }
  void orderRhs(int k, Vector& Fk) override { perfect_.orderRhs(k, Fk); }
  void completeOrder(int k, const Vector& Uk, double lambdaK) override {
    perfect_.completeOrder(k, Uk, lambdaK);
  }
  int internalCount() const override { return perfect_.internalCount(); }
  void internalOrder(int k, const Vector& v, double mu, std::vector<double>& y) const override {
    perfect_.internalOrder(k, v, mu, y);
  }
  int eventCount() const override { return perfect_.eventCount(); }
  std::vector<int> growingAt(const State& state) const override { return perfect_.growingAt(state); }
  void eventOrder(int k, std::vector<double>& g) const override { perfect_.eventOrder(k, g); }
  State afterEvent(const std::vector<int>& indices, const State& state) override {
    return perfect_.afterEvent(indices, state);
  }
  std::vector<int> eventsBeside(const std::vector<int>& indices, const State& state) override {
    return perfect_.eventsBeside(indices, state);
  }
  bool eventGradient(int index, const State& state, double& value, Vector& byU, double& byLambda) override {
    return perfect_.eventGradient(index, state, value, byU, byLambda);
  }
  std::vector<int> eventsAt(const State& state) override { return perfect_.eventsAt(state); }
  bool remembers() const override { return perfect_.remembers(); }
  std::vector<std::vector<double>> memoryOrders() override { return perfect_.memoryOrders(); }
  State settled(const State& state) override { return perfect_.settled(state); }
  Pieces* pieces() override { return pieces_.get(); }
  int constraintPivots() const override { return perfect_.constraintPivots(); }
  std::string name(long long unknown) const override { return perfect_.name(unknown); }
  double inner(const Increment& x, const Increment& y) const override { return perfect_.inner(x, y); }
  double weight(const Increment& Xhat, std::optional<double> given) override {
    return perfect_.weight(Xhat, given);
  }

 private:
  Problem& perfect_;
  RCP<const Vector> force_;
  std::unique_ptr<Pieces> pieces_;  ///< null where the perfect Problem's are
};

/// The force K_T(state) d that moves the perfect structure by d, to first order: an imperfection with the
/// shape and the size of d, a buckling mode times a part of the thickness, say.
RCP<Vector> forceOfShape(Problem& problem, const State& state, const Vector& d);

}  // namespace atrapos::path
