#pragma once

#include <utility>
#include <vector>

namespace atrapos::path {

/// A real polynomial p(a) = sum_k c_k a^k: a scalar of the path inside one step.
class Polynomial {
 public:
  Polynomial() = default;
  explicit Polynomial(std::vector<double> coefficients) : c_(std::move(coefficients)) {}

  const std::vector<double>& coefficients() const { return c_; }

  double operator()(double a) const;
  Polynomial derivative() const;

  /// p + factor q.
  Polynomial plus(double factor, const Polynomial& q) const;
  Polynomial operator*(const Polynomial& q) const;

  /// p - value.
  Polynomial minus(double value) const;

  /// (p - p(0)) / a: takes a known root at a = 0 out.
  Polynomial withoutRootAtZero() const;

  /// sum_k |c_k| a^k: the size that rounding errors of p(a) are relative to.
  double magnitude(double a) const;

  /// All real roots in (0, end], ascending. Bernstein form on [0, end] and Descartes' rule of signs: an
  /// interval without a sign variation has no root, so none is missed between samples. Simple roots are
  /// exact to rounding; a touching (double) root is reported once, to about sqrt(rounding). The zero
  /// polynomial has no roots by this definition.
  std::vector<double> roots(double end) const;

 private:
  std::vector<double> c_;
};

}  // namespace atrapos::path
