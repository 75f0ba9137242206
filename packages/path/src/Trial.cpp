#include "Trial.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Vector.hpp>

#include "EventSenses.hpp"
#include "PathUnderWay.hpp"

namespace atrapos::path {

namespace {

/// Where a function that is known by its growth begins to fall, on (0, end]: a root of its derivative behind
/// which it falls by what counts, on the way to `horizon` at least; infinity where it does not. What falls at
/// 0 has been looked at (overdue).
double endOfGrowth(const Rational& f, double end, double horizon, double negligible) {
  const std::vector<double> turns = f.derivative().roots(end);
  for (std::size_t t = 0; t < turns.size(); ++t) {
    const auto falls = [&](double to) { return f(turns[t]) - f(to) > negligible; };
    if (t + 1 < turns.size() ? falls(turns[t + 1]) : falls(1.5 * turns[t]) || falls(std::max(end, horizon)))
      return turns[t];
  }
  return std::numeric_limits<double>::infinity();
}

/// Where each event function falls through zero first on (0, end]; infinity where it does not, or is one of
/// `untold`. The step that is looked for is `horizon` long at most.
std::vector<double> falls(const Series& series, double end, double horizon, const std::vector<int>& zero,
                          const std::vector<int>& untold) {
  std::vector<double> at(series.eventCount(), std::numeric_limits<double>::infinity());
  for (int i = 0; i < series.eventCount(); ++i) {
    if (std::find(untold.begin(), untold.end(), i) != untold.end()) continue;
    const Polynomial p = eventPolynomial(series, i, zero);
    Rational g = series.scalar(p.coefficients());
    if (series.eventGrows(i)) {
      at[i] = endOfGrowth(g, end, horizon, series.negligibleFall(i));
      continue;
    }
    if (p.coefficients()[0] == 0) g = g.withoutRootAtZero();
    const auto slope = g.numerator().derivative();  // the root taken out at 0 does not change its sign
    for (const double a : g.roots(end))
      if (slope(a) <= 0) {
        at[i] = a;
        break;
      }
  }
  return at;
}

/// The forces of what the orders leave out of the internal variables. Equilibrium alone does not tell: the
/// truncated series may be in balance with one another. But K_T is made of the rates that the variables have
/// at the state, so K_T u' - F lambda' is the force of the difference between these rates and the series'
/// own, (K + 1) / a times that of the remainder.
double rateDefect(Calls& calls, const Series& series, const Trial& trial) {
  const PathTangent rate = series.tangent(trial.a);
  auto F = calls.newVector(), defect = calls.newVector();
  calls.tangent(trial.state, *F)->apply(*rate.x.u, *defect);
  defect->update(-rate.lambda, *F, 1);
  return defect->norm2() * std::abs(trial.a) / (series.order() + 1);
}

/// See below; without the events of the functions `untold`.
void limit(const PathUnderWay& path, const Series& series, Trial& trial, const std::vector<int>& zero,
           const std::vector<int>& untold) {
  trial.events.clear();
  trial.stop = firstStop(path.stops, series, path.here.pathLength, 1.001 * trial.a, !path.here.tangent);
  if (trial.stop) trial.a = trial.stop->a;
  if (series.eventCount() == 0) return;
  // Far beyond the radius (a series that all but terminates) the high orders are rounding and hide the roots:
  // what is found last lies within what was searched last.
  const double horizon = trial.a;
  double first = horizon;
  std::vector<double> at;
  for (double end = 1.001 * trial.a;; end = 1.001 * first) {
    at = falls(series, end, horizon, zero, untold);
    const double next = *std::min_element(at.begin(), at.end());
    if (!(next < 0.9 * first)) {
      first = next;
      break;
    }
    first = next;
  }
  const double end = trial.stop ? trial.a : 1.001 * trial.a;
  if (!(first <= end)) return;
  trial.stop.reset();
  trial.a = first;
  // Together by symmetry, though not to the last digit.
  constexpr double together = 1e-6;
  for (int i = 0; i < series.eventCount(); ++i)
    if (at[i] <= (1 + together) * first) trial.events.push_back(i);
  std::sort(trial.events.begin(), trial.events.end(), [&](int i, int j) { return at[i] < at[j]; });
  const auto isIn = [](const std::vector<int>& events, int i) {
    return std::find(events.begin(), events.end(), i) != events.end();
  };
  for (const int i : path.calls.eventsBeside(trial.events, series.state(first)))
    if (!isIn(trial.events, i) && !isIn(untold, i)) trial.events.push_back(i);
}

/// Those of a trial's events at which nothing happens: a function whose terms do not converge so far (the gap
/// at an extremum that runs away as the curvature changes sign) has roots that it has not, and others may
/// have nothing to tell there any more (Problem::eventMayBeNone). They are asked themselves.
std::vector<int> eventsThatAreNone(const PathUnderWay& path, const Series& series, const Trial& trial) {
  Calls& calls = path.calls;
  const auto& zero = path.here.applied;
  constexpr double nothing = 1e-2;  // of the size of a function
  std::vector<int> doubtful;
  for (const int i : trial.events)
    if (!path.isBreak(i) && !series.eventGrows(i) &&
        (calls.problem().eventMayBeNone(i) ||
         !converges(series.scalar(eventPolynomial(series, i, zero).coefficients()).numerator().coefficients(),
                    trial.a, 0.1 * nothing)))
      doubtful.push_back(i);
  if (doubtful.empty() || calls.problem().remembers()) return {};
  std::vector<double> g;
  try {
    calls.beginSeries(series.state(trial.a), path.order);
    g = calls.eventOrder(0);
  } catch (const PathError&) {
    g.assign(series.eventCount(), 0.0);  // beyond what the Problem knows: it stays an event
  }
  calls.beginSeries(path.here.state, path.order);  // its pieces are still asked for
  doubtful.erase(
      std::remove_if(
          doubtful.begin(), doubtful.end(),
          [&](int i) { return !(g[i] > nothing * sizeOfTerms(series.eventCoefficients(i), trial.a)); }),
      doubtful.end());
  return doubtful;
}

}  // namespace

void limit(const PathUnderWay& path, const Series& series, Trial& trial, const std::vector<int>& zero) {
  limit(path, series, trial, zero, {});
}

void limit(const PathUnderWay& path, const Series& series, Trial& trial) {
  const double wanted = trial.a;
  std::vector<int> untold;
  for (;;) {
    trial.a = wanted;
    limit(path, series, trial, path.here.applied, untold);
    const auto none = eventsThatAreNone(path, series, trial);
    if (none.empty()) return;
    untold.insert(untold.end(), none.begin(), none.end());
  }
}

void evaluate(const PathUnderWay& path, const Series& series, Trial& trial) {
  Calls& calls = path.calls;
  trial.state = series.state(trial.a);
  if (trial.stop && trial.stop->kind == StopHit::Kind::loadFactor)  // but for the rounding of the root
    trial.state.lambda = path.stops.loadFactors[trial.stop->index];
  trial.r = calls.newVector();
  const ResidualNorm size = calls.residual(trial.state, *trial.r);
  trial.residual = size.relative();
  if (calls.problem().remembers())
    trial.residual = std::max(trial.residual, rateDefect(calls, series, trial) / size.scale);
}

bool astray(const PathUnderWay& path, const Trial& trial) {
  if (!path.calls.hasPieces() || path.calls.problem().eventCount() == 0) return false;
  std::vector<int> functions;
  for (const int i : trial.events)
    if (!path.isBreak(i)) functions.push_back(i);
  return path.calls.eventsAstray(trial.state, functions);
}

void correct(const PathUnderWay& path, const Series& series, Trial& trial, StepReport& report, double above) {
  if (trial.residual <= above || path.options.maxCorrections == 0) return;
  const Border border = borderAt(path, series, trial.a, trial.stop);
  // The state is under the bound already: where an iteration does not help, it stays as it is.
  const auto result = newton(path.calls, trial.state, *trial.r, border, above, path.options.maxCorrections,
                             /*maxHalvings*/ 0);
  report.corrections += result.iterations;
  trial.residual = result.residual;
}

Border borderAt(const PathUnderWay& path, const Series& series, double a,
                const std::optional<StopHit>& stop) {
  if (!stop || stop->kind == StopHit::Kind::pathLength)
    return holdPathParameter(path.calls.problem(), series.weight(), series.tangent(a));
  if (stop->kind == StopHit::Kind::loadFactor) return holdLoad();
  return holdFunctional(path.stops.functionals[stop->index].weights);
}

}  // namespace atrapos::path
