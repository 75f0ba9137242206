#include "NewtonRun.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <Tpetra_Vector.hpp>

#include "Line.hpp"
#include "Newton.hpp"
#include "Rounded.hpp"

namespace atrapos::path {

namespace {

Augmented evaluate(const Series& series, double a, const Calls& calls) {
  Augmented x{calls.newVector(), 0};
  x.lambda = series.evaluate(a, *x.u);
  return x;
}

/// Exponent m of the residual r_0 theta^m that N iterations leave.
double reductions(NewtonKind kind, double iterations) {
  return kind == NewtonKind::full ? std::exp2(iterations) - 1 : iterations;
}

}  // namespace

PathError NewtonRun::withoutEffect() const {
  return {EndReason::loadWithoutEffect,
          line("up to lambda = ", outcome_.final.lambda, " the load parameter does not move the unknowns")};
}

bool NewtonRun::end(EndReason reason, std::string text) {
  outcome_.reason = reason;
  outcome_.text = std::move(text);
  return false;
}

void NewtonRun::follow(const Start& start) {
  outcome_.final = start.state.copy();
  outcome_.steps = start.steps;
  outcome_.pathLength = start.pathLength;
  length_ = start.length > 0 ? start.length : options_.firstStep;
  first_ = !start.tangent;
  fieldSizes_ = FieldSizes(start.fieldSizes);
  try {
    outcome_.final = calls_.settled(outcome_.final);
    equilibrate();
    startTangent(start);
    limitPoints_ = start.limitPoints;
    if (const std::string passed = stops_.passed(limitPoints_, 0); !passed.empty())
      end(EndReason::stopReached, passed);
    else
      while (step()) {
      }
  } catch (const PathError& error) {
    end(error.reason(), error.what());
  }
}

void NewtonRun::equilibrate() {
  State state = outcome_.final.copy();
  auto r = calls_.newVector();
  constexpr int maxHalvings = 10;
  const auto result =
      newton(calls_, state, *r, holdLoad(), options_.residualBound, options_.maxStartIterations, maxHalvings);
  outcome_.startIterations = result.iterations;
  if (!std::isfinite(result.residual))
    throw PathError(EndReason::notFinite, "the residual at the start is not finite");
  if (!result.converged)
    throw PathError(EndReason::startNotInEquilibrium,
                    line("no equilibrium found at the start, lambda = ", state.lambda, ": ", result.trouble,
                         " (relative residual ", result.residual, ')'));
  outcome_.final = calls_.settled(state);
}

void NewtonRun::startTangent(const Start& start) {
  const auto weight = start.weight ? start.weight : options_.weight;
  calls_.weighFields(fieldSizes_.factorsOfMoved(weight.value_or(0)));
  if (start.tangent && weight) {
    weight_ = *weight;
    tangent_ = copy(Augmented{start.tangent->x.u, start.tangent->lambda});
  } else {
    corrector_.factor(outcome_.final);
    inertia_ = options_.kind == NewtonKind::full ? corrector_.inertia() : std::nullopt;
    const Augmented hat{corrector_.uhat(), 0};
    const double size = corrector_.dot(hat, hat, 1);
    // A tool may come from afar: as long as nothing moves lambda alone counts.
    weight_ = weight ? *weight : size > 0 ? 1 / size : 0;
    if (!start.tangent) calls_.weighFields(atFirst().factorsOfMoved(weight_));
    tangent_ = copy(Augmented{corrector_.uhat(), 1});
    double sense = options_.direction;
    if (start.tangent) sense = corrector_.dot(tangent_, {start.tangent->x.u, start.tangent->lambda}, weight_);
    if (sense < 0) scale(tangent_, -1);
  }
  outcome_.weight = weight_;
  const double square = corrector_.dot(tangent_, tangent_, weight_);
  constexpr double rounding = 1e-12;  // a path that goes on keeps its bits
  if (!(std::abs(square - 1) < rounding)) scale(tangent_, 1 / std::sqrt(square));
}

/// What a first step along Uhat moves.
FieldSizes NewtonRun::atFirst() {
  auto u = copy(*outcome_.final.u);
  u->update(options_.firstStep, *corrector_.uhat(), 1);
  FieldSizes sizes;
  sizes.moved(
      calls_.fieldChanges(outcome_.final, outcome_.final.at(u, outcome_.final.lambda + options_.firstStep)),
      options_.firstStep);
  return sizes;
}

/// The cubic with the points and the tangents of both ends; a is the length along the tangent at its start.
Series NewtonRun::cubic(const Trial& trial) const {
  const double s = trial.s;
  Augmented chord = copy(Augmented{trial.state.u, trial.state.lambda});
  add(chord, -1, {outcome_.final.u, outcome_.final.lambda});
  scale(chord, 1 / s);
  Augmented second = copy(chord), third = copy(chord);
  scale(second, 3);
  add(second, -2, tangent_);
  add(second, -1, trial.slope);
  scale(second, 1 / s);
  scale(third, -2);
  add(third, 1, tangent_);
  add(third, 1, trial.slope);
  scale(third, 1 / (s * s));
  Series series(outcome_.final, weight_);
  const std::vector<double> none(calls_.problem().internalCount(), 0.0);
  for (const Augmented& c : {copy(tangent_), second, third})
    series.append({c.u, none}, c.lambda, std::sqrt(corrector_.dot({c.u, 0}, {c.u, 0}, 1)));
  return series;
}

/// The tangent at hand is that of a state `distance` away. Over this part of the step the path turns by as
/// large a part of the step's angle, and a cubic with an error e in its end tangent is off by 4/27 s e.
bool NewtonRun::needsExactTangent(const Trial& trial, double cosine) const {
  constexpr double enoughToPredict = 0.05;
  const double distance = corrector_.distance();
  if (distance > enoughToPredict * trial.s) return true;
  const double angle = std::acos(std::min(1.0, cosine));
  return 4.0 / 27 * angle * distance > 0.1 * options_.accuracy;
}

/// One Newton correction of the cubic's middle, with the last factorization.
double NewtonRun::distanceInTheMiddle(const Series& series, double s) {
  const Augmented x = evaluate(series, 0.5 * s, calls_);
  auto r = calls_.newVector();
  calls_.residual(outcome_.final.at(x.u, x.lambda), *r);
  r->scale(-1);
  const Augmented d = corrector_.solve(*r, tangent_, weight_);
  return std::sqrt(corrector_.dot(d, d, weight_));
}

NewtonRun::Trial NewtonRun::tryLength(double s) {
  Trial trial;
  trial.s = s;
  trial.state = outcome_.final.at(copy(*outcome_.final.u), outcome_.final.lambda + s * tangent_.lambda);
  trial.state.u->update(s, *tangent_.u, 1);
  trial.r = calls_.newVector();
  trial.newton = corrector_.correct(trial.state, *trial.r, tangent_, weight_, s);
  if (!trial.newton.converged) {
    trial.reject = trial.newton.trouble;
    return trial;
  }
  trial.slope = corrector_.tangent(tangent_, weight_);
  // tangent . slope = 1: the cosine is that of the slope's length.
  const auto cosineOf = [&] { return 1 / std::sqrt(corrector_.dot(trial.slope, trial.slope, weight_)); };
  if (needsExactTangent(trial, cosineOf())) {
    const int before = calls_.work().factorizations;
    trial.slope = corrector_.tangentAt(trial.state, tangent_, weight_);
    outcome_.restarts += calls_.work().factorizations - before;
  }
  if (!(cosineOf() >= options_.minCosine)) {
    trial.reject = line("the path turns by more than the angle of cosine ", options_.minCosine);
    return trial;
  }
  if (std::isfinite(options_.accuracy)) {
    trial.middle = distanceInTheMiddle(cubic(trial), s);
    if (!(trial.middle <= options_.accuracy)) {
      trial.reject = line("the path leaves the cubic by ", trial.middle);
      trial.shorter = std::clamp(0.9 * std::pow(options_.accuracy / trial.middle, 0.25), 0.2, 0.9);
    }
  }
  return trial;
}

/// The residual behaves like r_0 theta^m, r_0 and theta both like s^2 (docs/theory/newton.md).
double NewtonRun::nextLength(const Trial& trial, double cosine) const {
  double factor = options_.maxGrowth;
  const auto& n = trial.newton;
  if (n.first > 0 && n.residual > 0) {
    const double made = reductions(options_.kind, n.iterations);
    const double aim = options_.desiredIterations.value_or(options_.kind == NewtonKind::full ? 4 : 6);
    const double wanted = reductions(options_.kind, aim);
    const double logTheta = std::log(n.residual / n.first) / made;
    factor = std::exp((std::log(options_.residualBound / n.first) - wanted * logTheta) / (2 * (wanted + 1)));
  }
  if (trial.middle > 0) factor = std::min(factor, 0.9 * std::pow(options_.accuracy / trial.middle, 0.25));
  // The angle grows like s.
  const double angle = std::acos(std::min(1.0, cosine)), widest = std::acos(options_.minCosine);
  if (angle > 0) factor = std::min(factor, 0.8 * widest / angle);
  return trial.s * std::clamp(factor, 0.3, options_.maxGrowth);
}

bool NewtonRun::correctAtStop(const StopHit& stop, const Series& series, Trial& trial, int& iterations) {
  Augmented x = evaluate(series, stop.a, calls_);
  trial.state = outcome_.final.at(x.u, x.lambda);
  Border border = holdPathParameter(calls_.problem(), weight_, series.tangent(stop.a));
  if (stop.kind == StopHit::Kind::loadFactor) border = holdLoad();
  if (stop.kind == StopHit::Kind::functional) border = holdFunctional(stops_.functionals[stop.index].weights);
  const auto result =
      newton(calls_, trial.state, *trial.r, border, options_.residualBound, options_.maxIterations,
             /*maxHalvings*/ 3);
  iterations += result.iterations;
  trial.newton.residual = result.residual;
  return result.converged;
}

bool NewtonRun::step() {
  if (outcome_.steps == options_.maxSteps)
    return end(EndReason::stepLimit, line("the limit of ", options_.maxSteps, " steps is reached"));
  StepReport report;
  const double remaining = stops_.pathLength - outcome_.pathLength;
  if (!(remaining > 0))
    return end(EndReason::stopReached, line("path length ", stops_.pathLength, " reached"));
  double s = rounded(std::min(length_, options_.maxStep));
  report.radius = s;
  if (standsStill() && s >= rounded(options_.maxStep)) throw withoutEffect();
  for (;; ++report.cutBacks) {
    s = std::min(s, remaining);
    Trial trial = tryLength(s);
    report.corrections += trial.newton.iterations;
    report.residualOfSeries = trial.newton.first;
    if (trial.reject.empty()) {
      Series series = cubic(trial);
      const double cosine = 1 / std::sqrt(corrector_.dot(trial.slope, trial.slope, weight_));
      const auto stop = firstStop(stops_, series, outcome_.pathLength, s, first_);
      if (!stop || stop->a >= s || correctAtStop(*stop, series, trial, report.corrections)) {
        length_ = nextLength(trial, cosine);
        report.length = stop ? stop->a : s;
        if (stop) report.next.stop = stop->text;
        const bool goOn = accept(trial, series, report);
        if (!report.next.stop.empty()) {
          if (standsStill()) throw withoutEffect();
          return end(EndReason::stopReached, report.next.stop);
        }
        if (!goOn) return end(EndReason::observerStopped, "ended by the observer");
        return true;
      }
      trial.reject = "no equilibrium found at the stop: " + stop->text;
    }
    s = rounded(trial.shorter * s);
    if (s < options_.minStep) {
      outcome_.cutBacks += report.cutBacks;
      outcome_.corrections += report.corrections;
      throw PathError(
          EndReason::stepTooSmall,
          line("at lambda = ", outcome_.final.lambda, " a step of length ", trial.s, " fails: ", trial.reject,
               " (relative residual ", trial.newton.residual, "); a shorter one would be below minStep"));
    }
  }
}

bool NewtonRun::accept(Trial& trial, Series& series, StepReport& report) {
  trial.state = calls_.settled(trial.state);
  report.step = ++outcome_.steps;
  report.order = series.order();
  report.lambdaStart = outcome_.final.lambda;
  report.lambdaEnd = trial.state.lambda;
  report.residual = trial.newton.residual;
  report.pathLengthStart = outcome_.pathLength;
  report.pathLengthEnd = outcome_.pathLength += report.length;
  report.end = trial.state;
  const auto slope = series.lambdaFunction().derivative();
  const auto curvature = slope.numerator().derivative();
  for (const double a : slope.roots(report.length))
    report.limitPoints.push_back({a, series.lambda(a), curvature(a) < 0, true});
  report.inertia = inertia_;
  inertia_ = options_.kind == NewtonKind::full ? corrector_.inertia() : std::nullopt;
  report.inertiaEnd = inertia_;
  if (report.inertia && report.inertiaEnd) {
    const auto changed = std::llabs(report.inertiaEnd->negative - report.inertia->negative);
    report.unexplained = std::max(0, static_cast<int>(changed) - static_cast<int>(report.limitPoints.size()));
  }

  const PathTangent t = series.tangent(report.length);
  tangent_ = {t.x.u, t.lambda};
  scale(tangent_, 1 / std::sqrt(corrector_.dot(tangent_, tangent_, weight_)));
  fieldSizes_.moved(calls_.fieldChanges(outcome_.final, trial.state),
                    trial.state.lambda - outcome_.final.lambda);
  outcome_.final = trial.state;
  weighResponse();
  outcome_.corrections += report.corrections;
  outcome_.cutBacks += report.cutBacks;
  outcome_.worstResidual = std::max(outcome_.worstResidual, report.residual);
  first_ = false;
  measureAnew();
  report.next.state = outcome_.final;
  report.next.tangent = PathTangent{{tangent_.u, t.x.internal}, tangent_.lambda};
  report.next.steps = outcome_.steps;
  report.next.pathLength = outcome_.pathLength;
  if (!standsStill()) report.next.weight = weight_;
  report.next.length = length_;
  report.next.fieldSizes = fieldSizes_.sizes();
  report.next.limitPoints = limitPoints_ += static_cast<int>(report.limitPoints.size());
  if (report.next.stop.empty()) report.next.stop = stops_.passed(limitPoints_, 0);
  return observer_.onStep(report, series);
}

/// At the first response both terms of the path parameter weigh the same, as at a start that has one.
void NewtonRun::weighResponse() {
  if (!standsStill()) return;
  const Augmented response{tangent_.u, 0};
  const double size = corrector_.dot(response, response, 1);
  if (size > 0) outcome_.weight = weight_ = tangent_.lambda * tangent_.lambda / size;
}

/// Fields count by what they have moved by now; the next length stays the piece of the path that it was.
void NewtonRun::measureAnew() {
  calls_.weighFields(fieldSizes_.factorsOfMoved(weight_));
  const double unit = std::sqrt(corrector_.dot(tangent_, tangent_, weight_));
  constexpr double rounding = 1e-12;  // a path of one unit keeps its bits
  if (std::abs(unit - 1) < rounding) return;
  scale(tangent_, 1 / unit);
  length_ *= unit;
}

}  // namespace atrapos::path
