#include "Augmented.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Vector.hpp>

#include "atrapos/linear/Dot.hpp"

namespace atrapos::path {

double dot(const Augmented& x, const Augmented& y, double weight) {
  return weight * linear::dot(*x.u, *y.u) + x.lambda * y.lambda;
}

double dot(const Problem& problem, const Augmented& x, const Augmented& y, double weight) {
  const std::vector<double> none(problem.internalCount(), 0.0);
  return weight * problem.inner({x.u, none}, {y.u, none}) + x.lambda * y.lambda;
}

RCP<Vector> copy(const Vector& v) { return Teuchos::rcp(new Vector(v, Teuchos::Copy)); }

Augmented copy(const Augmented& x) { return {copy(*x.u), x.lambda}; }

void add(Augmented& x, double factor, const Augmented& y) {
  x.u->update(factor, *y.u, 1);
  x.lambda += factor * y.lambda;
}

void scale(Augmented& x, double factor) {
  x.u->scale(factor);
  x.lambda *= factor;
}

void fillUnsymmetric(Vector& v, int which) {
  auto data = v.getDataNonConst();
  const auto map = v.getMap();
  for (int i = 0; i < data.size(); ++i) {
    // Weyl's sequence of an irrational number, centred.
    const double x =
        std::sqrt(which + 0.3819660112501051) * (static_cast<double>(map->getGlobalElement(i)) + 1);
    data[i] = x - std::floor(x) - 0.5;
  }
}

SecondOrder::SecondOrder(Calls& calls, const State& state, RCP<const Vector> psi)
    : calls_(calls), state_(state), psi_(std::move(psi)), F_(calls.newVector()) {}

double SecondOrder::operator()(const Augmented& x) {
  calls_.beginSeries(state_, 2);
  calls_.orderRhs(1, *F_);
  calls_.completeOrder(1, *x.u, x.lambda);
  calls_.orderRhs(2, *F_);
  return -2 * linear::dot(*psi_, *F_);
}

double SecondOrder::operator()(const Augmented& x, const Augmented& y) {
  Augmented plus = copy(x), minus = copy(x);
  add(plus, 1, y);
  add(minus, -1, y);
  return 0.25 * ((*this)(plus) - (*this)(minus));
}

Bordered::Solution Bordered::solve(Calls& calls, const RCP<const Vector>& b,
                                   std::array<double, 2> beta) const {
  const auto solveK = [&](const Vector& rhs, Vector& x) {
    transposed ? calls.solveTransposed(rhs, x) : calls.solve(rhs, x);
  };
  // Elimination: x = y - W xi with W = K^-1 [c_0 c_1].
  RCP<Vector> W[2];
  double S[2][2];
  for (int j = 0; j < 2; ++j) {
    W[j] = calls.newVector();
    solveK(*columns[j], *W[j]);
    for (int i = 0; i < 2; ++i) S[i][j] = d[i][j] - linear::dot(*rows[i], *W[j]);
  }
  const double det = S[0][0] * S[1][1] - S[0][1] * S[1][0];
  Solution s;
  s.x = calls.newVector();
  auto r = calls.newVector(), y = calls.newVector();
  // Backward errors: each residual relative to the terms that it is the difference of, where K x is taken as
  // large as it can be (x may be a null vector). The root mean square of K's rows stands for its norm.
  const double Knorm =
      std::max(stiffness, K->getFrobeniusNorm() / std::sqrt(static_cast<double>(K->getGlobalNumRows())));
  double before = std::numeric_limits<double>::infinity();
  // A solve is a hundredth of a factorization, and a point whose equations were solved half-way is a wrong
  // one to which Newton's method converges all the same: refined as long as each takes a tenth off. Rounding
  // leaves 1e-14 to 1e-13 next to a singular K; where refinement ends well above that the factors do not
  // serve.
  constexpr int maxRefinements = 60;
  constexpr double falls = 0.9, rounding = 1e-15, accurate = 1e-11;
  for (int i = 0; i <= maxRefinements; ++i) {
    K->apply(*s.x, *r, transposed ? Teuchos::TRANS : Teuchos::NO_TRANS, -1, 0);
    double forces = Knorm * s.x->norm2() + b->norm2();
    r->update(1, *b, 1);
    double rho[2], now = 0;
    for (int j = 0; j < 2; ++j) {
      r->update(-s.xi[j], *columns[j], 1);
      forces += std::abs(s.xi[j]) * columns[j]->norm2();
      const double along = linear::dot(*rows[j], *s.x);
      rho[j] = beta[j] - along - d[j][0] * s.xi[0] - d[j][1] * s.xi[1];
      const double terms = std::abs(beta[0]) + std::abs(beta[1]) + rows[j]->norm2() * s.x->norm2() +
                           std::abs(d[j][0] * s.xi[0]) + std::abs(d[j][1] * s.xi[1]);
      if (terms > 0) now += std::abs(rho[j]) / terms;
    }
    if (forces > 0) now += r->norm2() / forces;
    if (!std::isfinite(now)) return s;
    if (now <= rounding || now > falls * before) {
      s.good = std::min(now, before) <= accurate;
      return s;
    }
    before = now;
    solveK(*r, *y);
    const double e0 = rho[0] - linear::dot(*rows[0], *y), e1 = rho[1] - linear::dot(*rows[1], *y);
    const double dx0 = (S[1][1] * e0 - S[0][1] * e1) / det, dx1 = (S[0][0] * e1 - S[1][0] * e0) / det;
    s.x->update(1, *y, 1);
    s.x->update(-dx0, *W[0], -dx1, *W[1], 1);
    s.xi[0] += dx0;
    s.xi[1] += dx1;
  }
  s.good = before <= accurate;
  return s;
}

}  // namespace atrapos::path
