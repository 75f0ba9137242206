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
  path::ResidualNorm residual(const path::Vector& u, double lambda, path::Vector& r) override;
  path::RCP<const path::CrsMatrix> tangent(const path::Vector& u, double lambda, path::Vector& F) override;
  void beginSeries(const path::Vector& u, double lambda, int maxOrder) override {
    exact_.beginSeries(u, lambda, maxOrder);
  }
  void orderRhs(int k, path::Vector& Fk) override;
  void completeOrder(int k, const path::Vector& Uk, double lambdaK) override {
    exact_.completeOrder(k, Uk, lambdaK);
  }
  int internalCount() const override { return exact_.internalCount(); }
  void internalOrder(int k, const path::Vector& v, double mu, std::vector<double>& y) const override {
    exact_.internalOrder(k, v, mu, y);
  }
  int eventCount() const override { return exact_.eventCount(); }
  void eventOrder(int k, std::vector<double>& g) const override { exact_.eventOrder(k, g); }
  std::vector<int> eventsAt(const path::Vector& u, double lambda) const override {
    return exact_.eventsAt(u, lambda);
  }
  void applyEvent(const std::vector<int>& indices, const path::Vector& u, double lambda) override {
    exact_.applyEvent(indices, u, lambda);
  }
  std::vector<int> conditions() const override { return exact_.conditions(); }
  void setConditions(const std::vector<int>& conditions) override { exact_.setConditions(conditions); }
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
