#pragma once

#include <memory>

#include "atrapos/path/Pieces.hpp"
#include "atrapos/path/State.hpp"

namespace atrapos::path {

/// A dead force constant + lambda perLoadFactor on a Problem's map; null: zero.
struct DeadForce {
  RCP<const Vector> constant, perLoadFactor;
};

/// A Problem with a force that it does not have itself: R(U, lambda) - f(lambda) = 0. Everything else is that
/// of the Problem without it, which must outlive it; only one of the two is followed at a time.
///
/// A small constant force is an imperfection: the path has no solution at the start of the perfect one's, and
/// path following corrects it there at fixed lambda.
class ForcedProblem : public Problem {
 public:
  /// The forces live on the Problem's map; they are not copied. Throws std::invalid_argument where they do
  /// not, or where there is none.
  ForcedProblem(Problem& unforced, DeadForce force);
  ~ForcedProblem() override;

  RCP<const Map> map() const override { return unforced_.map(); }
  bool symmetric() const override { return unforced_.symmetric(); }
  RCP<const CrsMatrix> mass(const State& state) override { return unforced_.mass(state); }
  RCP<const Vector> eigenvalueWeights(const State& state) override {
    return unforced_.eigenvalueWeights(state);
  }
  ResidualNorm residual(const State& state, Vector& r) override;
  double scaleAlong(const Vector& v, const State& state) override { return unforced_.scaleAlong(v, state); }
  RCP<const CrsMatrix> tangent(const State& state, Vector& F) override;
  void beginSeries(const State& state, int maxOrder) override { unforced_.beginSeries(state, maxOrder); }
  void orderRhs(int k, Vector& Fk) override { unforced_.orderRhs(k, Fk); }
  void completeOrder(int k, const Vector& Uk, double lambdaK) override {
    unforced_.completeOrder(k, Uk, lambdaK);
  }
  int internalCount() const override { return unforced_.internalCount(); }
  void internalOrder(int k, const Vector& v, double mu, std::vector<double>& y) const override {
    unforced_.internalOrder(k, v, mu, y);
  }
  int eventCount() const override { return unforced_.eventCount(); }
  std::vector<int> growingAt(const State& state) const override { return unforced_.growingAt(state); }
  double negligibleFall(int event) const override { return unforced_.negligibleFall(event); }
  bool eventMayBeNone(int event) const override { return unforced_.eventMayBeNone(event); }
  void eventOrder(int k, std::vector<double>& g) const override { unforced_.eventOrder(k, g); }
  State afterEvent(const std::vector<int>& indices, const State& state) override {
    return unforced_.afterEvent(indices, state);
  }
  std::vector<int> eventsBeside(const std::vector<int>& indices, const State& state) override {
    return unforced_.eventsBeside(indices, state);
  }
  bool eventGradient(int index, const State& state, double& value, Vector& byU, double& byLambda) override {
    return unforced_.eventGradient(index, state, value, byU, byLambda);
  }
  std::vector<int> eventsAt(const State& state) override { return unforced_.eventsAt(state); }
  bool remembers() const override { return unforced_.remembers(); }
  std::vector<std::vector<double>> memoryOrders() override { return unforced_.memoryOrders(); }
  State settled(const State& state) override { return unforced_.settled(state); }
  Pieces* pieces() override { return pieces_.get(); }
  int constraintPivots() const override { return unforced_.constraintPivots(); }
  std::string name(long long unknown) const override { return unforced_.name(unknown); }
  double inner(const Increment& x, const Increment& y) const override { return unforced_.inner(x, y); }
  std::vector<double> fieldChanges(const State& from, const State& to) override {
    return unforced_.fieldChanges(from, to);
  }
  void weighFields(const std::vector<double>& factors) override { unforced_.weighFields(factors); }
  double weight(const Increment& Xhat, std::optional<double> given) override {
    return unforced_.weight(Xhat, given);
  }
  bool isNegligible(const Vector& change) const override { return unforced_.isNegligible(change); }

 private:
  Problem& unforced_;
  DeadForce force_;
  std::unique_ptr<Pieces> pieces_;  ///< null where those of the Problem without the force are
};

/// The force K_T(state) d that moves the perfect structure by d, to first order: an imperfection with the
/// shape and the size of d, a buckling mode times a part of the thickness, say.
RCP<Vector> forceOfShape(Problem& problem, const State& state, const Vector& d);

/// What holds a state in equilibrium that the Problem does not (a support that is no longer there), and fades
/// as lambda goes from 0 to 1: (1 - lambda) R(state). The state's own lambda is that with which R is
/// evaluated, 0.
DeadForce forceThatFades(Problem& problem, const State& state);

}  // namespace atrapos::path
