#include "StepPoints.hpp"

#include <algorithm>
#include <cmath>

#include <Tpetra_Vector.hpp>

#include "PathUnderWay.hpp"

namespace atrapos::path {

namespace {

/// Whether f turns at a root of its derivative. The numerator of a fraction's derivative is a difference of
/// products, whose rounding far beyond the series' radius may look like a root, or move one a little.
bool turns(const Rational& f, double a, double length) {
  const double at = f(a), rounding = 1e-14 * f.magnitude(a);
  for (const double part : {1e-4, 1e-2}) {
    const double before = at - f(std::max(0.0, a - part * length));
    const double behind = f(std::min(length, a + part * length)) - at;
    if (std::abs(before) <= rounding || std::abs(behind) <= rounding || before * behind < 0) return true;
  }
  return false;
}

/// Whether the only limit point that a series shows in a step is none of the path. Passing one turns the load
/// and, the tangent being symmetric, changes the number of its negative eigenvalues by one. Where the load
/// hardly changes, as along a branch that has just left a bifurcation point, the residual that a series
/// leaves may look like one.
bool isOfTheSeriesAlone(const std::optional<linear::Inertia>& start,
                        const std::optional<linear::Inertia>& end) {
  return start && end && start->null == 0 && end->null == 0 && start->negative == end->negative;
}

/// Where on a step, as a part of it, the load turns by the tangents at its ends: next to a bifurcation point
/// the residual bends the end of a series, which may then not show what the corrected state has passed.
double turningOf(double atStart, double atEnd) { return atStart / (atStart - atEnd); }

}  // namespace

std::vector<LimitPoint> limitPointsOf(const PathUnderWay& path, const StepReport& report,
                                      const EndTangent* end) {
  const Series& series = path.last->series;
  const Position& here = path.here;
  std::vector<LimitPoint> points;
  const auto load = series.lambdaFunction();
  const auto slope = load.derivative();
  const auto curvature = slope.numerator().derivative();  // of the sign of lambda'' where lambda' = 0
  for (const double a : slope.roots(report.length))
    if (turns(load, a, report.length)) points.push_back({a, series.lambda(a), curvature(a) < 0, true});
  if (here.turned) points.push_back({report.length, report.lambdaEnd, here.tangent->lambda > 0, false});
  if (!end) return points;
  const double atStart = series.lambdaCoefficient(1), atEnd = end->lambda1;
  const bool loadTurned = (atStart > 0) != (atEnd > 0);
  if (points.size() == 1 && !loadTurned && isOfTheSeriesAlone(report.inertia, end->inertia)) points.clear();
  if (points.empty() && loadTurned) {
    const double a = turningOf(atStart, atEnd) * report.length;
    points.push_back({a, series.lambda(a), atEnd < 0, true});
  }
  return points;
}

std::vector<Extremum> extremaOf(const Series& series, double length, const std::vector<Monitor>& monitors) {
  std::vector<Extremum> extrema;
  for (int i = 0; i < static_cast<int>(monitors.size()); ++i) {
    const Rational value = series.functional(*monitors[i].weights);
    const Rational rate = value.derivative();
    const Polynomial bend = rate.numerator().derivative();
    for (const double a : rate.roots(length))
      if (turns(value, a, length)) extrema.push_back({i, a, series.lambda(a), value(a), bend(a) < 0});
  }
  std::sort(extrema.begin(), extrema.end(), [](const Extremum& x, const Extremum& y) { return x.a < y.a; });
  return extrema;
}

}  // namespace atrapos::path
