#include <algorithm>
#include <cstdlib>

#include <Tpetra_Vector.hpp>

#include "Critical.hpp"
#include "Run.hpp"

namespace atrapos::path {

/// Eigenvalues that changed sign inside the step are those of its limit points, or there are bifurcation
/// points.
///
/// Along the path det [K, -F; w X_1^T, lambda_1] = det K / lambda_1 changes sign where an odd number of
/// eigenvalues is lost other than at a limit point of lambda; this holds on a branch that leaves a pitchfork
/// too, where no eigenvalue of K changes sign but lambda_1 does.
void Run::explainStability(StepReport& report, double lambda1) {
  if (!options_.criticalPoints || !report.inertia || !report.inertiaEnd) return;
  const auto before = *report.inertia, after = *report.inertiaEnd;
  if (before.null > 0 || after.null > 0) return;
  const long long change = std::llabs(after.negative - before.negative);
  const bool lambdaTurned = (last_->lambdaCoefficient(1) > 0) != (lambda1 > 0);
  const bool odd = (change % 2 != 0) != lambdaTurned;
  const long long limits = static_cast<long long>(report.limitPoints.size());
  const int needed = static_cast<int>(std::max(change - limits, odd ? 1LL : 0LL));
  if (needed == 0) return;
  CriticalFound found;
  try {
    found = findCriticalPoints(calls_, {*last_, report.length, outcome_.final, *tangent_, options_.order,
                                        needed, options_.residualBound});
  } catch (const PathError&) {
    // A state off the path that the problem or the solver refuses: nothing is confirmed.
  }
  outcome_.criticalFactorizations += found.factorizations;
  report.unexplained = needed;
  for (const auto& point : found.points) report.unexplained -= point.nullity;
  report.unexplained = std::max(report.unexplained, 0);
  report.criticalPoints = std::move(found.points);
  for (auto& point : report.criticalPoints) point.stepLength = report.length;
}

}  // namespace atrapos::path
