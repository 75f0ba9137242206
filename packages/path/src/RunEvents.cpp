#include <algorithm>
#include <cmath>
#include <limits>

#include <Tpetra_Vector.hpp>

#include "Run.hpp"

namespace atrapos::path {

namespace {

/// The event function without its value at the start where that is a known root.
Polynomial known(const Series& series, int i, const std::vector<int>& applied) {
  auto c = series.eventCoefficients(i);
  if (std::find(applied.begin(), applied.end(), i) != applied.end()) c[0] = 0;
  return Polynomial(std::move(c));
}

/// Whether a function that is zero at a = 0 rises in a sense (+1, -1), looked at on this length.
bool rises(const std::vector<double>& c, double sense, double length) {
  double size = 0, power = 1;
  for (const double x : c) {
    size = std::max(size, std::abs(x) * power);
    power *= length;
  }
  power = length;
  for (std::size_t k = 1; k < c.size(); ++k, power *= length)
    if (std::abs(c[k]) * power > 1e-9 * size) return (k % 2 == 1 ? sense : 1) * c[k] > 0;
  return true;  // stays zero: nothing is violated
}

}  // namespace

/// Shortens the trial to the first stop or event; those just behind its end are taken now, not by a tiny next
/// step.
void Run::limit(const Series& series, Trial& trial) const {
  const double end = 1.001 * trial.a;
  trial.events.clear();
  trial.stop = firstStop(stops_, series, outcome_.pathLength, end, !tangent_);
  constexpr double never = std::numeric_limits<double>::infinity();
  std::vector<double> at(series.eventCount(), never);  // where each falls through zero first
  for (int i = 0; i < series.eventCount(); ++i) {
    const Polynomial p = known(series, i, applied_);
    // Below zero at the start by what the residual bound allows, and falling: it is due at once.
    if (p.coefficients()[0] < 0 && !rises(p.coefficients(), 1, end)) {
      at[i] = 0;
      continue;
    }
    Rational g = series.scalar(p.coefficients());
    if (p.coefficients()[0] == 0) g = g.withoutRootAtZero();
    const auto slope = g.numerator().derivative();  // the root taken out at 0 does not change its sign
    for (const double a : g.roots(end))
      if (slope(a) <= 0) {
        at[i] = a;
        break;
      }
  }
  const double first = at.empty() ? never : *std::min_element(at.begin(), at.end());
  if (trial.stop && trial.stop->a < first) {
    trial.a = trial.stop->a;
  } else if (first <= end) {
    trial.stop.reset();
    trial.a = first;
    // Together by symmetry, though not to the last digit.
    constexpr double together = 1e-6;
    for (int i = 0; i < series.eventCount(); ++i)
      if (at[i] <= (1 + together) * first) trial.events.push_back(i);
  }
}

/// The Problem changes at the state. Of the functions that are zero there (`due_`) all are applied; where the
/// path then has no admissible sense, every other choice is tried. Admissible is the sense in which every
/// function that is zero here rises; it is not asked that the old direction is kept: where lambda then goes
/// the other way the path has a non-smooth limit point.
Series Run::seriesAfterEvents(StepReport& report) {
  std::vector<int> candidates;
  std::swap(candidates, due_);
  const int count = static_cast<int>(candidates.size());
  constexpr int mostTogether = 6;
  if (lastLength_ <= options_.minStep)
    ++standing_;
  else
    standing_ = 0;
  if (standing_ > 2 * calls_.problem().eventCount() + 4)
    throw PathError(EndReason::eventsCycle, line("at lambda = ", outcome_.final.lambda, ": ", standing_,
                                                 " events in a row without a step between them"));
  relaxOver_ = 0;
  SeriesRequest request;
  request.order = order_;
  request.weight = weight_;
  const unsigned choices = count <= mostTogether ? (1u << count) : 2u;
  for (unsigned left = 0; left + 1 < choices; ++left) {  // bits of `left`: candidates not applied
    std::vector<int> chosen;
    for (int i = 0; i < count; ++i)
      if (!(left & (1u << i))) chosen.push_back(candidates[i]);
    calls_.applyEvent(chosen, outcome_.final);
    residual_ = calls_.residual(outcome_.final, *r_).relative();
    try {
      if (!(residual_ <= 10 * bound()))
        throw PathError(EndReason::problemFailed,
                        line("at lambda = ", outcome_.final.lambda,
                             ": the state does not solve the problem as an event has changed it (relative "
                             "residual ",
                             residual_, ')'));
      const Series series = buildSeries(calls_, outcome_.final, request);
      const double reach = std::min(series.radius(options_.delta), options_.maxStep);
      for (const double sense : {1.0, -1.0}) {
        bool admissible = true;
        for (const int i : candidates)
          admissible = admissible && rises(series.eventCoefficients(i), sense, reach);
        if (!admissible) continue;
        Series chosenSeries = sense > 0 ? series : series.reversed();
        applied_ = candidates;
        ++outcome_.events;
        turned_ = tangent_ && (tangent_->lambda > 0) != (chosenSeries.lambdaCoefficient(1) > 0);
        if (pending_) pending_->events = chosen;
        return chosenSeries;
      }
    } catch (const PathError& error) {
      // A set of constraints that depend on each other, or a mechanism: another choice.
      if (error.reason() != EndReason::singularTangent) throw;
    }
    ++outcome_.eventTrials;
    ++report.restarts;
    calls_.applyEvent(chosen, outcome_.final);
  }
  throw PathError(EndReason::noAdmissibleDirection,
                  line("at lambda = ", outcome_.final.lambda, ": no choice among the ", count,
                       " event(s) there lets the path go on"));
}

}  // namespace atrapos::path
