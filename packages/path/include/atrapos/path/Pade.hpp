#pragma once

#include <vector>

#include "atrapos/path/Rational.hpp"

namespace atrapos::path {

/// A series X_0 + a X_1 + ... with one denominator for all its components (Cochelin/Najah form):
///
///     P(a) = X_0 + sum_{i=1..L} [D_{L-i}(a) / D(a)] a^i X_i,
///     D(a) = sum_{j<=M} d_j a^j, d_0 = 1,   D_m(a) = sum_{j<=min(m, M)} d_j a^j,
///
/// that is numerators of degree L, truncated products of D with the series. Every linear functional of X, and
/// lambda, has the same weights.
class Pade {
 public:
  /// denominator: d_0 = 1 .. d_M; degree: L >= 1.
  Pade(int degree, std::vector<double> denominator);

  int degree() const { return degree_; }
  const Polynomial& denominator() const { return denominator_; }

  /// Factors of X_0 .. X_L in P(a).
  std::vector<double> weights(double a) const;
  /// Factors of X_0 .. X_L in dP/da (a).
  std::vector<double> derivativeWeights(double a) const;
  /// The scalar with Taylor coefficients x_0, x_1, ... in this form.
  Rational fraction(const std::vector<double>& x) const;

 private:
  int degree_;
  Polynomial denominator_;
};

}  // namespace atrapos::path
