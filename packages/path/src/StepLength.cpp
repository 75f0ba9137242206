#include "StepLength.hpp"

#include <algorithm>
#include <cmath>

#include <Tpetra_Vector.hpp>

#include "Line.hpp"
#include "PathUnderWay.hpp"
#include "PolynomialStep.hpp"
#include "RationalStep.hpp"
#include "Rounded.hpp"

namespace atrapos::path {

namespace {

/// The tangent is singular at a limit point of lambda: a step that would end on one by chance ends before it.
void keepClearOfLimitPoints(const PathUnderWay& path, const Series& series, Trial& trial) {
  if (trial.stop || !trial.events.empty()) return;
  constexpr double near = 1e-3, before = 0.9;
  for (const double root : series.lambdaFunction().derivative().roots((1 + near) * trial.a))
    if (root > (1 - near) * trial.a) {
      trial.a = rounded(before * root);
      evaluate(path, series, trial);
      return;
    }
}

/// Whether lambda alone goes from the path's start to its stop, with no event functions that could say that
/// something is to come.
bool hasNoEffect(const PathUnderWay& path, const Series& series, const Trial& trial) {
  return series.standsStill() && trial.stop && !path.here.tangent && path.calls.problem().eventCount() == 0;
}

/// Whether lambda alone goes on, by the longest step there is, with nothing ahead that could end that.
bool goesNowhere(const PathUnderWay& path, const Series& series, const Trial& trial) {
  if (!series.standsStill() || trial.stop || !trial.events.empty()) return false;
  const double rate = series.lambdaCoefficient(1);
  const auto& stops = path.stops;
  return trial.a >= rounded(path.options.maxStep.value_or(defaultMaxStep)) &&
         !std::isfinite(stops.pathLength) &&
         std::none_of(stops.loadFactors.begin(), stops.loadFactors.end(),
                      [&](double stop) { return (stop - path.here.state.lambda) * rate > 0; });
}

}  // namespace

Trial acceptedTrial(const PathUnderWay& path, Series& series, StepReport& report,
                    const std::vector<Mode>& modes, PadePatience& patience) {
  auto rational = RationalStep(path, series, report).trial(modes, patience);
  Trial trial = rational ? std::move(*rational) : PolynomialStep(path, series, report).trial();
  keepClearOfLimitPoints(path, series, trial);
  if (hasNoEffect(path, series, trial))
    throw PathError(EndReason::loadWithoutEffect,
                    line("the load parameter does not move the unknowns from lambda = ",
                         path.here.state.lambda, " to ", trial.state.lambda));
  if (goesNowhere(path, series, trial))
    throw PathError(EndReason::loadWithoutEffect,
                    line("from lambda = ", path.here.state.lambda,
                         " on the load parameter moves nothing, and neither an event nor a stop lies ahead"));
  return trial;
}

double firstLength(const PathUnderWay& path, double radius) {
  const double last = path.here.lastLength;
  if (path.order == 1)  // no estimate, nothing to round
    return last > 0 ? std::min(2 * last, path.longestLength()) : path.options.firstStep;
  return rounded(std::min(radius, path.longestLength()));
}

double shorterBy(const PathUnderWay& path, double a, double residual, int order) {
  if (!std::isfinite(residual)) return 0.5;
  const double start = path.here.startPart(a);
  const double truncation = residual - start;
  const double room = 0.5 * (path.correctAbove() - start);
  if (truncation <= 0 || room <= 0) return 0.5;
  return std::clamp(std::pow(room / truncation, 1.0 / (order + 1)), 0.1, 0.9);
}

}  // namespace atrapos::path
