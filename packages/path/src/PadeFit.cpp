#include "PadeFit.hpp"

#include <algorithm>
#include <cmath>

#include <Teuchos_LAPACK.hpp>
#include <Tpetra_Vector.hpp>

namespace atrapos::path {

namespace {

/// Scaled coefficients of a series in an orthonormal basis of what they span.
struct Coordinates {
  double unit = 1;                     ///< the series is in t = a / unit
  int rank = 0;                        ///< number of basis vectors
  std::vector<std::vector<double>> x;  ///< x[i]: coordinates of unit^i X_i, i >= 1
};

/// A coefficient adds a direction of its own where more than the part `newDirection` of it lies outside the
/// ones before.
Coordinates coordinates(const Problem& problem, const Series& series, double newDirection) {
  Coordinates c;
  const int N = series.order();
  const double w = series.weight();
  c.unit = std::clamp(series.convergenceRadius(), 1e-8, 1e8);
  struct Pair {
    Increment x;
    double lambda;
  };
  const auto inner = [&](const Pair& p, const Pair& q) {
    return w * problem.inner(p.x, q.x) + p.lambda * q.lambda;
  };
  std::vector<Pair> basis;
  c.x.emplace_back();
  double scale = 1;
  for (int i = 1; i <= N; ++i) {
    scale *= c.unit;
    const auto& Xi = series.coefficient(i);
    Pair p{{Teuchos::rcp(new Vector(*Xi.u, Teuchos::Copy)), Xi.internal},
           scale * series.lambdaCoefficient(i)};
    p.x.u->scale(scale);
    for (double& y : p.x.internal) y *= scale;
    const double size = std::sqrt(inner(p, p));
    std::vector<double> alpha;
    for (const auto& q : basis) {
      alpha.push_back(inner(p, q));
      p.x.u->update(-alpha.back(), *q.x.u, 1);
      for (std::size_t j = 0; j < p.x.internal.size(); ++j) p.x.internal[j] -= alpha.back() * q.x.internal[j];
      p.lambda -= alpha.back() * q.lambda;
    }
    const double rest = std::sqrt(std::max(0.0, inner(p, p)));
    if (rest > newDirection * size) {
      alpha.push_back(rest);
      p.x.u->scale(1 / rest);
      for (double& y : p.x.internal) y /= rest;
      p.lambda /= rest;
      basis.push_back(std::move(p));
    }
    c.x.push_back(std::move(alpha));
  }
  c.rank = static_cast<int>(basis.size());
  for (auto& x : c.x) x.resize(c.rank, 0.0);
  return c;
}

/// Minimum-norm least squares A d = b by singular values, A column by column. Singular values below `noise`
/// of the largest are noise of the coefficients: dropping them keeps spurious poles out.
std::vector<double> leastSquares(std::vector<double> A, std::vector<double> b, int rows, int columns,
                                 double noise) {
  Teuchos::LAPACK<int, double> lapack;
  std::vector<double> singular(std::min(rows, columns));
  b.resize(std::max(rows, columns), 0.0);
  int rank = 0, info = 0;
  double size = 0;
  lapack.GELSS(rows, columns, 1, A.data(), rows, b.data(), static_cast<int>(b.size()), singular.data(), noise,
               &rank, &size, -1, nullptr, &info);
  std::vector<double> work(static_cast<std::size_t>(size));
  lapack.GELSS(rows, columns, 1, A.data(), rows, b.data(), static_cast<int>(b.size()), singular.data(), noise,
               &rank, work.data(), static_cast<int>(work.size()), nullptr, &info);
  if (info != 0) return {};
  b.resize(columns);
  return b;
}

/// P_N in t from the first N orders; null where there are too few.
std::shared_ptr<const Pade> fit(const Coordinates& c, int N, double noise) {
  const int M = std::min(N - 1, N * c.rank / (c.rank + 1));
  const int L = std::min(N - 1, std::max(M, N - (M + c.rank - 1) / c.rank));
  if (M < 1 || L < 1) return nullptr;
  const int rows = (N - L) * c.rank;
  std::vector<double> A(rows * M), b(rows);
  for (int k = L + 1; k <= N; ++k)
    for (int q = 0; q < c.rank; ++q) {
      const int row = (k - L - 1) * c.rank + q;
      b[row] = -c.x[k][q];
      for (int j = 1; j <= M; ++j) A[(j - 1) * rows + row] = k - j >= 1 ? c.x[k - j][q] : 0;
    }
  auto d = leastSquares(std::move(A), std::move(b), rows, M, noise);
  if (d.empty() || !std::all_of(d.begin(), d.end(), [](double x) { return std::isfinite(x); }))
    return nullptr;
  d.insert(d.begin(), 1.0);
  return std::make_shared<Pade>(L, std::move(d));
}

/// ||P - Q||^2 and ||P - X_0||^2 at t.
std::pair<double, double> difference(const Coordinates& c, const Pade& P, const Pade& Q, double t) {
  const auto p = P.weights(t), q = Q.weights(t);
  double diff = 0, size = 0;
  for (int r = 0; r < c.rank; ++r) {
    double x = 0, y = 0;
    for (std::size_t i = 1; i < p.size(); ++i) x += p[i] * c.x[i][r];
    for (std::size_t i = 1; i < q.size(); ++i) y += q[i] * c.x[i][r];
    diff += (x - y) * (x - y);
    size += x * x;
  }
  return {diff, size};
}

Pade inUnitsOfA(const Pade& form, double unit) {
  auto d = form.denominator().coefficients();
  double power = 1;
  for (double& x : d) {
    x /= power;
    power *= unit;
  }
  return Pade(form.degree(), std::move(d));
}

}  // namespace

PadeFit fitPade(const Problem& problem, const Series& series, double delta, double longest) {
  PadeFit result;
  const int N = series.order();
  if (N < 4 || !std::isfinite(series.convergenceRadius())) return result;
  // Far above what rounding leaves of a well-conditioned problem's series (1e-12) and of a fit (1e-15): which
  // directions and singular values count, and with them the length of the step, must not depend on it.
  constexpr double newDirection = 1e-7, noise = 1e-10;
  const auto c = coordinates(problem, series, newDirection);
  const auto P = fit(c, N, noise), Q = fit(c, N - 1, noise);
  if (!P || !Q) return result;
  // Beyond some radii of convergence no finite series has anything to say.
  constexpr double radii = 8, margin = 0.95;
  double end = std::min(longest / c.unit, radii);
  for (const auto& form : {P, Q}) {
    const auto poles = form->denominator().roots(end / margin);
    if (!poles.empty()) end = std::min(end, margin * poles.front());
  }
  const auto good = [&](double t) {
    const auto [diff, size] = difference(c, *P, *Q, t);
    return diff <= delta * delta * size;  // false for values that are not numbers
  };
  constexpr double stride = 1.05, accurate = 1.01;
  double t = 0.05;
  if (t >= end || !good(t)) return result;
  while (t < end && good(std::min(stride * t, end))) t = std::min(stride * t, end);
  if (t < end) {
    double bad = std::min(stride * t, end);
    while (bad > accurate * t) {
      const double mid = 0.5 * (t + bad);
      (good(mid) ? t : bad) = mid;
    }
  }
  result.form = std::make_shared<Pade>(inUnitsOfA(*P, c.unit));
  result.range = t * c.unit;
  return result;
}

std::vector<double> realPoles(const Problem& problem, const Series& series, double behind, double ahead,
                              double noise, double agreement) {
  std::vector<double> poles;
  const int N = series.order();
  if (N < 4 || !std::isfinite(series.convergenceRadius())) return poles;
  const auto c = coordinates(problem, series, noise);
  const auto P = fit(c, N, noise), Q = fit(c, N - 1, noise);
  if (!P || !Q) return poles;
  const auto roots = [](const Polynomial& p, double end, double sense) {
    auto d = p.coefficients();
    if (sense < 0)
      for (std::size_t k = 1; k < d.size(); k += 2) d[k] = -d[k];
    return Polynomial(d).roots(end);
  };
  for (const double sense : {-1.0, 1.0}) {
    const double end = (sense < 0 ? behind : ahead) / c.unit;
    if (!(end > 0)) continue;
    const auto first = roots(P->denominator(), end, sense);
    const auto second = roots(Q->denominator(), end * (1 + agreement), sense);
    for (const double t : first)
      if (std::any_of(second.begin(), second.end(),
                      [&](double s) { return std::abs(s - t) <= agreement * t; }))
        poles.push_back(sense * t * c.unit);
  }
  std::sort(poles.begin(), poles.end(), [](double x, double y) { return std::abs(x) < std::abs(y); });
  return poles;
}

}  // namespace atrapos::path
