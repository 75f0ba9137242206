#include <Teuchos_CommHelpers.hpp>
#include <algorithm>
#include <cmath>

#include <Tpetra_Vector.hpp>

#include "Augmented.hpp"
#include "Newton.hpp"
#include "Run.hpp"

namespace atrapos::path {

void Run::equilibrate() {
  State state{copy(*outcome_.final.u), outcome_.final.lambda};
  residual_ = calls_.residual(state, *r_).relative();
  if (!std::isfinite(residual_))
    throw PathError(EndReason::notFinite, "the residual at the start is not finite");
  if (residual_ <= (tangent_ ? bound() : correctAbove())) return;
  constexpr int maxHalvings = 10;
  const auto result =
      newton(calls_, state, *r_, holdLoad(), correctAbove(), options_.maxStartIterations, maxHalvings);
  outcome_.startIterations = result.iterations;
  if (!result.converged)
    throw PathError(EndReason::startNotInEquilibrium,
                    line("no equilibrium found at the start, lambda = ", state.lambda, ": ", result.trouble,
                         " (relative residual ", result.residual, ')'));
  residual_ = result.residual;
  outcome_.final = state;
}

/// The largest entries of the null vector at the state, for a message: by inverse iteration with the tangent
/// of a state very near, which can be factored. Empty where that cannot be either.
std::string Run::nullVectorText() {
  State near{copy(*outcome_.final.u), outcome_.final.lambda};
  auto F = calls_.newVector(), x = calls_.newVector(), y = calls_.newVector();
  fillUnsymmetric(*x, 1);
  constexpr double aside = 1e-6;
  near.u->update(aside * std::max(1.0, near.u->normInf()), *x, 1);
  try {
    ++outcome_.restarts;
    calls_.factor(near, *F);
    for (int i = 0; i < 3; ++i) {
      calls_.solve(*x, *y);
      x->update(1 / y->norm2(), *y, 0);
    }
  } catch (const PathError&) {
    return "";
  }
  // All ranks say the same.
  const auto own = x->getData();
  std::vector<double> mine(x->getGlobalLength(), 0.0), data(mine.size());
  for (int i = 0; i < own.size(); ++i) mine[x->getMap()->getGlobalElement(i)] = own[i];
  Teuchos::reduceAll(*x->getMap()->getComm(), Teuchos::REDUCE_SUM, static_cast<int>(mine.size()), mine.data(),
                     data.data());
  std::vector<int> order(data.size());
  for (std::size_t i = 0; i < data.size(); ++i) order[i] = static_cast<int>(i);
  const int count = static_cast<int>(std::min<std::size_t>(3, data.size()));
  std::partial_sort(order.begin(), order.begin() + count, order.end(),
                    [&](int i, int j) { return std::abs(data[i]) > std::abs(data[j]); });
  std::string text = "; largest entries of its null vector: ";
  for (int i = 0; i < count; ++i)
    text += line(i > 0 ? ", " : "", "unknown ", order[i], " (", data[order[i]], ')');
  return text;
}

/// The tangent is singular at the state: go on a little along the last series and start there.
void Run::stepOverSingularity(const PathError& cause, int attempt) {
  const auto giveUp = [&](const std::string& why) {
    throw PathError(cause.reason(),
                    line("at lambda = ", outcome_.final.lambda, ": ", cause.what(), "; ", why));
  };
  if (!last_) giveUp("the path cannot start here" + nullVectorText());
  constexpr int maxAttempts = 3;
  if (attempt > maxAttempts) giveUp("stepping over it along the previous series did not help");
  // Small against the step, so that the residual, which grows like a^(K+1), hardly changes.
  const double shift = std::min(1e-3 * std::pow(4.0, attempt - 1) * lastLength_,
                                0.5 * (stops_.pathLength - outcome_.pathLength));
  Trial trial;
  trial.a = lastEnd_ + shift;
  evaluate(*last_, trial);
  if (!(trial.residual <= bound())) giveUp("the previous series does not reach past it");
  ++outcome_.restarts;
  lastEnd_ = trial.a;
  outcome_.pathLength += shift;
  outcome_.final = trial.state;
  residual_ = trial.residual;
  r_ = trial.r;
  tangent_ = last_->tangent(lastEnd_);
}

/// The direction at a step's end, once by the derivative of the series that led there and once by the tangent
/// found there, is the same to the accuracy of that derivative, unless the two lie on different branches.
bool Run::directionAgrees(const Series& series, const PathTangent& previous) const {
  if (order_ < 3) return true;  // a straight or parabolic step may turn by any angle
  if (!last_) return true;      // a direction given at the start says the sense only
  const auto& problem = calls_.problem();
  const double w = series.weight();
  const auto& x = series.coefficient(1);
  const double length2 = w * problem.inner(previous.x, previous.x) + previous.lambda * previous.lambda;
  const double along = w * problem.inner(x, previous.x) + series.lambdaCoefficient(1) * previous.lambda;
  const double own2 =
      w * series.norm(1) * series.norm(1) + series.lambdaCoefficient(1) * series.lambdaCoefficient(1);
  return along > options_.minCosine * std::sqrt(length2 * own2);
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
    request.order = order_;
    request.weight = weight_;
    request.direction = options_.direction;
    request.previous = tangent_ ? &*tangent_ : nullptr;
    relaxOver_ = options_.relaxResidual ? lastLength_ : 0;
    if (relaxOver_ > 0) {
      request.residual = r_.get();
      request.relaxOver = relaxOver_;
    }
    try {
      Series series = buildSeries(calls_, outcome_.final, request);
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

/// The tangent at the path's end: its inertia, and the sense in which lambda goes on.
Run::EndTangent Run::closeEnd() {
  EndTangent tangent;
  auto F = calls_.newVector(), Uhat = calls_.newVector();
  ++outcome_.closings;
  try {
    calls_.factor(outcome_.final, *F);
    tangent.inertia = calls_.inertia();
    tangent.modes = modesHere(*tangent_, last_->weight());
    calls_.solve(*F, *Uhat);
    const Increment hat{Uhat, std::vector<double>(tangent_->x.internal.size(), 0.0)};
    tangent.lambda1 = *weight_ * calls_.problem().inner(hat, tangent_->x) + tangent_->lambda;
  } catch (const PathError&) {
    tangent.inertia.reset();  // singular at the very end: signs are not known there
  }
  return tangent;
}

}  // namespace atrapos::path
