#pragma once

#include "atrapos/path/Polynomial.hpp"

namespace atrapos::path {

/// A real function p(a)/q(a) with q > 0 where it is used: a scalar of the path inside one step, either a
/// polynomial (q = 1) or a Padé fraction.
class Rational {
 public:
  Rational() : q_({1.0}) {}
  Rational(Polynomial p) : p_(std::move(p)), q_({1.0}) {}  // NOLINT: a polynomial is one
  Rational(Polynomial p, Polynomial q) : p_(std::move(p)), q_(std::move(q)) {}

  const Polynomial& numerator() const { return p_; }
  const Polynomial& denominator() const { return q_; }

  double operator()(double a) const { return p_(a) / q_(a); }
  Rational derivative() const;

  /// this - value.
  Rational minus(double value) const;

  /// this / a where this(0) = 0: takes a known root at a = 0 out.
  Rational withoutRootAtZero() const { return {p_.withoutRootAtZero(), q_}; }

  /// The size that rounding errors of this(a) are relative to.
  double magnitude(double a) const { return p_.magnitude(a) / q_(a); }

  /// All real roots in (0, end], ascending; see Polynomial::roots.
  std::vector<double> roots(double end) const { return p_.roots(end); }

 private:
  Polynomial p_, q_;
};

}  // namespace atrapos::path
