#include "atrapos/path/Pade.hpp"

#include <algorithm>

namespace atrapos::path {

Pade::Pade(int degree, std::vector<double> denominator)
    : degree_(degree), denominator_(std::move(denominator)) {}

std::vector<double> Pade::weights(double a) const {
  const auto& d = denominator_.coefficients();
  const double D = denominator_(a);
  // partial[m] = D_m(a).
  std::vector<double> partial(degree_ + 1), c(degree_ + 1);
  double sum = 0, power = 1;
  for (int m = 0; m <= degree_; ++m, power *= a) {
    if (m < static_cast<int>(d.size())) sum += d[m] * power;
    partial[m] = sum;
  }
  c[0] = 1;
  power = a;
  for (int i = 1; i <= degree_; ++i, power *= a) c[i] = partial[degree_ - i] * power / D;
  return c;
}

std::vector<double> Pade::derivativeWeights(double a) const {
  const auto& d = denominator_.coefficients();
  const double D = denominator_(a), slope = denominator_.derivative()(a);
  std::vector<double> c(degree_ + 1, 0.0);
  for (int i = 1; i <= degree_; ++i) {
    double p = 0, dp = 0;  // D_{L-i} and its derivative
    for (int j = std::min(degree_ - i, static_cast<int>(d.size()) - 1); j >= 0; --j) {
      dp = dp * a + p;
      p = p * a + d[j];
    }
    double power = 1;
    for (int k = 1; k < i; ++k) power *= a;
    c[i] = power * (i * p + a * dp - a * p * slope / D) / D;
  }
  return c;
}

Rational Pade::fraction(const std::vector<double>& x) const {
  const auto& d = denominator_.coefficients();
  std::vector<double> p(degree_ + 1, 0.0);
  for (int k = 1; k <= degree_; ++k) {
    const int first = std::max(1, k - static_cast<int>(d.size()) + 1);
    for (int i = first; i <= k; ++i) p[k] += d[k - i] * x.at(i);
  }
  // X_0 goes with the whole denominator, which keeps P(0) = X_0 and its derivative free of cancellation.
  return {Polynomial(std::move(p)).plus(x.at(0), denominator_), denominator_};
}

}  // namespace atrapos::path
