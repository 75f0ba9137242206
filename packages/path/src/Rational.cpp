#include "atrapos/path/Rational.hpp"

namespace atrapos::path {

Rational Rational::minus(double value) const { return {p_.plus(-value, q_), q_}; }

Rational Rational::derivative() const {
  if (q_.coefficients().size() <= 1) return {p_.derivative(), q_};
  // The derivative of p/q is that of (p - c q)/q; with c the value at 0 the two products cancel least.
  const Polynomial p = p_.plus(-(*this)(0), q_);
  return {(p.derivative() * q_).plus(-1, p * q_.derivative()), q_ * q_};
}

}  // namespace atrapos::path
