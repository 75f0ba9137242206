#include "PolynomialStep.hpp"

#include <cmath>
#include <limits>

#include <Tpetra_Vector.hpp>

#include "Line.hpp"
#include "PathUnderWay.hpp"
#include "Rounded.hpp"
#include "StepLength.hpp"

namespace atrapos::path {

/// Ends the trial at the last break before which nothing is wrong; false where there is none.
bool PolynomialStep::endAtBreak(Trial& trial) const {
  const std::vector<Break> all = path_.calls.breaks(series_, trial.a);
  Trial best;
  // What is wrong behind a break stays wrong: the last good one is found by halving.
  for (std::size_t low = 0, high = all.size(); low < high;) {
    const std::size_t middle = (low + high) / 2;
    Trial at;
    at.a = all[middle].a;
    evaluate(path_, series_, at);
    if (at.residual <= path_.bound() && !astray(path_, at)) {
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

/// What keeps a residual up that would fall like a^(K+1) if the orders left out made it.
const char* PolynomialStep::whyNotFalling(double residual, double ofLonger) const {
  if (!(residual > 0.3 * ofLonger)) return "";
  constexpr double ofRounding = 1e3;  // bounds are met to three digits where rounding is next to them
  return residual < ofRounding * path_.bound()
             ? "; it does not fall with the step: rounding limits it, ask for a larger bound"
             : "; it does not fall with the step: forces change there in a way that the series does not know";
}

Trial PolynomialStep::trial() const {
  const Options& options = path_.options;
  const double bound = path_.bound(), correctAbove = path_.correctAbove();
  Trial trial;
  trial.a = firstLength(path_, report_.radius);
  limit(path_, series_, trial);
  // Shortening the step a little is cheaper than a correction, which costs a factorization; tried once.
  constexpr double worthKeeping = 0.7;
  bool shortened = false;
  int trials = 0;
  double previous = std::numeric_limits<double>::infinity();  // residual of the longer trial before
  for (;;) {
    evaluate(path_, series_, trial);
    const bool wrong = astray(path_, trial);
    if (trial.residual <= correctAbove && !wrong) return trial;
    double ofSeries = trial.residual;
    if (path_.calls.hasPieces() && (wrong || !(trial.residual <= bound))) {
      // Shortening cures what the truncated orders leave, not what another piece adds.
      const auto unused = path_.calls.newVector();
      ofSeries = path_.calls.residualOfSeries(trial.state, *unused).relative();
      if (ofSeries <= bound && endAtBreak(trial)) {
        ++report_.cutBacks;
        return trial;
      }
    }
    const double factor = shorterBy(path_, trial.a, ofSeries, series_.order());
    if (trial.residual <= bound && !wrong) {
      const bool shorten = !shortened && !trial.stop && trial.events.empty() && factor >= worthKeeping &&
                           path_.here.startPart(factor * trial.a) < correctAbove;
      if (!shorten || trials == options.maxCutBacks) return trial;
      shortened = true;
    }
    const bool spent = trials == options.maxCutBacks;
    if (spent || factor * trial.a < options.minStep)
      throw PathError(EndReason::stepTooSmall,
                      line("relative residual ", trial.residual, " at step length ", trial.a,
                           " is over the bound ", bound, " (lambda = ", path_.here.state.lambda, ", ",
                           spent ? "no trial left" : "shorter than minStep",
                           whyNotFalling(trial.residual, previous), ')'));
    ++trials;
    ++report_.cutBacks;
    previous = trial.residual;
    trial.a = rounded(factor * trial.a);
    limit(path_, series_, trial);
  }
}

}  // namespace atrapos::path
