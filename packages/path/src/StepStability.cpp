#include "StepStability.hpp"

#include <algorithm>
#include <cstdlib>

#include <Tpetra_Vector.hpp>

#include "Critical.hpp"
#include "Hopf.hpp"
#include "Stability.hpp"
#include "atrapos/linear/Determinant.hpp"

namespace atrapos::path {

StepStability::StepStability(PathUnderWay& path, const Start& start)
    : path_(path), counted_(start.expectedNegative) {
  for (const auto& e : start.eigenvalues) start_.modes.push_back({e.vector, e.value, e.rate});
}

void StepStability::tell(Start& next) const {
  next.expectedNegative = expected_;
  for (const Mode& m : start_.modes) next.eigenvalues.push_back({m.x, m.mu, m.rate});
}

EndTangent StepStability::tangentHere(const PathTangent& along, double weight) {
  EndTangent tangent;
  count(tangent);
  tangent.modes = modes(along, weight);
  return tangent;
}

/// The eigenvalues next to zero.
std::vector<Mode> StepStability::modes(const PathTangent& along, double weight) const {
  const Options& options = path_.options;
  Calls& calls = path_.calls;
  if (!options.criticalPoints || options.watchedModes == 0) return {};
  if (!calls.problem().symmetric() || !calls.inertia()) return {};
  try {
    return nearestModes(calls, path_.here.state, along, weight, start_.modes, options.watchedModes,
                        Rates::soon);
  } catch (const PathError&) {
    return {};  // next to a singular tangent: the numbers are beyond use
  }
}

/// Negative eigenvalues: the inertia, or a count of those next to zero where the tangent is not symmetric.
void StepStability::count(EndTangent& tangent) {
  const Options& options = path_.options;
  Calls& calls = path_.calls;
  tangent.inertia = calls.inertia();
  if (calls.problem().symmetric() || !options.criticalPoints || options.watchedModes == 0) return;
  tangent.determinant = linear::determinantSign(calls.solver());
  // As many as were unstable at the last step's start, and those that may follow.
  expected_ = counted_;
  const bool hopf = options.hopfEigenvalues > 0;
  const int wanted = std::max(expected_ + options.watchedModes + 1, options.hopfEigenvalues);
  try {
    if (auto unstable = countUnstable(calls, path_.here.state, wanted, problem())) {
      counted_ = unstable->all;
      tangent.inertia = linear::Inertia{unstable->all, 0};
      tangent.real = unstable->real;
      if (hopf) tangent.spectrum = std::move(unstable->nearest);
    }
  } catch (const PathError&) {
    // Next to a singular tangent: the numbers are beyond use.
  }
  tangent.uncounted = !tangent.inertia;
}

void StepStability::explain(StepReport& report, const EndTangent& end, Observer& observer) {
  locateBifurcations(report, end, observer);
  locateHopfPoints(report, end);
}

/// Eigenvalues that changed sign inside the step are those of its limit points, or there are bifurcation
/// points.
///
/// Along the path det [K, -F; w X_1^T, lambda_1] = det K / lambda_1 changes sign where an odd number of
/// eigenvalues is lost other than at a limit point of lambda; this holds on a branch that leaves a pitchfork
/// too, where no eigenvalue of K changes sign but lambda_1 does.
void StepStability::locateBifurcations(StepReport& report, const EndTangent& end, Observer& observer) {
  const Options& options = path_.options;
  const Series& series = path_.last->series;
  const PathTangent& tangentEnd = *path_.here.tangent;
  const auto before = start_.parity(), after = end.parity();
  if (!options.criticalPoints || !before || !after) return;
  const std::vector<CountedPlace> counts{{0, *before, series.lambdaCoefficient(1) > 0},
                                         {report.length, *after, end.lambda1 > 0}};
  const long long limits = static_cast<long long>(report.limitPoints.size());
  // Of an unsymmetric tangent a conjugate pair may cross the imaginary axis, which is no critical point: two
  // more prove nothing, an odd number does, and real ones are a reason to look.
  const bool symmetric = path_.calls.problem().symmetric();
  const bool counted = start_.inertia && end.inertia;
  const long long realChange = symmetric || !counted ? 0 : std::abs(end.real - start_.real);
  const int needed =
      symmetric ? provenBetween(counts[0], counts[1], report.limitPoints) : oddBetween(counts[0], counts[1]);
  // What the eigenvalues followed say beyond the count, in which two may cancel.
  const double w = series.weight();
  const std::vector<ModeSample> samples{{0, speedOf(series.tangent(0), w), start_.modes},
                                        {report.length, speedOf(tangentEnd, w), end.modes}};
  const auto evidence = bifurcationZeros(series, report.length, samples, report.limitPoints);
  const int suspected = static_cast<int>(
      std::max<long long>(static_cast<long long>(evidence.zeros.size()), realChange - limits));
  const int signChanges = std::max(needed, suspected);
  if (signChanges == 0 && !evidence.suspect && !options.searchEveryStep) return;
  CriticalSearch search{series, report.length, path_.here.state, tangentEnd, path_.order};
  search.signChanges = signChanges;
  search.certain = needed;
  search.residualBound = options.residualBound;
  search.samples = samples;
  search.limits = report.limitPoints;
  search.watchedModes = options.watchedModes;
  search.counts = counts;
  search.counted = problem();
  search.observer = &observer;
  CriticalFound found = findCriticalPoints(path_.calls, search);
  path_.outcome.criticalFactorizations += found.factorizations;
  report.unexplained = needed;
  for (const auto& point : found.points) report.unexplained -= point.nullity;
  report.unexplained = std::max(report.unexplained, 0);
  report.criticalPoints = std::move(found.points);
  for (auto& point : report.criticalPoints) {
    point.stepLength = report.length;
    point.fieldSizes = path_.fieldSizes.sizes();
    if (point.kind == CriticalKind::multiple)
      point.negativeChange = *after > *before ? point.nullity : -point.nullity;
  }
}

/// Pairs that have crossed the imaginary axis inside the step.
void StepStability::locateHopfPoints(StepReport& report, const EndTangent& end) {
  if (start_.spectrum.empty() || end.spectrum.empty() || !report.inertia || !report.inertiaEnd) return;
  const int wanted = std::max(path_.options.hopfEigenvalues, static_cast<int>(end.spectrum.size()));
  HopfFound found = findHopfPoints(path_.calls, path_.last->series, {0, start_.spectrum},
                                   {report.length, end.spectrum}, wanted);
  path_.outcome.hopfFactorizations += found.factorizations;
  report.hopfPoints = std::move(found.points);
  // What neither these nor other points explain has crossed at a place that is not known.
  long long rest = report.inertiaEnd->negative - report.inertia->negative;
  long long others = static_cast<long long>(report.limitPoints.size());  // one each, of unknown sign
  for (const auto& point : report.hopfPoints) rest -= point.negativeChange;
  for (const auto& point : report.criticalPoints) {
    rest -= point.negativeChange;
    others += point.negativeChange == 0;
  }
  report.unexplained = std::max<int>(report.unexplained, static_cast<int>(std::abs(rest) - others));
}

}  // namespace atrapos::path
