#include <algorithm>
#include <cmath>
#include <numeric>

#include <Teuchos_LAPACK.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Vector.hpp>

#include "Critical.hpp"
#include "TwoFold.hpp"
#include "atrapos/linear/Dot.hpp"

namespace atrapos::path {

namespace {

/// Eigenpairs of K nearest to zero in the span of x, which is made orthonormal and turned into the vectors;
/// returns the eigenvalues.
std::vector<double> rayleighRitz(Calls& calls, const CrsMatrix& K, std::vector<RCP<Vector>>& x) {
  const int m = static_cast<int>(x.size());
  std::vector<double> A(m * m), mu(m), work(3 * m);
  auto y = calls.newVector();
  for (int j = 0; j < m; ++j) {
    K.apply(*x[j], *y);
    for (int i = 0; i < m; ++i) A[j * m + i] = linear::dot(*x[i], *y);
  }
  int info = 0;
  Teuchos::LAPACK<int, double>().SYEV('V', 'L', m, A.data(), m, mu.data(), work.data(), 3 * m, &info);
  std::vector<RCP<Vector>> turned;
  for (int j = 0; j < m; ++j) {
    turned.push_back(calls.newVector());
    for (int i = 0; i < m; ++i) turned.back()->update(A[j * m + i], *x[i], 1);
  }
  x = std::move(turned);
  return mu;
}

void inverseIterations(Calls& calls, std::vector<RCP<Vector>>& x) {
  auto y = calls.newVector();
  constexpr int iterations = 4;
  for (int it = 0; it < iterations; ++it)
    for (std::size_t i = 0; i < x.size(); ++i) {
      calls.solve(*x[i], *y);
      // Twice: a solve with a nearly singular matrix returns nearly the first vector again.
      for (int pass = 0; pass < 2; ++pass)
        for (std::size_t j = 0; j < i; ++j) y->update(-linear::dot(*x[j], *y), *x[j], 1);
      x[i]->update(1 / y->norm2(), *y, 0);
    }
}

}  // namespace

NearNull nearNull(Calls& calls, const CriticalSearch& search, double guess, const RCP<Vector>& nullGuess,
                  int count) {
  NearNull result;
  if (!calls.problem().symmetric()) return result;
  const int n = static_cast<int>(calls.problem().map()->getGlobalNumElements());
  std::vector<RCP<Vector>> x{Teuchos::rcp(new Vector(*nullGuess, Teuchos::Copy))};
  for (int i = 1; i < std::min(count, n); ++i) {
    x.push_back(calls.newVector());
    fillUnsymmetric(*x.back(), i + 1);
  }
  State state = search.series.state(guess);
  auto F = calls.newVector();
  calls.factor(state, *F);
  inverseIterations(calls, x);
  const auto mu = rayleighRitz(calls, *calls.tangent(state, *F), x);
  // d mu / da = phi . D^2R(t, (phi, 0)).
  const auto t = search.series.tangent(guess);
  for (std::size_t i = 0; i < x.size(); ++i) {
    SecondOrder second(calls, state, x[i]);
    result.a.push_back(guess - mu[i] / second({t.x.u, t.lambda}, {x[i], 0}));
  }
  std::vector<std::size_t> order(x.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
    return std::abs(result.a[i] - guess) < std::abs(result.a[j] - guess);
  });
  NearNull sorted;
  for (const auto i : order)
    if (std::isfinite(result.a[i])) {
      sorted.a.push_back(result.a[i]);
      sorted.vectors.push_back(x[i]);
    }
  return sorted;
}

bool refineMultiple(Calls& calls, const CriticalSearch& search, const NearNull& zeros, CriticalPoint& point,
                    int& factorizations) {
  // A little aside: the tangent at the very point cannot be factored.
  const double aside = 3e-5 * search.length, a0 = std::min(zeros.a.front(), search.length);
  const double at = a0 - aside;
  ++factorizations;
  return confirmMultiple(
      calls, search,
      nearNull(calls, search, at, zeros.vectors.front(), static_cast<int>(zeros.vectors.size())), at, point);
}

bool confirmMultiple(Calls& calls, const CriticalSearch& search, const NearNull& near, double at,
                     CriticalPoint& point) {
  if (near.a.size() < 2) return false;
  const double a = near.a.front();
  if (!(a >= 0 && a <= search.length)) return false;
  // Zeros of straight lines of length |a - at| are this far from those of the eigenvalues.
  const double together = 1e-9 * search.length + 10 * (a - at) * (a - at) / search.length;
  std::vector<RCP<Vector>> vectors;
  for (std::size_t i = 0; i < near.a.size(); ++i)
    if (std::abs(near.a[i] - a) <= together) vectors.push_back(near.vectors[i]);
  if (vectors.size() < 2) return false;
  return multipleAt(calls, search, a, vectors, (a - at) * (a - at) / search.length, point);
}

bool multipleAt(Calls& calls, const CriticalSearch& search, double a, const std::vector<RCP<Vector>>& vectors,
                double uncertainty, CriticalPoint& point) {
  point.nullity = static_cast<int>(vectors.size());
  point.nullVectors = vectors;
  State state = search.series.state(a);
  auto r = calls.newVector();
  point.residual = calls.residual(state, *r).relative();
  if (point.residual > search.residualBound) return false;
  point.a = a;
  point.kind = CriticalKind::multiple;
  point.state = state;
  point.uncertainty = uncertainty / search.length;
  if (point.nullity != 2) return true;
  const auto along = search.series.tangent(a);
  const double w = search.series.weight();
  Augmented path{along.x.u, along.lambda};
  const auto others = twoFoldTangents(calls, state, w, path, {point.nullVectors[0], point.nullVectors[1]});
  if (others.empty()) return true;
  path = copy(path);
  scale(path, 1 / std::sqrt(dot(path, path, w)));
  const auto keep = [&](const Augmented& x) {
    PathTangent tangent;
    tangent.x = {x.u, std::vector<double>(calls.problem().internalCount(), 0.0)};
    tangent.lambda = x.lambda;
    point.tangents.push_back(tangent);
  };
  keep(path);
  for (const auto& x : others) keep(x);
  return true;
}

}  // namespace atrapos::path
