#include <algorithm>
#include <cmath>

#include <Tpetra_Vector.hpp>

#include "Augmented.hpp"
#include "Newton.hpp"
#include "Run.hpp"

namespace atrapos::path {

void Run::equilibrate() {
  State state = outcome_.final.copy();
  residual_ = calls_.residual(state, *r_).relative();
  if (!std::isfinite(residual_))
    throw PathError(EndReason::notFinite, "the residual at the start is not finite");
  if (residual_ <= (!tangent_ ? correctAbove() : applied_.empty() ? bound() : boundAtEvents())) return;
  constexpr int maxHalvings = 10;
  const auto result =
      newton(calls_, state, *r_, holdLoad(), correctAbove(), options_.maxStartIterations, maxHalvings);
  outcome_.startIterations = result.iterations;
  if (!result.converged)
    throw PathError(EndReason::startNotInEquilibrium,
                    line("no equilibrium found at the start, lambda = ", state.lambda, ": ", result.trouble,
                         " (relative residual ", result.residual, ')'));
  residual_ = result.residual;
  outcome_.final = calls_.settled(state);
}

/// The direction at a step's end, once by the derivative of the series that led there and once by the tangent
/// found there, is the same to the accuracy of that derivative, unless the two lie on different branches.
bool Run::directionAgrees(const Series& series, const PathTangent& previous) const {
  if (order_ < 3) return true;  // a straight or parabolic step may turn by any angle
  if (!last_) return true;      // a direction given at the start says the sense only
  // Of the unknowns alone: which internal variables take part may differ from series to series.
  const Augmented before{previous.x.u, previous.lambda};
  const Augmented now{series.coefficient(1).u, series.lambdaCoefficient(1)};
  const auto inner = [&](const Augmented& x, const Augmented& y) {
    return dot(calls_.problem(), x, y, series.weight());
  };
  return inner(now, before) > options_.minCosine * std::sqrt(inner(before, before) * inner(now, now));
}

/// The pending step ends half as far along its series. False where it was shortened often enough.
bool Run::retreat() {
  constexpr int maxRetreats = 4;
  if (!pending_ || pending_->retreats == maxRetreats) return false;
  StepReport report = std::move(*pending_);
  Trial trial;
  trial.a = rounded(0.5 * report.length);
  if (trial.a < options_.minStep) {
    pending_ = std::move(report);
    return false;
  }
  evaluate(*last_, trial);
  ++report.retreats;
  ++outcome_.retreats;
  --outcome_.steps;
  outcome_.corrections -= report.corrections;  // counted again by accept
  outcome_.cutBacks -= report.cutBacks;
  // Two branches are near, and the residual is what turns the path from one to the other.
  constexpr double sharper = 1e-4;
  correct(*last_, trial, report, sharper * correctAbove());
  accept(std::move(trial), std::move(report), Series(std::move(*last_)));
  return true;
}

Series Run::nextSeries(StepReport& report) {
  // Not empty here: events were applied at this very state before the path was interrupted.
  const bool restarted = !applied_.empty();
  Series series = !due_.empty() ? seriesAfterEvents(report)
                  : restarted   ? seriesAfterRestart()
                                : smoothSeries(report);
  for (auto due = overdue(series); !due.empty(); due = overdue(series)) {
    ++outcome_.eventTrials;
    ++report.restarts;
    due_ = due;
    series = seriesAfterEvents(report);
  }
  return series;
}

Series Run::smoothSeries(StepReport& report) {
  for (int attempt = 1;;) {
    SeriesRequest request;
    relaxOver_ = options_.relaxResidual ? lastLength_ : 0;
    if (relaxOver_ > 0) {
      request.residual = r_.get();
      request.relaxOver = relaxOver_;
    }
    try {
      Series series = seriesTo(request, {});
      if (!tangent_ || directionAgrees(series, *tangent_)) return series;
    } catch (const PathError& error) {
      if (error.reason() != EndReason::singularTangent) throw;
      stepOverSingularity(error, attempt);
      ++attempt;
      ++report.restarts;
      continue;
    }
    if (!retreat())
      throw PathError(EndReason::directionLost,
                      line("at lambda = ", outcome_.final.lambda,
                           ": the path's direction at the end of a step is not that of its series, and "
                           "shorter steps do not help"));
  }
}

/// One Newton iteration where the path has reached its stop, with the factorization made for the inertia
/// there: the state that is looked at most is better than the bound asks. A path that goes on from a limit of
/// steps must not differ from one that was not interrupted, so not there.
void Run::polishEnd(const RCP<Vector>& Uhat) {
  constexpr double wanted = 1e-2;
  if (!stop_ || !pending_ || !due_.empty() || residual_ <= wanted * bound()) return;
  const Border border = borderAt(*last_, lastEnd_, stop_);
  auto x = calls_.newVector();
  calls_.solve(*r_, *x);
  const double dLambda = border.c(x) / (border.c(Uhat) + border.cLambda);
  x->update(dLambda, *Uhat, -1);
  State state = outcome_.final.at(copy(*outcome_.final.u), outcome_.final.lambda + dLambda);
  state.u->update(1, *x, 1);
  const double residual = calls_.residual(state, *r_).relative();
  if (!(residual < residual_)) return;
  outcome_.final = pending_->end = calls_.settled(state);
  pending_->lambdaEnd = state.lambda;
  residual_ = pending_->residual = residual;
}

/// The tangent at the path's end: its inertia, and the sense in which lambda goes on.
Run::EndTangent Run::closeEnd() {
  EndTangent tangent;
  auto F = calls_.newVector(), Uhat = calls_.newVector();
  ++outcome_.closings;
  try {
    calls_.factor(outcome_.final, *F);
    countHere(tangent);
    tangent.modes = modesHere(*tangent_, last_->weight());
    calls_.solve(*F, *Uhat);
    const Increment hat{Uhat, std::vector<double>(tangent_->x.internal.size(), 0.0)};
    const double w = last_->weight(), along = w * calls_.problem().inner(hat, tangent_->x) + tangent_->lambda;
    tangent.lambda1 = std::copysign(1 / std::sqrt(1 + w * calls_.problem().inner(hat, hat)), along);
    polishEnd(Uhat);
  } catch (const PathError&) {
    tangent.inertia.reset();  // singular at the very end: signs are not known there
  }
  return tangent;
}

}  // namespace atrapos::path
