#include <algorithm>
#include <cmath>

#include "atrapos/solid/Ogden.hpp"

namespace atrapos::solid {
namespace {

/// Nodes and weights of Gauss's rule for (1-x)^-g (1+x)^g on [-1, 1], of mass one, -1 < g < 1: the
/// eigenvalues of the Jacobi matrix, whose diagonal is g, 0, 0, ..., by bisection.
struct GaussJacobi {
  double g;
  static constexpr int N = detail::StretchPower::numPoles;

  double squared(int n) const { return (1.0 * n * n - g * g) / (4.0 * n * n - 1); }  // beside the diagonal

  int numBelow(double x) const {  // Sturm
    int count = g - x < 0;
    double q = g - x;
    for (int n = 1; n < N; ++n) {
      q = -x - squared(n) / (q != 0 ? q : 1e-300);
      count += q < 0;
    }
    return count;
  }
  double node(int i) const {
    double low = -1, high = 1;
    for (;;) {
      const double middle = (low + high) / 2;
      if (middle <= low || middle >= high) return middle;
      (numBelow(middle) <= i ? low : high) = middle;
    }
  }
  double weight(double x) const {  // one over the sum of the squared orthonormal polynomials
    double before = 1, now = (x - g) / std::sqrt(squared(1)), sum = 1 + now * now;
    for (int n = 2; n < N; ++n) {
      const double next = (x * now - std::sqrt(squared(n - 1)) * before) / std::sqrt(squared(n));
      before = now;
      now = next;
      sum += now * now;
    }
    return 1 / sum;
  }
};

}  // namespace

detail::StretchPower detail::StretchPower::of(double power) {
  StretchPower p;
  p.whole = static_cast<int>(std::floor(power));
  const double a = power - p.whole;
  p.fractional = a > 0;
  if (!p.fractional) return p;
  const GaussJacobi rule{2 * a - 1};
  // sin(pi a)/pi times the mass of the rule, 2 pi g/sin(pi g), times 4 of dt
  const double middle = a - 0.5, pi = std::acos(-1.0);
  const double mass = std::abs(middle) < 1e-9 ? 8 / pi : 8 * middle / std::sin(pi * middle);
  for (int n = 0; n < numPoles; ++n) {
    const double x = rule.node(n), s = (1 + x) / (1 - x);
    p.pole[n] = s * s;
    p.weight[n] = mass * rule.weight(x) / ((1 - x) * (1 - x));
  }
  return p;
}

double Ogden::shearModulus() const {
  double sum = 0;
  for (int i = 0; i < numTerms; ++i) sum += terms[i].mu * terms[i].alpha / 2;
  return sum;
}

Ogden Ogden::fromModuli(const std::vector<double>& mu, const std::vector<double>& alpha, double bulk) {
  if (mu.empty() || mu.size() > maxTerms || alpha.size() != mu.size())
    throw std::invalid_argument("there must be one to six mu, and as many alpha");
  Ogden law;
  for (const double m : mu) {
    Term& term = law.terms[law.numTerms];
    term.mu = m;
    term.alpha = alpha[law.numTerms++];
    if (!(std::abs(term.alpha) <= 40) || term.alpha == 0 || term.mu == 0 || !std::isfinite(term.mu))
      throw std::invalid_argument("no mu and no alpha may be 0, and alpha is 40 at most");
    term.power = detail::StretchPower::of(term.alpha / 2);
  }
  detail::requirePositive(law.shearModulus(), "the sum of mu alpha, twice the shear modulus at rest,");
  detail::requirePositive(bulk, "the bulk modulus");
  law.bulk = bulk;
  return law;
}

}  // namespace atrapos::solid
