#include "Modes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Teuchos_LAPACK.hpp>
#include <Tpetra_MultiVector.hpp>
#include <Tpetra_Vector.hpp>

#include "Augmented.hpp"
#include "atrapos/linear/Dot.hpp"
#include "atrapos/path/Polynomial.hpp"

namespace atrapos::path {

namespace {

/// Orthonormal, column after column; false where one has no part of its own or is not finite.
bool orthonormalise(std::vector<RCP<Vector>>& x) {
  for (std::size_t i = 0; i < x.size(); ++i) {
    // Twice: solves with a nearly singular matrix return nearly the same vector.
    for (int pass = 0; pass < 2; ++pass) {
      const double before = x[i]->norm2();
      if (!std::isfinite(before) || !(before > 0)) return false;
      x[i]->scale(1 / before);
      for (std::size_t j = 0; j < i; ++j) x[i]->update(-linear::dot(*x[j], *x[i]), *x[j], 1);
    }
    const double size = x[i]->norm2();
    if (!(size > 0)) return false;
    x[i]->scale(1 / size);
  }
  return true;
}

/// Vectors turn along a step; less than this in common is another one.
constexpr double same = 0.8;

/// Whether the eigenvalue mu of x may vanish within four lengths like that since `before`.
bool vanishesSoon(double mu, const Vector& x, const std::vector<Mode>& before) {
  constexpr double lengths = 4;
  for (const Mode& b : before)
    if (std::abs(linear::dot(*b.x, x)) >= same)
      return mu * b.mu <= 0 || std::abs(mu) < lengths * (std::abs(b.mu) - std::abs(mu));
  return true;  // nothing is known of it
}

/// The polynomial of least degree on [0, 1] with these ends and slopes; a slope may be not a number.
Polynomial between(double y0, double s0, double y1, double s1) {
  const bool first = std::isfinite(s0), second = std::isfinite(s1);
  if (!first && !second) return Polynomial({y0, y1 - y0});
  if (!second) return Polynomial({y0, s0, y1 - y0 - s0});
  if (!first) return Polynomial({y0, 2 * (y1 - y0) - s1, s1 - (y1 - y0)});
  return Polynomial({y0, s0, 3 * (y1 - y0) - 2 * s0 - s1, 2 * (y0 - y1) + s0 + s1});
}

}  // namespace

double speedOf(const PathTangent& t, double weight) {
  return std::sqrt(weight * linear::dot(*t.x.u, *t.x.u) + t.lambda * t.lambda);
}

std::vector<Mode> nearestModes(Calls& calls, const State& state, const PathTangent& along, double weight,
                               const std::vector<Mode>& before, int count, Rates rates) {
  const int n = static_cast<int>(std::min<long long>(count, calls.problem().map()->getGlobalNumElements()));
  // Together, so that a solve reads the factor once for all of them.
  linear::MultiVector X(calls.problem().map(), n), Y(calls.problem().map(), n);
  std::vector<RCP<Vector>> x, y;
  for (int i = 0; i < n; ++i) {
    x.push_back(X.getVectorNonConst(i));
    y.push_back(Y.getVectorNonConst(i));
    if (i < static_cast<int>(before.size()))
      x[i]->update(1, *before[i].x, 0);
    else
      fillUnsymmetric(*x[i], i + 1);
  }
  if (!orthonormalise(x)) return {};
  // One goes on from the last step; more where nothing is known.
  const int iterations = before.empty() ? 6 : 1;
  for (int it = 0; it <= iterations; ++it) {
    calls.solve(X, Y);
    if (it == iterations) break;
    Tpetra::deep_copy(X, Y);
    if (!orthonormalise(x)) return {};
  }
  // Rayleigh and Ritz on the inverse, whose largest eigenvalues these are.
  std::vector<double> A(n * n), theta(n), work(3 * n);
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) A[j * n + i] = linear::dot(*x[i], *y[j]);
  int info = 0;
  Teuchos::LAPACK<int, double>().SYEV('V', 'L', n, A.data(), n, theta.data(), work.data(), 3 * n, &info);
  if (info != 0) return {};
  const double size = speedOf(along, weight);
  const double scale = along.x.u->norm2();
  std::vector<Mode> modes;
  for (int j = 0; j < n; ++j) {
    Mode mode;
    mode.x = calls.newVector();
    for (int i = 0; i < n; ++i) mode.x->update(A[j * n + i], *x[i], 1);
    mode.mu = 1 / theta[j];
    if (!std::isfinite(mode.mu)) continue;
    if (rates == Rates::soon && !vanishesSoon(mode.mu, *mode.x, before)) {
      mode.rate = std::numeric_limits<double>::quiet_NaN();
      modes.push_back(std::move(mode));
      continue;
    }
    // As large as X', so that the difference which makes the mixed derivative does not cancel.
    Augmented phi{Teuchos::rcp(new Vector(*mode.x, Teuchos::Copy)), 0};
    const double part = scale > 0 ? scale : 1;
    phi.u->scale(part);
    SecondOrder second(calls, state, mode.x);
    mode.rate = second({along.x.u, along.lambda}, phi) / (part * size);
    if (std::isfinite(mode.rate)) modes.push_back(std::move(mode));
  }
  return modes;
}

ModeEvidence zerosOf(const std::vector<ModeSample>& samples) {
  ModeEvidence evidence;
  constexpr double near = 0.2;
  for (std::size_t i = 0; i + 1 < samples.size(); ++i) {
    const ModeSample &first = samples[i], &second = samples[i + 1];
    const double length = second.a - first.a;
    for (const Mode& s : first.modes)
      for (const Mode& e : second.modes) {
        const double common = linear::dot(*s.x, *e.x);
        if (std::abs(common) < same) continue;
        const Polynomial mu =
            between(s.mu, length * first.speed * s.rate, e.mu, length * second.speed * e.rate);
        for (const double t : mu.roots(1)) {
          auto x = Teuchos::rcp(new Vector(*s.x, Teuchos::Copy));
          x->update(std::copysign(t, common), *e.x, 1 - t);
          x->scale(1 / x->norm2());
          evidence.zeros.push_back({first.a + t * length, x});
        }
        const double small = near * std::min(std::abs(s.mu), std::abs(e.mu));
        for (const double t : mu.derivative().roots(1))
          evidence.suspect = evidence.suspect || std::abs(mu(t)) < small;
      }
  }
  return evidence;
}

}  // namespace atrapos::path
