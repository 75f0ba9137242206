#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <set>

#include <Tpetra_Vector.hpp>

#include "Newton.hpp"
#include "Run.hpp"
#include "atrapos/linear/Dot.hpp"

namespace atrapos::path {

namespace {

/// max |c_k| length^k over k >= 1.
double size(const std::vector<double>& c, double length) {
  double largest = 0, power = length;
  for (std::size_t k = 1; k < c.size(); ++k, power *= length)
    largest = std::max(largest, std::abs(c[k]) * power);
  return largest;
}

/// Whether a function that is zero at a = 0, as its first derivatives are below `first`, rises in a sense
/// (+1, -1), looked at on this length; what is below `noise` counts as zero.
bool rises(const std::vector<double>& c, double sense, double length, double noise, std::size_t first = 1) {
  const double small = std::max(noise, 1e-9 * size(c, length));
  double power = std::pow(length, first);
  for (std::size_t k = first; k < c.size(); ++k, power *= length)
    if (std::abs(c[k]) * power > small) return (k % 2 == 1 ? sense : 1) * c[k] > 0;
  return true;  // stays zero: nothing is violated
}

/// Those of two sorted sets that are in one of them only.
std::vector<int> difference(const std::vector<int>& a, const std::vector<int>& b) {
  std::vector<int> d;
  std::set_symmetric_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(d));
  return d;
}

}  // namespace

Polynomial eventPolynomial(const Series& series, int i, const std::vector<int>& zero) {
  auto c = series.eventCoefficients(i);
  if (std::find(zero.begin(), zero.end(), i) != zero.end()) c[0] = 0;
  return Polynomial(std::move(c));
}

/// Where each event function falls through zero first on (0, end]; infinity where it does not.
std::vector<double> Run::falls(const Series& series, double end, const std::vector<int>& zero) const {
  std::vector<double> at(series.eventCount(), std::numeric_limits<double>::infinity());
  for (int i = 0; i < series.eventCount(); ++i) {
    const Polynomial p = eventPolynomial(series, i, zero);
    Rational g = series.scalar(p.coefficients());
    if (series.eventGrows(i))
      g = g.derivative();
    else if (p.coefficients()[0] == 0)
      g = g.withoutRootAtZero();
    const auto slope = g.numerator().derivative();  // the root taken out at 0 does not change its sign
    for (const double a : g.roots(end))
      if (slope(a) <= 0) {
        at[i] = a;
        break;
      }
  }
  return at;
}

/// Shortens the trial to the first stop or event; those just behind its end are taken now, not by a tiny next
/// step.
void Run::limit(const Series& series, Trial& trial, const std::vector<int>& zero) {
  trial.events.clear();
  trial.stop = firstStop(stops_, series, outcome_.pathLength, 1.001 * trial.a, !tangent_);
  if (trial.stop) trial.a = trial.stop->a;
  if (series.eventCount() == 0) return;
  // Far beyond the radius (a series that all but terminates) the high orders are rounding and hide the roots:
  // what is found last lies within what was searched last.
  double first = trial.a;
  std::vector<double> at;
  for (double end = 1.001 * trial.a;; end = 1.001 * first) {
    at = falls(series, end, zero);
    const double next = *std::min_element(at.begin(), at.end());
    if (!(next < 0.9 * first)) {
      first = next;
      break;
    }
    first = next;
  }
  const double end = trial.stop ? trial.a : 1.001 * trial.a;
  if (!(first <= end)) return;
  trial.stop.reset();
  trial.a = first;
  // Together by symmetry, though not to the last digit.
  constexpr double together = 1e-6;
  for (int i = 0; i < series.eventCount(); ++i)
    if (at[i] <= (1 + together) * first) trial.events.push_back(i);
  std::sort(trial.events.begin(), trial.events.end(), [&](int i, int j) { return at[i] < at[j]; });
  for (const int i : calls_.eventsBeside(trial.events, series.state(first)))
    if (std::find(trial.events.begin(), trial.events.end(), i) == trial.events.end())
      trial.events.push_back(i);
}

/// The candidates that fall along the series in this sense, ascending. A break falls where the series leaves
/// its piece. `flat`: those whose functions begin with their second derivatives.
std::vector<int> Run::falling(const Series& series, const std::vector<int>& candidates, double sense,
                              const std::vector<int>& flat) {
  const double reach = std::min(series.radius(options_.delta), options_.maxStep);
  const int functions = series.eventCount();
  double largest = 0;
  for (const int i : candidates)
    if (i < functions) largest = std::max(largest, size(series.eventCoefficients(i), reach));
  constexpr double rounding = 1e-12;
  // Far enough to tell the pieces apart, near enough for the sense that the path starts in.
  constexpr double ahead = 1e-3;
  Trial place;
  std::vector<int> violated;
  for (const int i : candidates) {
    if (i < functions) {
      const std::size_t first = std::binary_search(flat.begin(), flat.end(), i) ? 2 : 1;
      if (!rises(series.eventCoefficients(i), sense, reach, rounding * largest, first)) violated.push_back(i);
      continue;
    }
    if (place.state.u.is_null()) {
      const double a = sense * ahead * (std::isfinite(reach) ? reach : lastLength_);
      place.state = series.state(a);
    }
    if (!calls_.continues(place.state, i)) violated.push_back(i);
  }
  return violated;
}

/// Whether a stop lies between two states.
bool Run::passesStop(const State& from, const State& to) const {
  const auto between = [](double value, double a, double b) {
    return (value - a) * (value - b) <= 0 && a != b;
  };
  for (const double lambda : stops_.loadFactors)
    if (between(lambda, from.lambda, to.lambda)) return true;
  for (const StopFunctional& f : stops_.functionals)
    if (between(f.value, linear::dot(*f.weights, *from.u), linear::dot(*f.weights, *to.u))) return true;
  return false;
}

/// A break at which forces jump a little, or a contact that closes where a gap does: Newton corrections lead
/// on to the path beyond. Where forces that rise turn the state back over the border, its path begins a
/// little ahead. False, and nothing changed, where they jump by more than Options::jumpBound, the corrections
/// do not converge or would miss a stop.
bool Run::passJump() {
  if (!(residual_ <= options_.jumpBound)) return false;
  constexpr int maxIterations = 10, maxHalvings = 0;
  const bool along = tangent_ && weight_;
  const Border border = along ? holdPathParameter(calls_.problem(), *weight_, *tangent_) : holdLoad();
  for (const double ahead : {0.0, 1e-4, 1e-3}) {
    if (ahead > 0 && !along) break;
    State state = outcome_.final.copy();
    if (ahead > 0) {
      state.u->update(ahead * lastLength_, *tangent_->x.u, 1);
      state.lambda += ahead * lastLength_ * tangent_->lambda;
    }
    auto r = copy(*r_);
    const auto result = newton(calls_, state, *r, border, correctAbove(), maxIterations, maxHalvings);
    outcome_.corrections += result.iterations;
    if (pending_) pending_->corrections += result.iterations;
    if (!result.converged) continue;
    if (passesStop(outcome_.final, state)) return false;
    jump_ = residual_;
    outcome_.final = calls_.settled(state);
    r_ = r;
    residual_ = result.residual;
    return true;
  }
  return false;
}

/// The series of the Problem as it is, in the sense that led here; the functions `zero` are zero here,
/// `chosen` have just been applied.
Series Run::seriesOfChoice(const std::vector<int>& zero, const std::vector<int>& chosen) {
  relaxOver_ = 0;
  jump_ = 0;
  residual_ = calls_.residual(outcome_.final, *r_).relative();
  if (residual_ > bound() && !chosen.empty() && calls_.hasPieces()) passJump();
  if (options_.maxCorrections > 0)
    for (const int i : chosen)
      if (!isBreak(i) && correctWithEvent(i)) break;
  for (const int i : chosen)
    if (!(residual_ <= boundAtEvents()) && isBreak(i))
      throw PathError(EndReason::problemFailed,
                      line("at lambda = ", outcome_.final.lambda, ": ", calls_.breakText(i)));
  // What the orders left out of an event function, the gap of a contact that closes, is a residual that
  // corrections take away; more is another state.
  constexpr double largest = 1e-2;
  if (!(residual_ <= (options_.maxCorrections > 0 ? std::max(boundAtEvents(), largest) : boundAtEvents())))
    throw PathError(EndReason::problemFailed,
                    line("at lambda = ", outcome_.final.lambda,
                         ": the state does not solve the problem as an event has changed it (relative "
                         "residual ",
                         residual_, ')'));
  if (residual_ > bound() && options_.maxCorrections > 0) correctBehindEvents();
  return seriesTo({}, zero);
}

/// Whether what begins or ends at this event has a size there, for which the state is corrected.
bool Run::hasSize(int event) {
  const auto byU = calls_.newVector();
  double value = 0, byLambda = 0;
  return !isBreak(event) && options_.maxCorrections > 0 &&
         calls_.eventGradient(event, outcome_.final, value, *byU, byLambda);
}

/// What begins or ends at an event has a size there: the state that solves the changed Problem with the event
/// function zero, a little further along the path. Newton iterations with that function as their border, the
/// first two with factorizations of their own, as the first may be made before there is anything of that
/// size. False, and nothing changed, where the event needs none of it, they do not converge or would miss a
/// stop.
bool Run::correctWithEvent(int event) {
  auto byU = calls_.newVector(), F = calls_.newVector(), Uhat = calls_.newVector(), x = calls_.newVector();
  auto r = calls_.newVector();
  State state = outcome_.final.copy();
  constexpr int maxIterations = 12, factored = 2;
  const double enough = 1e-3 * bound();
  double residual = calls_.residual(state, *r).relative();
  for (int i = 0; i < maxIterations && !(i >= factored && residual <= enough); ++i) {
    double value = 0, byLambda = 0;
    if (!calls_.eventGradient(event, state, value, *byU, byLambda)) return false;
    if (i < factored) {
      calls_.factor(state, *F);
      calls_.solve(*F, *Uhat);
      ++outcome_.corrections;
      if (pending_) ++pending_->corrections;
    }
    calls_.solve(*r, *x);
    // dU = -x + dlambda Uhat with value + byU . dU + byLambda dlambda = 0.
    const double dLambda = (linear::dot(*byU, *x) - value) / (linear::dot(*byU, *Uhat) + byLambda);
    x->update(dLambda, *Uhat, -1);
    state.u->update(1, *x, 1);
    state.lambda += dLambda;
    const double before = residual;
    residual = calls_.residual(state, *r).relative();
    if (!std::isfinite(residual)) return false;
    if (i >= factored && residual > 0.5 * before) break;
  }
  if (!(residual <= bound()) || passesStop(outcome_.final, state)) return false;
  outcome_.final = calls_.settled(state);
  r_ = r;
  residual_ = residual;
  return true;
}

/// The state does not quite solve the Problem that an event has changed: what its series left out of the
/// event function, and rounding, are a residual there, which no shorter step would take away. Newton
/// iterations in the plane normal to the new direction, or at fixed load where they would miss a stop, with
/// one factorization; the series then has its own.
void Run::correctBehindEvents() {
  auto F = calls_.newVector(), Uhat = calls_.newVector();
  calls_.factor(outcome_.final, *F);
  calls_.solve(*F, *Uhat);
  ++outcome_.corrections;
  if (pending_) ++pending_->corrections;
  std::vector<Border> borders = {holdLoad()};
  if (weight_)
    borders.insert(borders.begin(), holdPathParameter(calls_.problem(), *weight_, {{Uhat, {}}, 1}));
  constexpr int maxIterations = 10;
  double best = residual_;
  for (const Border& border : borders) {
    State state = outcome_.final.copy();
    auto r = calls_.newVector();
    const double residual =
        newtonAtHand(calls_, state, *r, Uhat, border, correctAbove(), maxIterations).residual;
    best = std::min(best, residual);
    if (residual > bound() || passesStop(outcome_.final, state)) continue;
    outcome_.final = calls_.settled(state);
    r_ = r;
    residual_ = residual;
    return;
  }
  throw PathError(EndReason::stepTooSmall,
                  line("at lambda = ", outcome_.final.lambda, ": behind an event the relative residual ",
                       residual_, " is over the bound ", bound(), ", and Newton corrections lead to ", best,
                       best > bound() ? " only: ask for a larger bound" : " but past a stop"));
}

/// The Problem changes at the state. Of the functions that are zero there (`due_`) all are applied; where the
/// path then has no admissible sense, other choices are tried. Admissible is the sense in which every
/// function that is zero here rises; it is not asked that the old direction is kept: where lambda then goes
/// the other way the path has a non-smooth limit point. A path that starts here keeps the direction that is
/// asked of it.
Series Run::seriesAfterEvents(StepReport& report) {
  std::vector<int> due;
  std::swap(due, due_);
  if (due.size() > 1 && !hasSize(due[0])) {
    // Not quite together: where the state does not solve the changed Problem, the others come next.
    const double residual = calls_.residual(calls_.afterEvent(due, outcome_.final), *r_).relative();
    if (!(residual <= std::max(bound(), 2 * residual_))) due.resize(1);
  }
  std::set<int> zero(applied_.begin(), applied_.end());
  zero.insert(due.begin(), due.end());
  // What grows may cease to behind any change.
  const auto growing = calls_.problem().growingAt(outcome_.final);
  zero.insert(growing.begin(), growing.end());
  const std::vector<int> candidates(zero.begin(), zero.end());
  std::sort(due.begin(), due.end());
  if (lastLength_ <= options_.minStep || !applied_.empty())
    ++standing_;
  else
    standing_ = 0;
  if (standing_ > 2 * calls_.problem().eventCount() + 4)
    throw PathError(EndReason::eventsCycle, line("at lambda = ", outcome_.final.lambda, ": ", standing_,
                                                 " events in a row without a step between them"));
  // Of a choice: what falls in either sense.
  struct Choice {
    bool singular = false;
    std::vector<int> falls[2];
  };
  std::map<std::vector<int>, Choice> tried;
  std::string crease;  // of a jump behind which no sense was admissible
  const int senses = tangent_ ? 2 : 1;
  std::optional<Series> found;
  // Behind the end of growth alone rates go on as they were: the functions that begin there have none yet,
  // but for what the series left out.
  const bool smooth = tangent_ && std::includes(growing.begin(), growing.end(), due.begin(), due.end());
  // The old sense comes first where something grows: a body that yields can always unload the way it came.
  bool anySense = growing.empty();
  std::optional<std::vector<int>> turned;  // a choice admissible in the other sense
  const auto attempt = [&](const std::vector<int>& chosen) -> const Choice& {
    const auto [at, isNew] = tried.try_emplace(chosen);
    Choice& choice = at->second;
    if (!isNew) return choice;
    const State before = outcome_.final;
    const auto undo = [&] { outcome_.final = before; };
    outcome_.final = calls_.afterEvent(chosen, before);
    try {
      const Series series = seriesOfChoice(candidates, chosen);
      for (int s = 0; s < senses && !found; ++s) {
        const bool flat = smooth && chosen == due;
        choice.falls[s] = falling(series, candidates, s == 0 ? 1 : -1, flat ? due : std::vector<int>{});
        if (!choice.falls[s].empty()) continue;
        if (s == 0 || anySense)
          found = s == 0 ? series : series.reversed();
        else if (!turned)
          turned = chosen;
      }
    } catch (const PathError& error) {
      // A set of constraints that depend on each other, or a mechanism: another choice.
      if (error.reason() != EndReason::singularTangent) {
        undo();
        due_ = due;  // as the step left it, for who goes on from there
        throw;
      }
      choice.singular = true;
    }
    if (found) {
      applied_ = candidates;
      if (!chosen.empty()) ++outcome_.events;
      if (jump_ > 0) ++outcome_.jumps;
      outcome_.worstJump = std::max(outcome_.worstJump, jump_);
      if (pending_) pending_->jump = jump_;
      turned_ = tangent_ && (tangent_->lambda > 0) != (found->lambdaCoefficient(1) > 0);
      if (pending_) pending_->events = difference(pending_->events, chosen);
    } else {
      if (jump_ > 0 && isBreak(chosen.back())) crease = calls_.breakText(chosen.back());
      ++outcome_.eventTrials;
      ++report.restarts;
      undo();
    }
    return choice;
  };
  // No change at all is the way back, except where a path starts.
  const auto allowed = [&](const std::vector<int>& chosen) { return !chosen.empty() || !tangent_; };

  // Principal pivoting: all that fall change sides, or the last of them where that would go in a circle.
  const int count = static_cast<int>(candidates.size());
  for (int s = 0; s < senses && !found; ++s) {
    if (s == 1) anySense = true;
    if (s == 1 && turned) {
      tried.erase(*turned);
      attempt(*turned);
      if (found) break;
    }
    std::set<std::vector<int>> seen;
    std::vector<int> chosen = due;
    for (int trial = 0; trial < 3 * count && allowed(chosen) && seen.insert(chosen).second; ++trial) {
      const Choice& choice = attempt(chosen);
      if (found || choice.singular || choice.falls[s].empty()) break;
      std::vector<int> next = difference(chosen, choice.falls[s]);
      if (seen.count(next)) next = difference(chosen, {choice.falls[s].back()});
      chosen = next;
    }
  }
  // What is left, where it is little: the bits of `left` are the candidates not applied.
  constexpr int mostTogether = 6;
  for (unsigned left = 0; !found && count <= mostTogether && left < (1u << count); ++left) {
    std::vector<int> chosen;
    for (int i = 0; i < count; ++i)
      if (!(left & (1u << i))) chosen.push_back(candidates[i]);
    if (allowed(chosen)) attempt(chosen);
  }
  if (found) return *found;
  due_ = due;
  if (!crease.empty())
    throw PathError(EndReason::problemFailed, line("at lambda = ", outcome_.final.lambda, ": ", crease));
  throw PathError(EndReason::noAdmissibleDirection,
                  line("at lambda = ", outcome_.final.lambda, ": no choice among the ", count,
                       " event(s) there lets the path go on"));
}

/// A path that goes on from a state where events have been applied: the sense in which their functions rise.
Series Run::seriesAfterRestart() {
  Series series = seriesOfChoice(applied_);
  if (falling(series, applied_, 1).empty()) return series;
  return series.reversed();
}

/// Functions that are below zero at the start of the series by what the residual bound allows, and fall.
std::vector<int> Run::overdue(const Series& series) const {
  const double reach = std::min(series.radius(options_.delta), options_.maxStep);
  std::vector<int> due;
  for (int i = 0; i < series.eventCount(); ++i) {
    const Polynomial p = eventPolynomial(series, i, applied_);
    const auto& c = p.coefficients();
    if (series.eventGrows(i) ? c[1] * reach < -1e-9 * size(c, reach) : c[0] < 0 && !rises(c, 1, reach, 0))
      due.push_back(i);
  }
  return due;
}

}  // namespace atrapos::path
