#include "atrapos/path/PathFollower.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include <Tpetra_Vector.hpp>

#include "Newton.hpp"
#include "Stopwatch.hpp"
#include "atrapos/path/SeriesStep.hpp"

namespace atrapos::path {

namespace {

RCP<Vector> copy(const Vector& v) {
  auto c = Teuchos::rcp(new Vector(v.getMap(), false));
  Tpetra::deep_copy(*c, v);
  return c;
}

template <class... Parts>
std::string line(const Parts&... parts) {
  std::ostringstream text;
  (text << ... << parts);
  return text.str();
}

/// The length with the first 7 bits of its mantissa. Step lengths come from the highest orders, whose last
/// digits are rounding; taken as they are, two runs that round differently (another machine, compiler, number
/// of ranks) would drift apart along the path and could not be compared point by point.
double rounded(double length) {
  int exponent = 0;
  const double mantissa = std::frexp(length, &exponent);
  return std::ldexp(std::floor(mantissa * 128) / 128, exponent);
}

/// One path: the state as it moves, and what the next step needs from the last one.
class Run {
 public:
  Run(Problem& problem, linear::TangentSolver& solver, const Options& options, const Stops& stops,
      Observer& observer, Outcome& outcome)
      : options_(options), stops_(stops), observer_(observer), outcome_(outcome), calls_(problem, solver) {}

  void follow(const State& start);

  const Work& work() const { return calls_.work(); }

 private:
  struct Trial {
    double a = 0;
    State state;
    RCP<Vector> r;        ///< R there
    double residual = 0;  ///< its relative norm
    std::optional<StopHit> stop;
  };

  void equilibrate();
  bool step();
  Series nextSeries(StepReport& report);
  void stepOverSingularity(const PathError& cause, int attempt);
  double firstLength(double radius) const;
  Trial acceptedTrial(const Series& series, StepReport& report);
  void evaluate(const Series& series, Trial& trial);
  double startPart(double a) const;
  double shorterBy(const Trial& trial) const;
  void correct(const Series& series, Trial& trial, StepReport& report);
  bool end(EndReason reason, std::string text);

  double bound() const { return options_.residualBound; }
  double correctAbove() const { return options_.correctAbove * options_.residualBound; }

  const Options& options_;
  const Stops& stops_;
  Observer& observer_;
  Outcome& outcome_;
  Calls calls_;

  RCP<Vector> r_;          ///< R at the current state
  double residual_ = 0;    ///< its relative norm
  double relaxOver_ = 0;   ///< length over which the series under way takes R0 to zero; 0: it keeps R0
  double lastLength_ = 0;  ///< of the last accepted step; 0 before the first
  double lastEnd_ = 0;     ///< where the state is on the last series; > lastLength_ after a singularity
  std::optional<double> weight_;
  std::optional<Series> last_;  ///< the last accepted series
};

bool Run::end(EndReason reason, std::string text) {
  outcome_.reason = reason;
  outcome_.text = std::move(text);
  return false;
}

void Run::follow(const State& start) {
  outcome_.final = {copy(*start.u), start.lambda};
  r_ = calls_.newVector();
  weight_ = options_.weight;
  try {
    equilibrate();
    while (step()) {
    }
  } catch (const PathError& error) {
    end(error.reason(), error.what());
  }
}

void Run::equilibrate() {
  State state{copy(*outcome_.final.u), outcome_.final.lambda};
  residual_ = calls_.residual(state, *r_).relative();
  if (!std::isfinite(residual_))
    throw PathError(EndReason::notFinite, "the residual at the start is not finite");
  if (residual_ <= correctAbove()) return;
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

/// The tangent is singular at the state: go on a little along the last series and start there.
void Run::stepOverSingularity(const PathError& cause, int attempt) {
  const auto giveUp = [&](const std::string& why) {
    throw PathError(cause.reason(),
                    line("at lambda = ", outcome_.final.lambda, ": ", cause.what(), "; ", why));
  };
  if (!last_) giveUp("the path cannot start here");
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
}

Series Run::nextSeries(StepReport& report) {
  std::optional<PathTangent> tangent;
  for (int attempt = 1;; ++attempt) {
    if (last_) tangent = last_->tangent(lastEnd_);
    SeriesRequest request;
    request.order = options_.order;
    request.weight = weight_;
    request.direction = options_.direction;
    request.previous = tangent ? &*tangent : nullptr;
    relaxOver_ = options_.relaxResidual ? lastLength_ : 0;
    if (relaxOver_ > 0) {
      request.residual = r_.get();
      request.relaxOver = relaxOver_;
    }
    try {
      return buildSeries(calls_, outcome_.final, request);
    } catch (const PathError& error) {
      if (error.reason() != EndReason::singularTangent) throw;
      stepOverSingularity(error, attempt);
      ++report.restarts;
    }
  }
}

/// What is left at a of the residual that the series started with.
double Run::startPart(double a) const {
  return relaxOver_ > 0 ? std::abs(1 - a / relaxOver_) * residual_ : residual_;
}

double Run::firstLength(double radius) const {
  if (options_.order == 1)  // no estimate, nothing to round
    return lastLength_ > 0 ? std::min(2 * lastLength_, options_.maxStep) : options_.firstStep;
  double a = std::min(radius, options_.maxStep);
  // Beyond relaxOver_ the residual taken away comes back with the other sign: stay below half the bound.
  if (relaxOver_ > 0 && residual_ > 0) a = std::min(a, relaxOver_ * (1 + 0.5 * bound() / residual_));
  return rounded(a);
}

void Run::evaluate(const Series& series, Trial& trial) {
  trial.state.u = calls_.newVector();
  trial.state.lambda = series.evaluate(trial.a, *trial.state.u);
  trial.r = calls_.newVector();
  trial.residual = calls_.residual(trial.state, *trial.r).relative();
}

/// Factor for the next trial length: the truncation error of the residual grows like a^(K+1).
double Run::shorterBy(const Trial& trial) const {
  if (!std::isfinite(trial.residual)) return 0.5;
  const double start = startPart(trial.a);
  const double truncation = trial.residual - start;
  const double room = 0.5 * (correctAbove() - start);
  if (truncation <= 0 || room <= 0) return 0.5;
  return std::clamp(std::pow(room / truncation, 1.0 / (options_.order + 1)), 0.1, 0.9);
}

Run::Trial Run::acceptedTrial(const Series& series, StepReport& report) {
  Trial trial;
  trial.a = firstLength(report.radius);
  // Looks a little further than the step: a stop just behind its end is taken now, not by a tiny next step.
  trial.stop = firstStop(stops_, series, outcome_.pathLength, 1.001 * trial.a, !last_);
  if (trial.stop) trial.a = trial.stop->a;
  // Shortening the step a little is cheaper than a correction, which costs a factorization; tried once.
  constexpr double worthKeeping = 0.7;
  bool shortened = false;
  double previous = std::numeric_limits<double>::infinity();  // residual of the longer trial before
  for (;;) {
    evaluate(series, trial);
    if (trial.residual <= correctAbove()) return trial;
    const double factor = shorterBy(trial);
    if (trial.residual <= bound()) {
      const bool shorten =
          !shortened && !trial.stop && factor >= worthKeeping && startPart(factor * trial.a) < correctAbove();
      if (!shorten || report.cutBacks == options_.maxCutBacks) return trial;
      shortened = true;
    }
    const bool spent = report.cutBacks == options_.maxCutBacks;
    if (spent || factor * trial.a < options_.minStep) {
      const bool stagnates = trial.residual > 0.3 * previous;  // truncation would fall like a^(K+1)
      throw PathError(
          EndReason::stepTooSmall,
          line(
              "relative residual ", trial.residual, " at step length ", trial.a, " is over the bound ",
              bound(), " (lambda = ", outcome_.final.lambda, ", ",
              spent ? "no trial left" : "shorter than minStep",
              stagnates ? "; it does not fall with the step: rounding limits it, ask for a larger bound" : "",
              ')'));
    }
    ++report.cutBacks;
    previous = trial.residual;
    trial.a = rounded(factor * trial.a);
    trial.stop.reset();
  }
}

void Run::correct(const Series& series, Trial& trial, StepReport& report) {
  if (trial.residual <= correctAbove() || options_.maxCorrections == 0) return;
  Border border;
  if (!trial.stop || trial.stop->kind == StopHit::Kind::pathLength)
    border = holdPathParameter(calls_.problem(), series.weight(), series.tangent(trial.a));
  else if (trial.stop->kind == StopHit::Kind::loadFactor)
    border = holdLoad();
  else
    border = holdFunctional(stops_.functionals[trial.stop->index].weights);
  // The state is under the bound already: where an iteration does not help, it stays as it is.
  const auto result = newton(calls_, trial.state, *trial.r, border, correctAbove(), options_.maxCorrections,
                             /*maxHalvings*/ 0);
  report.corrections = result.iterations;
  trial.residual = result.residual;
}

bool Run::step() {
  if (outcome_.steps == options_.maxSteps)
    return end(EndReason::stepLimit, line("the limit of ", options_.maxSteps, " steps is reached"));
  StepReport report;
  report.step = outcome_.steps + 1;
  report.order = options_.order;
  report.pathLengthStart = outcome_.pathLength;
  Series series = nextSeries(report);
  report.lambdaStart = outcome_.final.lambda;
  report.pathLengthStart = outcome_.pathLength;
  report.inertia = calls_.solver().inertia();
  report.radius = series.radius(options_.delta);
  weight_ = outcome_.weight = series.weight();

  Trial trial;
  try {
    trial = acceptedTrial(series, report);
  } catch (...) {
    outcome_.cutBacks += report.cutBacks;
    throw;
  }
  report.residualOfSeries = trial.residual;
  correct(series, trial, report);

  report.length = trial.a;
  report.residual = trial.residual;
  report.lambdaEnd = trial.state.lambda;
  report.end = trial.state;
  report.pathLengthEnd = report.pathLengthStart + trial.a;
  const auto slope = series.lambdaPolynomial().derivative();
  const auto curvature = slope.derivative();
  for (const double a : slope.roots(trial.a))
    report.limitPoints.push_back({a, series.lambda(a), curvature(a) < 0});

  ++outcome_.steps;
  outcome_.corrections += report.corrections;
  outcome_.cutBacks += report.cutBacks;
  outcome_.worstResidual = std::max(outcome_.worstResidual, trial.residual);
  outcome_.pathLength = report.pathLengthEnd;
  outcome_.final = trial.state;
  r_ = trial.r;
  residual_ = trial.residual;
  lastLength_ = lastEnd_ = trial.a;
  last_ = std::move(series);

  if (!observer_.onStep(report, *last_)) return end(EndReason::observerStopped, "ended by the observer");
  if (trial.stop) return end(EndReason::stopReached, trial.stop->text);
  return true;
}

}  // namespace

PathFollower::PathFollower(Problem& problem, linear::TangentSolver& solver, Options options, Stops stops)
    : problem_(problem), solver_(solver), options_(std::move(options)), stops_(std::move(stops)) {
  options_.validate();
  stops_.validate();
}

Outcome PathFollower::run(const State& start, Observer& observer) {
  Outcome outcome;
  double total = 0;
  {
    Stopwatch watch(total);
    Run run(problem_, solver_, options_, stops_, observer, outcome);
    run.follow(start);
    static_cast<Work&>(outcome) = run.work();
  }
  outcome.seconds.total = total;
  return outcome;
}

}  // namespace atrapos::path
