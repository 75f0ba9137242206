#include "Run.hpp"

#include <Teuchos_CommHelpers.hpp>
#include <algorithm>
#include <cmath>

#include <Tpetra_Vector.hpp>

#include "BestOrder.hpp"

namespace atrapos::path {
namespace {

/// Whether f turns at a root of its derivative. The numerator of a fraction's derivative is a difference of
/// products, whose rounding far beyond the series' radius may look like a root, or move one a little.
bool turns(const Rational& f, double a, double length) {
  const double at = f(a), rounding = 1e-14 * f.magnitude(a);
  for (const double part : {1e-4, 1e-2}) {
    const double before = at - f(std::max(0.0, a - part * length));
    const double behind = f(std::min(length, a + part * length)) - at;
    if (std::abs(before) <= rounding || std::abs(behind) <= rounding || before * behind < 0) return true;
  }
  return false;
}

/// Whether the only limit point that a series shows in a step is none of the path. Passing one turns the load
/// and, the tangent being symmetric, changes the number of its negative eigenvalues by one. Where the load
/// hardly changes, as along a branch that has just left a bifurcation point, the residual that a series
/// leaves may look like one.
bool isOfTheSeriesAlone(const StepReport& report, const std::optional<linear::Inertia>& end, bool turned) {
  if (report.limitPoints.size() != 1 || turned || !report.inertia || !end) return false;
  return report.inertia->null == 0 && end->null == 0 && report.inertia->negative == end->negative;
}

/// Where on a step, as a part of it, the load turns by the tangents at its ends: next to a bifurcation point
/// the residual bends the end of a series, which may then not show what the corrected state has passed.
double turningOf(double atStart, double atEnd) { return atStart / (atStart - atEnd); }

}  // namespace

RCP<Vector> copy(const Vector& v) { return Teuchos::rcp(new Vector(v, Teuchos::Copy)); }

double rounded(double length) {
  int exponent = 0;
  const double mantissa = std::frexp(length, &exponent);
  return std::ldexp(std::floor(mantissa * 128) / 128, exponent);
}

bool Run::end(EndReason reason, std::string text) {
  outcome_.reason = reason;
  outcome_.text = std::move(text);
  return false;
}

void Run::follow(const Start& start) {
  outcome_.final = start.state.copy();
  outcome_.steps = start.steps;
  outcome_.pathLength = start.pathLength;
  r_ = calls_.newVector();
  weight_ = start.weight ? start.weight : options_.weight;
  outcome_.weight = start.weight.value_or(0);
  tangent_ = start.tangent;
  applied_ = start.events;
  due_ = start.due;
  lastLength_ = start.length;
  fieldSizes_ = FieldSizes(start.fieldSizes);
  calls_.weighFields(fieldFactors());
  limitPoints_ = start.limitPoints;
  bifurcations_ = start.bifurcations;
  order_ = start.order > 0 ? start.order : options_.order;
  padeFailures_ = start.padeFailures;
  padeWait_ = start.padeWait;
  if (!calls_.problem().remembers()) landmarks_.emplace(*calls_.problem().map(), start.landmarks);
  counted_ = start.expectedNegative;
  for (const auto& e : start.eigenvalues) start_.modes.push_back({e.vector, e.value, e.rate});
  try {
    outcome_.final = calls_.settled(outcome_.final);
    equilibrate();
    if (!tangent_ && applied_.empty()) due_ = calls_.eventsAt(outcome_.final);
    if (!start.stop.empty() && stops_.have(start.stop))
      end(EndReason::stopReached, start.stop);
    else if (const std::string passed = stops_.passed(limitPoints_, bifurcations_); !passed.empty())
      end(EndReason::stopReached, passed);
    else
      while (step()) {
      }
  } catch (const PathError& error) {
    end(error.reason(), error.what());
  }
  finish();
}

bool Run::step() {
  if (outcome_.steps == options_.maxSteps)
    return end(EndReason::stepLimit, line("the limit of ", options_.maxSteps, " steps is reached"));
  StepReport report;
  const auto factors = fieldFactors();
  calls_.weighFields(factors);
  Series series = nextSeries(report);
  if (sharpenState(series)) series = nextSeries(report);
  EndTangent tangent;
  countHere(tangent);
  tangent.lambda1 = series.lambdaCoefficient(1);
  tangent.modes = modesHere({series.coefficient(1), series.lambdaCoefficient(1)}, series.weight());
  // After an event the tangent is that of the changed problem and says nothing about the step before.
  if (pending_ && !settle(pending_->events.empty() ? &tangent : nullptr))
    return end(EndReason::observerStopped, "ended by the observer");
  if (const std::string passed = stops_.passed(limitPoints_, bifurcations_); !passed.empty())
    return end(EndReason::stopReached, passed);
  if (backAt_)
    return end(EndReason::pathClosed, line("the path is closed: step ", outcome_.steps,
                                           " comes to the state with which step ", *backAt_, " began"));
  start_ = std::move(tangent);
  clean(series);
  report.order = series.order();
  report.step = outcome_.steps + 1;
  report.lambdaStart = outcome_.final.lambda;
  report.pathLengthStart = outcome_.pathLength;
  report.inertia = start_.inertia;
  report.radius = series.radius(options_.delta);
  if (!series.standsStill()) weight_ = outcome_.weight = series.weight();  // a response to weigh

  Trial trial;
  try {
    trial = acceptedTrial(series, report);
  } catch (...) {
    outcome_.cutBacks += report.cutBacks;
    throw;
  }
  report.residualOfSeries = trial.residual;
  // A break stays on its border, where it is told which way the path goes on.
  const bool atBreak = !trial.events.empty() && isBreak(trial.events.back());
  if (!atBreak) correct(series, trial, report, correctAbove());
  stop_ = trial.stop;
  due_ = trial.events;
  lastFactors_ = factors;
  accept(std::move(trial), std::move(report), std::move(series));
  if (stop_) return end(EndReason::stopReached, stop_->text);
  return true;
}

/// The step's end becomes the state; the observer sees it later.
void Run::accept(Trial trial, StepReport report, Series series) {
  trial.state = calls_.settled(trial.state);
  fieldSizes_.moved(calls_.fieldChanges(outcome_.final, trial.state),
                    trial.state.lambda - outcome_.final.lambda);
  report.length = trial.a;
  report.residual = trial.residual;
  report.lambdaEnd = trial.state.lambda;
  report.end = trial.state;
  report.pathLengthEnd = report.pathLengthStart + trial.a;

  ++outcome_.steps;
  outcome_.corrections += report.corrections;
  outcome_.cutBacks += report.cutBacks;
  outcome_.pathLength = report.pathLengthEnd;
  outcome_.final = trial.state;
  r_ = trial.r;
  residual_ = trial.residual;
  lastLength_ = lastEnd_ = trial.a;
  last_ = std::move(series);
  applied_.clear();
  tangent_ = last_->tangent(trial.a);
  seriesOrders_ += last_->order();
  ++seriesBuilt_;
  if (options_.autoOrder) chooseOrder();
  pending_ = std::move(report);
}

/// The pending step is final: what lies inside it is read off its series, and the observer sees it.
bool Run::settle(const EndTangent* end) {
  StepReport report = std::move(*pending_);
  pending_.reset();
  calls_.weighFields(lastFactors_);
  const auto load = last_->lambdaFunction();
  const auto slope = load.derivative();
  const auto curvature = slope.numerator().derivative();  // of the sign of lambda'' where lambda' = 0
  for (const double a : slope.roots(report.length))
    if (turns(load, a, report.length))
      report.limitPoints.push_back({a, last_->lambda(a), curvature(a) < 0, true});
  if (turned_) report.limitPoints.push_back({report.length, report.lambdaEnd, tangent_->lambda > 0, false});
  turned_ = false;
  if (end && isOfTheSeriesAlone(report, end->inertia, loadTurned(*end))) report.limitPoints.clear();
  if (end && report.limitPoints.empty() && loadTurned(*end)) {
    const double a = turningOf(last_->lambdaCoefficient(1), end->lambda1) * report.length;
    report.limitPoints.push_back({a, last_->lambda(a), end->lambda1 < 0, true});
  }
  for (int i = 0; i < static_cast<int>(monitors_.size()); ++i) {
    const Rational value = last_->functional(*monitors_[i].weights);
    const Rational rate = value.derivative();
    const Polynomial bend = rate.numerator().derivative();
    for (const double a : rate.roots(report.length))
      if (turns(value, a, report.length))
        report.extrema.push_back({i, a, last_->lambda(a), value(a), bend(a) < 0});
  }
  std::sort(report.extrema.begin(), report.extrema.end(),
            [](const Extremum& x, const Extremum& y) { return x.a < y.a; });
  if (end) {
    report.inertiaEnd = end->inertia;
    report.uncounted = end->uncounted;
    explainStability(report, *end);
    locateHopfPoints(report, *end);
  }
  outcome_.worstResidual = std::max(outcome_.worstResidual, report.residual);
  if (landmarks_) backAt_ = landmarks_->pass(report.step, *last_, report.length);
  limitPoints_ += static_cast<int>(report.limitPoints.size());
  bifurcations_ += static_cast<int>(report.criticalPoints.size());
  report.next = here();
  const bool goOn = observer_.onStep(report, *last_);
  calls_.weighFields(fieldFactors());
  return goOn;
}

/// All that the next step needs.
Start Run::here() const {
  Start next;
  next.state = outcome_.final;
  next.tangent = tangent_;
  next.steps = outcome_.steps;
  next.pathLength = outcome_.pathLength;
  next.weight = weight_;
  next.fieldSizes = fieldSizes_.sizes();
  next.length = lastLength_;
  next.events = applied_;
  next.due = due_;
  next.order = order_;
  next.padeFailures = padeFailures_;
  next.padeWait = padeWait_;
  if (landmarks_) next.landmarks = landmarks_->all();
  next.expectedNegative = expected_;
  for (const Mode& m : start_.modes) next.eigenvalues.push_back({m.x, m.mu, m.rate});
  next.limitPoints = limitPoints_;
  next.bifurcations = bifurcations_;
  next.stop =
      outcome_.reason == EndReason::stopReached ? outcome_.text : stops_.passed(limitPoints_, bifurcations_);
  return next;
}

/// What a step costs whatever its order, besides the factorization the eigenvalues followed, residuals and
/// searches, is all that is not spent on the orders of the series.
void Run::chooseOrder() {
  const Work& work = calls_.work();
  if (work.solves == 0 || work.orders == 0) return;
  const auto& s = work.seconds;
  const double order = s.solve / work.solves + s.orderRhs / work.orders;
  const double all = s.tangent + s.factor + s.solve + s.orderRhs + s.residual;
  // Clocks differ from rank to rank; the order may not.
  const double own[2] = {std::max(0.0, all - order * seriesOrders_) / seriesBuilt_, order};
  double slowest[2] = {0, 0};
  Teuchos::reduceAll(*calls_.problem().map()->getComm(), Teuchos::REDUCE_MAX, 2, own, slowest);
  order_ = bestOrder(slowest[0], slowest[1], options_.delta);
}

void Run::finish() {
  if (!pending_) return;
  const bool ended = outcome_.reason == EndReason::stopReached || outcome_.reason == EndReason::stepLimit;
  const bool close = ended && options_.closeEnd && (calls_.solver().inertia() || pending_->inertia);
  if (!close) {
    settle(nullptr);
  } else {
    const EndTangent tangent = closeEnd();
    settle(&tangent);
  }
  const std::string passed = stops_.passed(limitPoints_, bifurcations_);
  if (outcome_.reason == EndReason::stepLimit && !passed.empty()) end(EndReason::stopReached, passed);
}

}  // namespace atrapos::path
