#include "RationalStep.hpp"

#include <algorithm>
#include <cmath>

#include <Tpetra_Vector.hpp>

#include "PathUnderWay.hpp"
#include "Rounded.hpp"
#include "StepLength.hpp"
#include "atrapos/linear/Dot.hpp"

namespace atrapos::path {

/// Whether the step may have a rational form.
bool RationalStep::isTried() const {
  return path_.options.pade != PadeUse::off && path_.order >= 4 && !path_.endsEarly(series_) &&
         !series_.standsStill() && !series_.hidesGrowth();
}

/// The rational form, and how far it may go: as long as two successive fractions agree, and not past places
/// that a long step would not see.
PadeFit RationalStep::fit(const std::vector<Mode>& modes, double polynomial) const {
  // Where two fractions differ by more than that neither is believed, however loose the accuracy asked for.
  constexpr double loosest = 1e-3;
  PadeFit fit =
      fitPade(path_.calls.problem(), series_, std::min(path_.options.delta, loosest), path_.longestLength());
  // Where an eigenvalue of the tangent is about to vanish, or just has, other branches may be near, and a
  // long step would see nothing of them: there the polynomial, which its radius bounds, goes. Not at limit
  // points, where the null vector is the path's direction. A step that ends short of the point leaves the
  // next one room to pass it.
  constexpr double shortOf = 0.75, behind = -0.2, alongPath = 0.7;
  const auto& direction = *series_.coefficient(1).u;
  for (const Mode& mode : modes) {
    if (std::abs(linear::dot(*mode.x, direction)) > alongPath * direction.norm2()) continue;
    const double zero = -mode.mu / mode.rate;  // no bound where the rate is not known
    if (zero > behind * polynomial && shortOf * zero < fit.range) fit.range = std::max(0.0, shortOf * zero);
  }
  return fit;
}

/// Whether the polynomial's residual passes at a.
bool RationalStep::polynomialReaches(double a) const {
  const auto form = series_.form();
  series_.setForm(nullptr);
  Trial trial;
  trial.a = a;
  evaluate(path_, series_, trial);
  series_.setForm(form);
  return trial.residual <= path_.correctAbove();
}

/// The longest end along the form that the series has, above `shortest`; one up to `least` only where the
/// polynomial does not reach it.
std::optional<Trial> RationalStep::alongFit(double range, double shortest, double least) const {
  const double correctAbove = path_.correctAbove();
  constexpr int maxTrials = 4;
  Trial trial;
  trial.a = rounded(range);
  for (int i = 0; i < maxTrials && trial.a > shortest; ++i) {
    limit(path_, series_, trial);
    evaluate(path_, series_, trial);
    Trial inside;
    inside.a = 0.7 * trial.a;
    if (trial.residual <= correctAbove) evaluate(path_, series_, inside);
    if (trial.residual <= correctAbove && inside.residual <= path_.bound() && !astray(path_, trial)) {
      if (trial.a <= least && polynomialReaches(trial.a)) break;
      return trial;
    }
    ++report_.cutBacks;
    const double residual = std::max(trial.residual, inside.residual);
    trial.a = rounded(shorterBy(path_, trial.a, residual, series_.order()) * trial.a);
  }
  return std::nullopt;
}

std::optional<Trial> RationalStep::trial(const std::vector<Mode>& modes, PadePatience& patience) const {
  if (!isTried()) return std::nullopt;
  const bool automatic = path_.options.pade == PadeUse::automatic;
  if (automatic && patience.rests()) return std::nullopt;
  const double polynomial = firstLength(path_, report_.radius);
  // A stop or an event that the polynomial reaches needs nothing longer.
  Trial near;
  near.a = polynomial;
  limit(path_, series_, near);
  if (near.stop || !near.events.empty()) {
    evaluate(path_, series_, near);
    if (near.residual <= path_.correctAbove()) {
      if (astray(path_, near)) return std::nullopt;
      return near;
    }
  }
  // Shorter gains do not pay for the fit, which costs about as much as one order. The bound of the residual
  // may leave the polynomial less than half of what its radius promises.
  const double least = (automatic ? 1.1 : 1.0) * polynomial, shortest = 0.4 * polynomial;
  const PadeFit rational = fit(modes, polynomial);
  report_.padeRange = rational.range;
  if (rational.usable() && rational.range > shortest) {
    series_.setForm(rational.form);
    if (auto found = alongFit(rational.range, shortest, least)) {
      patience.helped();
      report_.pade = true;
      return found;
    }
    series_.setForm(nullptr);
  }
  patience.failed();
  return std::nullopt;
}

}  // namespace atrapos::path
