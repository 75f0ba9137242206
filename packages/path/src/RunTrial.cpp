#include <algorithm>
#include <cmath>
#include <limits>

#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Vector.hpp>

#include "Newton.hpp"
#include "PadeFit.hpp"
#include "Run.hpp"
#include "atrapos/linear/Dot.hpp"

namespace atrapos::path {

/// What is left at a of the residual that the series started with.
double Run::startPart(double a) const {
  return relaxOver_ > 0 ? std::abs(1 - a / relaxOver_) * residual_ : residual_;
}

/// Beyond relaxOver_ the residual taken away comes back with the other sign: stay below half the bound.
double Run::longestLength() const {
  if (!(relaxOver_ > 0 && residual_ > 0)) return options_.maxStep;
  return std::min(options_.maxStep, relaxOver_ * (1 + 0.5 * bound() / residual_));
}

double Run::firstLength(double radius) const {
  if (order_ == 1)  // no estimate, nothing to round
    return lastLength_ > 0 ? std::min(2 * lastLength_, options_.maxStep) : options_.firstStep;
  return rounded(std::min(radius, longestLength()));
}

void Run::evaluate(const Series& series, Trial& trial) {
  trial.state = series.state(trial.a);
  if (trial.stop && trial.stop->kind == StopHit::Kind::loadFactor)  // but for the rounding of the root
    trial.state.lambda = stops_.loadFactors[trial.stop->index];
  trial.r = calls_.newVector();
  const ResidualNorm size = calls_.residual(trial.state, *trial.r);
  trial.residual = size.relative();
  if (calls_.problem().remembers())
    trial.residual = std::max(trial.residual, rateDefect(series, trial) / size.scale);
}

/// The forces of what the orders leave out of the internal variables. Equilibrium alone does not tell: the
/// truncated series may be in balance with one another. But K_T is made of the rates that the variables have
/// at the state, so K_T u' - F lambda' is the force of the difference between these rates and the series'
/// own, (K + 1) / a times that of the remainder.
double Run::rateDefect(const Series& series, const Trial& trial) {
  const PathTangent rate = series.tangent(trial.a);
  auto F = calls_.newVector(), defect = calls_.newVector();
  calls_.tangent(trial.state, *F)->apply(*rate.x.u, *defect);
  defect->update(-rate.lambda, *F, 1);
  return defect->norm2() * std::abs(trial.a) / (series.order() + 1);
}

/// Whether event functions at the trial's end are those of another piece than the state lies on.
bool Run::astray(const Trial& trial) {
  if (!calls_.hasPieces() || calls_.problem().eventCount() == 0) return false;
  std::vector<int> functions;
  for (const int i : trial.events)
    if (!isBreak(i)) functions.push_back(i);
  return calls_.eventsAstray(trial.state, functions);
}

/// Ends the trial at the last break before which nothing is wrong; false where there is none.
bool Run::endAtBreak(const Series& series, Trial& trial) {
  const std::vector<Break> all = calls_.breaks(series, trial.a);
  Trial best;
  // What is wrong behind a break stays wrong: the last good one is found by halving.
  for (std::size_t low = 0, high = all.size(); low < high;) {
    const std::size_t middle = (low + high) / 2;
    Trial at;
    at.a = all[middle].a;
    evaluate(series, at);
    if (at.residual <= bound() && !astray(at)) {
      best = std::move(at);
      low = middle + 1;
    } else {
      high = middle;
    }
  }
  if (best.a == 0) return false;
  constexpr double together = 1e-6;
  for (const Break& b : all)
    if (std::abs(b.a - best.a) <= together * best.a) best.events.push_back(b.index);
  trial = std::move(best);
  return true;
}

/// Factor for the next trial length: the truncation error of the residual grows like a^(K+1).
double Run::shorterBy(double a, double residual, int order) const {
  if (!std::isfinite(residual)) return 0.5;
  const double start = startPart(a);
  const double truncation = residual - start;
  const double room = 0.5 * (correctAbove() - start);
  if (truncation <= 0 || room <= 0) return 0.5;
  return std::clamp(std::pow(room / truncation, 1.0 / (order + 1)), 0.1, 0.9);
}

Run::Trial Run::acceptedTrial(Series& series, StepReport& report) {
  auto rational = padeTrial(series, report);
  Trial trial = rational ? std::move(*rational) : polynomialTrial(series, report);
  keepClearOfLimitPoints(series, trial);
  if (goesNowhere(series, trial))
    throw PathError(EndReason::loadWithoutEffect,
                    line("from lambda = ", outcome_.final.lambda,
                         " on the load parameter moves nothing, and neither an event nor a stop lies ahead"));
  return trial;
}

/// Whether lambda alone goes on, by the longest step there is, with nothing ahead that could end that.
bool Run::goesNowhere(const Series& series, const Trial& trial) const {
  if (!series.standsStill() || trial.stop || !trial.events.empty()) return false;
  const double rate = series.lambdaCoefficient(1);
  return trial.a >= rounded(options_.maxStep) && !std::isfinite(stops_.pathLength) &&
         std::none_of(stops_.loadFactors.begin(), stops_.loadFactors.end(),
                      [&](double stop) { return (stop - outcome_.final.lambda) * rate > 0; });
}

/// The tangent is singular at a limit point of lambda: a step that would end on one by chance ends before it.
void Run::keepClearOfLimitPoints(const Series& series, Trial& trial) {
  if (trial.stop || !trial.events.empty()) return;
  constexpr double near = 1e-3, before = 0.9;
  for (const double root : series.lambdaFunction().derivative().roots((1 + near) * trial.a))
    if (root > (1 - near) * trial.a) {
      trial.a = rounded(before * root);
      evaluate(series, trial);
      return;
    }
}

/// The rational form, and how far it may go: as long as two successive fractions agree, and not past places
/// that a long step would not see.
PadeFit Run::rationalForm(const Series& series, double polynomial) {
  // Where two fractions differ by more than that neither is believed, however loose the accuracy asked for.
  constexpr double loosest = 1e-3;
  PadeFit fit = fitPade(calls_.problem(), series, std::min(options_.delta, loosest), longestLength());
  // Where an eigenvalue of the tangent is about to vanish, or just has, other branches may be near, and a
  // long step would see nothing of them: there the polynomial, which its radius bounds, goes. Not at limit
  // points, where the null vector is the path's direction. A step that ends short of the point leaves the
  // next one room to pass it.
  constexpr double shortOf = 0.75, behind = -0.2, alongPath = 0.7;
  const auto& direction = *series.coefficient(1).u;
  for (const Mode& mode : start_.modes) {
    if (std::abs(linear::dot(*mode.x, direction)) > alongPath * direction.norm2()) continue;
    const double zero = -mode.mu / mode.rate;  // no bound where the rate is not known
    if (zero > behind * polynomial && shortOf * zero < fit.range) fit.range = std::max(0.0, shortOf * zero);
  }
  return fit;
}

/// Whether the polynomial's residual passes at a.
bool Run::polynomialReaches(Series& series, double a) {
  const auto form = series.form();
  series.setForm(nullptr);
  Trial trial;
  trial.a = a;
  evaluate(series, trial);
  series.setForm(form);
  return trial.residual <= correctAbove();
}

/// The end of the step by the rational form, where that goes further than the polynomial and its residual
/// passes, at the end and inside; or by the polynomial, where that reaches a stop or an event.
std::optional<Run::Trial> Run::padeTrial(Series& series, StepReport& report) {
  if (options_.pade == PadeUse::off || order_ < 4 || endsEarly(series) || series.standsStill() ||
      series.hidesGrowth())
    return std::nullopt;
  const bool automatic = options_.pade == PadeUse::automatic;
  if (automatic && padeWait_ > 0) {
    --padeWait_;
    return std::nullopt;
  }
  const double polynomial = firstLength(report.radius);
  // A stop or an event that the polynomial reaches needs nothing longer.
  Trial near;
  near.a = polynomial;
  limit(series, near);
  if (near.stop || !near.events.empty()) {
    evaluate(series, near);
    if (near.residual <= correctAbove()) {
      if (astray(near)) return std::nullopt;
      return near;
    }
  }
  // Shorter gains do not pay for the fit, which costs about as much as one order. The bound of the residual
  // may leave the polynomial less than half of what its radius promises.
  const double least = (automatic ? 1.1 : 1.0) * polynomial, shortest = 0.4 * polynomial;
  const PadeFit fit = rationalForm(series, polynomial);
  report.padeRange = fit.range;
  if (fit.usable() && fit.range > shortest) {
    series.setForm(fit.form);
    constexpr int maxTrials = 4;
    Trial trial;
    trial.a = rounded(fit.range);
    for (int i = 0; i < maxTrials && trial.a > shortest; ++i) {
      limit(series, trial);
      evaluate(series, trial);
      Trial inside;
      inside.a = 0.7 * trial.a;
      if (trial.residual <= correctAbove()) evaluate(series, inside);
      if (trial.residual <= correctAbove() && inside.residual <= bound() && !astray(trial)) {
        if (trial.a <= least && polynomialReaches(series, trial.a)) break;
        padeFailures_ = 0;
        report.pade = true;
        return trial;
      }
      ++report.cutBacks;
      trial.a =
          rounded(shorterBy(trial.a, std::max(trial.residual, inside.residual), series.order()) * trial.a);
    }
    series.setForm(nullptr);
  }
  // The longer it has not helped, the longer it rests.
  padeFailures_ = std::min(padeFailures_ + 1, 4);
  padeWait_ = (1 << padeFailures_) - 2;
  return std::nullopt;
}

/// What keeps a residual up that would fall like a^(K+1) if the orders left out made it.
const char* Run::whyNotFalling(double residual, double ofLonger) const {
  if (!(residual > 0.3 * ofLonger)) return "";
  constexpr double ofRounding = 1e3;  // bounds are met to three digits where rounding is next to them
  return residual < ofRounding * bound()
             ? "; it does not fall with the step: rounding limits it, ask for a larger bound"
             : "; it does not fall with the step: forces change there in a way that the series does not know";
}

Run::Trial Run::polynomialTrial(const Series& series, StepReport& report) {
  Trial trial;
  trial.a = firstLength(report.radius);
  limit(series, trial);
  // Shortening the step a little is cheaper than a correction, which costs a factorization; tried once.
  constexpr double worthKeeping = 0.7;
  bool shortened = false;
  int trials = 0;
  double previous = std::numeric_limits<double>::infinity();  // residual of the longer trial before
  for (;;) {
    evaluate(series, trial);
    const bool wrong = astray(trial);
    if (trial.residual <= correctAbove() && !wrong) return trial;
    double ofSeries = trial.residual;
    if (calls_.hasPieces() && (wrong || trial.residual > bound())) {
      // Shortening cures what the truncated orders leave, not what another piece adds.
      const auto unused = calls_.newVector();
      ofSeries = calls_.residualOfSeries(trial.state, *unused).relative();
      if (ofSeries <= bound() && endAtBreak(series, trial)) {
        ++report.cutBacks;
        return trial;
      }
    }
    const double factor = shorterBy(trial.a, ofSeries, series.order());
    if (trial.residual <= bound() && !wrong) {
      const bool shorten = !shortened && !trial.stop && trial.events.empty() && factor >= worthKeeping &&
                           startPart(factor * trial.a) < correctAbove();
      if (!shorten || trials == options_.maxCutBacks) return trial;
      shortened = true;
    }
    const bool spent = trials == options_.maxCutBacks;
    if (spent || factor * trial.a < options_.minStep) {
      throw PathError(EndReason::stepTooSmall,
                      line("relative residual ", trial.residual, " at step length ", trial.a,
                           " is over the bound ", bound(), " (lambda = ", outcome_.final.lambda, ", ",
                           spent ? "no trial left" : "shorter than minStep",
                           whyNotFalling(trial.residual, previous), ')'));
    }
    ++trials;
    ++report.cutBacks;
    previous = trial.residual;
    trial.a = rounded(factor * trial.a);
    limit(series, trial);
  }
}

/// What a correction of the end of a step keeps.
Border Run::borderAt(const Series& series, double a, const std::optional<StopHit>& stop) {
  if (!stop || stop->kind == StopHit::Kind::pathLength)
    return holdPathParameter(calls_.problem(), series.weight(), series.tangent(a));
  if (stop->kind == StopHit::Kind::loadFactor) return holdLoad();
  return holdFunctional(stops_.functionals[stop->index].weights);
}

void Run::correct(const Series& series, Trial& trial, StepReport& report, double above) {
  if (trial.residual <= above || options_.maxCorrections == 0) return;
  const Border border = borderAt(series, trial.a, trial.stop);
  // The state is under the bound already: where an iteration does not help, it stays as it is.
  const auto result = newton(calls_, trial.state, *trial.r, border, above, options_.maxCorrections,
                             /*maxHalvings*/ 0);
  report.corrections += result.iterations;
  trial.residual = result.residual;
}

}  // namespace atrapos::path
