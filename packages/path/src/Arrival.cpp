#include "Arrival.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Tpetra_Vector.hpp>

namespace atrapos::path {

namespace {

/// Where the load of a step has the value it has at a point, and where it turns.
std::vector<double> placesToLook(double load, const StepReport& report, const Series& series) {
  const Rational lambda = series.lambdaFunction();
  std::vector<double> places = lambda.numerator().plus(-load, lambda.denominator()).roots(report.length);
  for (const LimitPoint& limit : report.limitPoints) places.push_back(limit.a);
  return places;
}

}  // namespace

std::optional<Augmented> turnedBeside(const Problem& problem, const CriticalPoint& known,
                                      const StepReport& report, const Series& series) {
  if (known.kind != CriticalKind::pitchfork || known.nullity != 1) return std::nullopt;
  const double w = series.weight();
  const auto length = [&](const Augmented& x) { return std::sqrt(dot(problem, x, x, w)); };
  const auto alike = [&](const Augmented& x, const Augmented& y) {
    // On the branch's side of the point rather than on the path's. No more, as the turn has its breadth.
    constexpr double half = 0.5;
    return std::abs(dot(problem, x, y, w)) > half * length(x) * length(y);
  };
  // The residual r, of a balance, holds the branch off by a part of its way that goes as r^(1/3): 1.5e-3 of
  // that for the wrinkles of a sheet, and 9 for a branch that ended a step on its way through the point,
  // which the next step found.
  constexpr double part = 0.05;
  const double reach =
      part * std::cbrt(std::max(report.residual, report.residualOfSeries)) * report.pathLengthEnd;
  for (const double a : placesToLook(known.state.lambda, report, series)) {
    Augmented gap{Teuchos::rcp(new Vector(known.state.u->getMap())), 0};
    gap.lambda = series.evaluate(a, *gap.u) - known.state.lambda;
    gap.u->update(-1, *known.state.u, 1);
    if (!(length(gap) < reach)) continue;
    const auto t = series.tangent(a);
    for (const PathTangent& branch : known.tangents) {
      // Only a branch whose load turns at the point can be turned off like that.
      constexpr double turns = 1e-4;
      const Augmented direction{branch.x.u, branch.lambda};
      if (std::abs(branch.lambda) < turns && alike(gap, direction) && alike({t.x.u, t.lambda}, direction))
        return gap;
    }
  }
  return std::nullopt;
}

}  // namespace atrapos::path
