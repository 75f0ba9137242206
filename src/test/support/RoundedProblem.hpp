#pragma once

#include "atrapos/path/Problem.hpp"

namespace atrapos::test {

/// A Problem as another machine would round it: residuals, tangents and right-hand sides of orders are off by
/// `size` relative, at random with a fixed seed. The tangent stays symmetric where it is.
///
/// What a sum is rounded by goes with its terms: a residual is off by that part of the forces that it is the
/// difference of, entries of tangents and right-hand sides by that part of themselves.
class RoundedProblem final : public path::Problem {
 public:
  RoundedProblem(path::Problem& exact, unsigned seed, double size);

  path::RCP<const path::Map> map() const override { return exact_.map(); }
  bool symmetric() const override { return exact_.symmetric(); }
  path::ResidualNorm residual(const path::State& state, path::Vector& r) override;
  path::RCP<const path::CrsMatrix> tangent(const path::State& state, path::Vector& F) override;
  void beginSeries(const path::State& state, int maxOrder) override { exact_.beginSeries(state, maxOrder); }
  void orderRhs(int k, path::Vector& Fk) override;
  void completeOrder(int k, const path::Vector& Uk, double lambdaK) override {
    exact_.completeOrder(k, Uk, lambdaK);
  }
  int internalCount() const override { return exact_.internalCount(); }
  void internalOrder(int k, const path::Vector& v, double mu, std::vector<double>& y) const override {
    exact_.internalOrder(k, v, mu, y);
  }
  int eventCount() const override { return exact_.eventCount(); }
  std::vector<int> growingAt(const path::State& state) const override { return exact_.growingAt(state); }
  double negligibleFall(int event) const override { return exact_.negligibleFall(event); }
  void eventOrder(int k, std::vector<double>& g) const override { exact_.eventOrder(k, g); }
  bool eventGradient(int index, const path::State& state, double& value, path::Vector& byU,
                     double& byLambda) override {
    return exact_.eventGradient(index, state, value, byU, byLambda);
  }
  bool remembers() const override { return exact_.remembers(); }
  std::vector<std::vector<double>> memoryOrders() override { return exact_.memoryOrders(); }
  path::State settled(const path::State& state) override { return exact_.settled(state); }
  std::vector<int> eventsAt(const path::State& state) override { return exact_.eventsAt(state); }
  path::State afterEvent(const std::vector<int>& indices, const path::State& state) override {
    return exact_.afterEvent(indices, state);
  }
  path::Pieces* pieces() override { return exact_.pieces(); }
  int constraintPivots() const override { return exact_.constraintPivots(); }
  double inner(const path::Increment& x, const path::Increment& y) const override {
    return exact_.inner(x, y);
  }
  double weight(const path::Increment& Xhat, std::optional<double> given) override {
    return exact_.weight(Xhat, given);
  }
  std::string name(long long unknown) const override { return exact_.name(unknown); }

 private:
  void multiply(path::Vector& x);
  /// In [-size, size], the same for the same numbers.
  double noise(int i, int j = 0) const;

  path::Problem& exact_;
  unsigned seed_;
  double size_;
  unsigned calls_ = 0;
};

}  // namespace atrapos::test
