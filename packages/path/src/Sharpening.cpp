#include "Sharpening.hpp"

#include <algorithm>
#include <cmath>

#include <Tpetra_Vector.hpp>

#include "Augmented.hpp"
#include "Critical.hpp"
#include "GeometricProgression.hpp"
#include "Newton.hpp"
#include "PathUnderWay.hpp"

namespace atrapos::path {

namespace {

/// Whether the series may be that of a path turned away by its residual: the steps shrink and the late terms
/// are a geometric progression; its pole, ahead or behind.
std::optional<double> progressionPole(const PathUnderWay& path, const Series& series) {
  // Nothing but what a restart knows: it has to decide the same.
  if (!path.options.criticalPoints || !path.here.tangent || series.eventCount() > 0 || path.endsEarly(series))
    return std::nullopt;
  constexpr double shrinks = 0.6, ratioBound = 1e-3, perpBound = 0.3;
  if (!(series.radius(path.options.delta) < shrinks * path.here.lastLength)) return std::nullopt;
  return geometricProgression(path.calls.problem(), series, ratioBound, perpBound);
}

double norm(const Problem& problem, const RCP<Vector>& x) {
  const Increment e{x, std::vector<double>(problem.internalCount(), 0.0)};
  return std::sqrt(problem.inner(e, e));
}

/// Whether a displacement of this size is a good part of what is seen in the series: order N of e / (1 -
/// a/a_c) is e / a_c^N. Else its cause is another.
bool explains(double size, const Series& series, double pole) {
  constexpr double share = 0.1;
  return size > share * series.norm(series.order()) * std::pow(std::abs(pole), series.order());
}

/// x - c y.
Increment without(const Increment& x, double c, const Increment& y) {
  Increment rest{copy(*x.u), x.internal};
  rest.u->update(-c, *y.u, 1);
  for (std::size_t i = 0; i < rest.internal.size(); ++i) rest.internal[i] -= c * y.internal[i];
  return rest;
}

}  // namespace

bool sharpenState(PathUnderWay& path, const Series& series) {
  const Position& here = path.here;
  if (!path.pending || !here.due.empty() || !here.applied.empty()) return false;
  const auto pole = progressionPole(path, series);
  if (!pole) return false;
  Calls& calls = path.calls;
  const Problem& problem = calls.problem();
  const Border border = holdPathParameter(problem, series.weight(), *here.tangent);
  auto F = calls.newVector(), x1 = calls.newVector(), x2 = calls.newVector();
  State state = here.state.copy();
  auto r = copy(*here.r);
  double residual = here.residual, first = 0, size = 0;  // of corrections
  constexpr int maxIterations = 5;
  try {
    calls.tangent(state, *F);
    calls.solve(*F, *x2);
    for (int i = 0; i < maxIterations; ++i) {
      calls.solve(*r, *x1);
      const double dLambda = border.c(x1) / (border.c(x2) + border.cLambda);
      x1->update(dLambda, *x2, -1);
      const double before = size;
      size = norm(problem, x1);
      // Corrections tell, and not the residual, whose norm may be the rounding of other forces than those
      // along the null vector, which are small in a thin sheet.
      constexpr double falls = 0.1;  // less is rounding, or the tangent's own change
      if (i == 0 && !explains(size, series, *pole)) return false;
      if (i == 0)
        first = size;
      else if (!(size < falls * before))
        break;
      State trial = state.at(copy(*state.u), state.lambda + dLambda);
      trial.u->update(1, *x1, 1);
      auto left = calls.newVector();
      const double now = calls.residual(trial, *left).relative();
      if (!(now <= path.correctAbove())) break;
      state = trial;
      r = left;
      residual = now;
    }
  } catch (const PathError&) {
    return false;
  }
  constexpr double useful = 0.1;
  if (!(size < useful * first)) return false;
  path.improveEnd(state, r, residual);
  path.countCorrections(1);
  return true;
}

void clean(const PathUnderWay& path, Series& series) {
  if (!progressionPole(path, series)) return;
  constexpr double gains = 1.5;
  const double delta = path.options.delta, radius = series.radius(delta);
  const Problem& problem = path.calls.problem();
  const State& start = path.here.state;
  const int N = series.order();
  std::optional<Series> made;
  try {
    made = pathResponse(path.calls, start, *path.here.tangent, series.weight(), N);
  } catch (const PathError&) {
    return;  // so near the point that the response is beyond numbers: the series stays as it is
  }
  const Series& response = *made;
  if (!(response.norm(N) > 0)) return;
  const double c =
      problem.inner(series.coefficient(N), response.coefficient(N)) / (response.norm(N) * response.norm(N));
  Series cleaned(start, series.weight());
  for (int k = 1; k <= N; ++k) {
    Increment x = without(series.coefficient(k), c, response.coefficient(k));
    const double norm = std::sqrt(problem.inner(x, x));
    cleaned.append(std::move(x), series.lambdaCoefficient(k) - c * response.lambdaCoefficient(k), norm);
  }
  cleaned.takeMemory(series);
  const double longer = cleaned.radius(delta);
  if (!(longer > gains * radius)) return;
  // A real imperfection is larger than the bound and cannot be taken out.
  Trial trial;
  trial.a = std::min(longer, path.longestLength());
  evaluate(path, cleaned, trial);
  if (trial.residual > path.bound()) {
    trial.a *= 0.5;
    if (trial.a > gains * radius) evaluate(path, cleaned, trial);
  }
  if (trial.residual <= path.bound()) series = std::move(cleaned);
}

}  // namespace atrapos::path
