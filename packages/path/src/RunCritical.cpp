#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <Tpetra_Vector.hpp>

#include "Critical.hpp"
#include "GeometricProgression.hpp"
#include "Hopf.hpp"
#include "Newton.hpp"
#include "Run.hpp"
#include "Stability.hpp"
#include "atrapos/linear/Determinant.hpp"

namespace atrapos::path {

/// Whether the series may be that of a path turned away by its residual: the steps shrink and the late terms
/// are a geometric progression; its pole, ahead or behind.
std::optional<double> Run::progressionPole(const Series& series) const {
  // Nothing but what a restart knows: it has to decide the same.
  if (!options_.criticalPoints || !tangent_ || series.eventCount() > 0 || endsEarly(series))
    return std::nullopt;
  constexpr double shrinks = 0.6, ratioBound = 1e-3, perpBound = 0.3;
  if (!(series.radius(options_.delta) < shrinks * lastLength_)) return std::nullopt;
  return geometricProgression(calls_.problem(), series, ratioBound, perpBound);
}

/// Next to a bifurcation point the residual of the state, an imperfection of the size of the bound, displaces
/// it by e = r / mu along the null vector, mu the eigenvalue that is about to vanish, which goes on as
/// e / (1 - a/a_c). Newton iterations with the factorization that the solver holds take it away. False where
/// the progression is another one or they do not help: all stays as it is. True: the state has moved a
/// little, and its series wants a factorization of its own, which counts as that of a correction.
bool Run::sharpenState(const Series& series) {
  if (!pending_ || !due_.empty() || !applied_.empty()) return false;
  const auto pole = progressionPole(series);
  if (!pole) return false;
  const auto& problem = calls_.problem();
  const Border border = holdPathParameter(problem, series.weight(), *tangent_);
  auto F = calls_.newVector(), x1 = calls_.newVector(), x2 = calls_.newVector();
  State state = outcome_.final.copy();
  auto r = copy(*r_);
  double residual = residual_;
  constexpr int maxIterations = 5;
  try {
    calls_.tangent(state, *F);
    calls_.solve(*F, *x2);
    for (int i = 0; i < maxIterations; ++i) {
      calls_.solve(*r, *x1);
      const double dLambda = border.c(x1) / (border.c(x2) + border.cLambda);
      x1->update(dLambda, *x2, -1);
      if (i == 0) {
        // Order N of e / (1 - a/a_c) is e / a_c^N: a good part of what is seen, or its cause is another.
        constexpr double share = 0.1;
        const Increment e{x1, std::vector<double>(problem.internalCount(), 0.0)};
        const double seen = series.norm(series.order()) * std::pow(std::abs(*pole), series.order());
        if (!(std::sqrt(problem.inner(e, e)) > share * seen)) return false;
      }
      State trial = state.at(copy(*state.u), state.lambda + dLambda);
      trial.u->update(1, *x1, 1);
      auto left = calls_.newVector();
      const double now = calls_.residual(trial, *left).relative();
      constexpr double falls = 0.1;  // less is rounding, or the tangent's own change
      if (!(now < falls * residual)) break;
      state = trial;
      r = left;
      residual = now;
    }
  } catch (const PathError&) {
    return false;
  }
  constexpr double useful = 0.1;  // the displacement falls as the residual does
  if (!(residual < useful * residual_)) return false;
  outcome_.final = pending_->end = calls_.settled(state);
  pending_->lambdaEnd = state.lambda;
  residual_ = pending_->residual = residual;
  r_ = r;
  ++pending_->corrections;
  ++outcome_.corrections;
  return true;
}

/// What a residual that cannot be corrected away does to the late terms is taken out by the small force that
/// makes the opposite progression; what is left passes the point. The residual, which that force enters,
/// decides about its length as about any other.
void Run::clean(Series& series) {
  if (!progressionPole(series)) return;
  constexpr double gains = 1.5;
  const double radius = series.radius(options_.delta);
  const auto& problem = calls_.problem();
  const int N = series.order();
  std::optional<Series> made;
  try {
    made = pathResponse(calls_, outcome_.final, *tangent_, series.weight(), N);
  } catch (const PathError&) {
    return;  // so near the point that the response is beyond numbers: the series stays as it is
  }
  const Series& response = *made;
  if (!(response.norm(N) > 0)) return;
  const double c =
      problem.inner(series.coefficient(N), response.coefficient(N)) / (response.norm(N) * response.norm(N));
  Series cleaned(outcome_.final, series.weight());
  for (int k = 1; k <= N; ++k) {
    Increment x{copy(*series.coefficient(k).u), series.coefficient(k).internal};
    x.u->update(-c, *response.coefficient(k).u, 1);
    for (std::size_t i = 0; i < x.internal.size(); ++i)
      x.internal[i] -= c * response.coefficient(k).internal[i];
    const double norm = std::sqrt(problem.inner(x, x));
    cleaned.append(std::move(x), series.lambdaCoefficient(k) - c * response.lambdaCoefficient(k), norm);
  }
  cleaned.takeMemory(series);
  const double longer = cleaned.radius(options_.delta);
  if (!(longer > gains * radius)) return;
  // A real imperfection is larger than the bound and cannot be taken out.
  Trial trial;
  trial.a = std::min(longer, longestLength());
  evaluate(cleaned, trial);
  if (trial.residual > bound()) {
    trial.a *= 0.5;
    if (trial.a > gains * radius) evaluate(cleaned, trial);
  }
  if (trial.residual <= bound()) series = std::move(cleaned);
}

/// The eigenvalues next to zero at the state, which the solver's factorization belongs to.
std::vector<Mode> Run::modesHere(const PathTangent& along, double weight) {
  if (!options_.criticalPoints || options_.watchedModes == 0) return {};
  if (!calls_.problem().symmetric() || !calls_.inertia()) return {};
  try {
    return nearestModes(calls_, outcome_.final, along, weight, start_.modes, options_.watchedModes,
                        Rates::soon);
  } catch (const PathError&) {
    return {};  // next to a singular tangent: the numbers are beyond use
  }
}

/// Negative eigenvalues of the tangent at the state, which the solver's factorization belongs to: its
/// inertia, or a count of those next to zero where it is not symmetric.
void Run::countHere(EndTangent& tangent) {
  tangent.inertia = calls_.inertia();
  if (calls_.problem().symmetric() || !options_.criticalPoints || options_.watchedModes == 0) return;
  tangent.determinant = linear::determinantSign(calls_.solver());
  // As many as were unstable at the last step's start, and those that may follow.
  expected_ = counted_;
  const bool hopf = options_.hopfEigenvalues > 0;
  const int count = std::max(expected_ + options_.watchedModes + 1, options_.hopfEigenvalues);
  try {
    const auto of = hopf ? EigenProblem::ofRates : EigenProblem::ofTangent;
    if (auto unstable = countUnstable(calls_, outcome_.final, count, of)) {
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

std::optional<long long> Run::EndTangent::parity() const {
  if (inertia) return inertia->null > 0 ? std::nullopt : std::make_optional(inertia->negative);
  return determinant ? std::make_optional<long long>(*determinant < 0) : std::nullopt;
}

/// Whether the load goes the other way at the pending step's end than at its start.
bool Run::loadTurned(const EndTangent& end) const {
  return (last_->lambdaCoefficient(1) > 0) != (end.lambda1 > 0);
}

/// Eigenvalues that changed sign inside the step are those of its limit points, or there are bifurcation
/// points.
///
/// Along the path det [K, -F; w X_1^T, lambda_1] = det K / lambda_1 changes sign where an odd number of
/// eigenvalues is lost other than at a limit point of lambda; this holds on a branch that leaves a pitchfork
/// too, where no eigenvalue of K changes sign but lambda_1 does.
void Run::explainStability(StepReport& report, const EndTangent& end) {
  const auto before = start_.parity(), after = end.parity();
  if (!options_.criticalPoints || !before || !after) return;
  const std::vector<CountedPlace> counts{{0, *before, last_->lambdaCoefficient(1) > 0},
                                         {report.length, *after, end.lambda1 > 0}};
  const long long limits = static_cast<long long>(report.limitPoints.size());
  // Of an unsymmetric tangent a conjugate pair may cross the imaginary axis, which is no critical point: two
  // more prove nothing, an odd number does, and real ones are a reason to look.
  const bool symmetric = calls_.problem().symmetric();
  const bool counted = start_.inertia && end.inertia;
  const long long realChange = symmetric || !counted ? 0 : std::abs(end.real - start_.real);
  const int needed =
      symmetric ? provenBetween(counts[0], counts[1], report.limitPoints) : oddBetween(counts[0], counts[1]);
  // What the eigenvalues followed say beyond the count, in which two may cancel.
  const double w = last_->weight();
  const std::vector<ModeSample> samples{{0, speedOf(last_->tangent(0), w), start_.modes},
                                        {report.length, speedOf(*tangent_, w), end.modes}};
  const auto evidence = bifurcationZeros(*last_, report.length, samples, report.limitPoints);
  const int suspected = static_cast<int>(
      std::max<long long>(static_cast<long long>(evidence.zeros.size()), realChange - limits));
  const int signChanges = std::max(needed, suspected);
  if (signChanges == 0 && !evidence.suspect && !options_.searchEveryStep) return;
  CriticalSearch search{*last_, report.length, outcome_.final, *tangent_, order_};
  search.signChanges = signChanges;
  search.certain = needed;
  search.residualBound = options_.residualBound;
  search.samples = samples;
  search.limits = report.limitPoints;
  search.watchedModes = options_.watchedModes;
  search.counts = counts;
  search.tell = [&](int located, int wanted) { observer_.onSearch(located, wanted); };
  CriticalFound found = findCriticalPoints(calls_, search);
  outcome_.criticalFactorizations += found.factorizations;
  report.unexplained = needed;
  for (const auto& point : found.points) report.unexplained -= point.nullity;
  report.unexplained = std::max(report.unexplained, 0);
  report.criticalPoints = std::move(found.points);
  for (auto& point : report.criticalPoints) {
    point.stepLength = report.length;
    point.fieldSizes = fieldSizes_.sizes();
    if (point.kind == CriticalKind::multiple)
      point.negativeChange = *after > *before ? point.nullity : -point.nullity;
  }
}

/// Pairs that have crossed the imaginary axis inside the step. The solver's factorization is another one
/// afterwards.
void Run::locateHopfPoints(StepReport& report, const EndTangent& end) {
  if (start_.spectrum.empty() || end.spectrum.empty() || !report.inertia || !report.inertiaEnd) return;
  const int count = std::max(options_.hopfEigenvalues, static_cast<int>(end.spectrum.size()));
  HopfFound found =
      findHopfPoints(calls_, *last_, {0, start_.spectrum}, {report.length, end.spectrum}, count);
  outcome_.hopfFactorizations += found.factorizations;
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
