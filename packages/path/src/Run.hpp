#pragma once

#include <algorithm>
#include <complex>
#include <optional>
#include <sstream>
#include <string>

#include "FieldSizes.hpp"
#include "Landmarks.hpp"
#include "Modes.hpp"
#include "Newton.hpp"
#include "PadeFit.hpp"
#include "atrapos/path/Calls.hpp"
#include "atrapos/path/Monitor.hpp"
#include "atrapos/path/Options.hpp"
#include "atrapos/path/SeriesStep.hpp"
#include "atrapos/path/Stops.hpp"

namespace atrapos::path {

/// One line from its parts.
template <class... Parts>
std::string line(const Parts&... parts) {
  std::ostringstream text;
  (text << ... << parts);
  return text.str();
}

/// One path as it is followed: the state that moves, and what the next step needs from the last one.
///
/// A step that has been accepted stays pending until the tangent at its end is known, which the next step's
/// factorization brings: the direction there is checked, eigenvalues that changed sign are explained, then
/// the observer sees it.
class Run {
 public:
  Run(Problem& problem, linear::TangentSolver& solver, const Options& options, const Stops& stops,
      const std::vector<Monitor>& monitors, Observer& observer, Outcome& outcome)
      : options_(options),
        stops_(stops),
        monitors_(monitors),
        observer_(observer),
        outcome_(outcome),
        calls_(problem, solver) {}

  void follow(const Start& start);

  const Work& work() const { return calls_.work(); }

 private:
  /// The end of a step under trial.
  struct Trial {
    double a = 0;
    State state;
    RCP<Vector> r;        ///< R there
    double residual = 0;  ///< its relative norm
    std::optional<StopHit> stop;
    std::vector<int> events;  ///< event functions that are zero there, and breaks
  };

  /// An end that a series may reach with fewer orders.
  struct NearEnd {
    int nextLook = 0;            ///< order at which it is looked for again
    Trial trial;                 ///< the step to it
    std::vector<double> small;   ///< what event functions may be off by there
    bool silent = false;         ///< the orders of one of them say nothing about what comes behind them
    std::vector<double> offset;  ///< what is left of those that are zero at the start
  };

  /// What the tangent at an end of a step tells.
  struct EndTangent {
    std::optional<linear::Inertia> inertia;
    bool uncounted = false;   ///< the inertia is asked for, and is not known
    double lambda1 = 0;       ///< load part of the unit tangent
    std::vector<Mode> modes;  ///< eigenvalues next to zero that are followed
    // Of an unsymmetric tangent:
    std::optional<int> determinant;              ///< its sign
    int real = 0;                                ///< negative eigenvalues that are real
    std::vector<std::complex<double>> spectrum;  ///< next to zero, where Hopf points are looked for
    /// A number of negative eigenvalues that is right, or right but for an even one. Empty: not known.
    std::optional<long long> parity() const;
  };

  // Run.cpp: the loop.
  bool step();
  void accept(Trial trial, StepReport report, Series series);
  bool settle(const EndTangent* end);
  Start here() const;
  void finish();
  void chooseOrder();
  bool end(EndReason reason, std::string text);

  // RunSingular.cpp: where the tangent is singular.
  void startAside(const PathError& cause);
  void stepOverSingularity(const PathError& cause, int attempt);

  // RunStart.cpp: how a step begins.
  void equilibrate();
  Series nextSeries(StepReport& report);
  Series smoothSeries(StepReport& report);
  bool directionAgrees(const Series& series, const PathTangent& previous) const;
  bool retreat();
  EndTangent closeEnd();
  void polishEnd(const RCP<Vector>& Uhat);

  // RunCritical.cpp: what the step passed.
  std::optional<double> progressionPole(const Series& series) const;
  bool sharpenState(const Series& series);
  void clean(Series& series);
  void explainStability(StepReport& report, const EndTangent& end);
  std::vector<Mode> modesHere(const PathTangent& along, double weight);
  void countHere(EndTangent& tangent);
  void locateHopfPoints(StepReport& report, const EndTangent& end);
  bool loadTurned(const EndTangent& end) const;

  // RunEvents.cpp: where the Problem changes.
  std::vector<double> falls(const Series& series, double end, const std::vector<int>& zero) const;
  void limit(const Series& series, Trial& trial) { limit(series, trial, applied_); }
  void limit(const Series& series, Trial& trial, const std::vector<int>& zero);
  std::vector<int> falling(const Series& series, const std::vector<int>& candidates, double sense,
                           const std::vector<int>& flat = {});
  std::vector<int> overdue(const Series& series) const;
  Series seriesOfChoice(const std::vector<int>& zero, const std::vector<int>& chosen = {});
  bool passesStop(const State& from, const State& to) const;
  bool passJump();
  void correctBehindEvents();
  bool hasSize(int event);
  bool correctWithEvent(int event);
  Series seriesAfterEvents(StepReport& report);
  Series seriesAfterRestart();

  // RunOrders.cpp: how many orders a series has.
  Series seriesTo(SeriesRequest request, const std::vector<int>& zero);
  std::optional<Series> admissible(const Series& series, const std::vector<int>& zero);
  bool reachesEnd(const Series& soFar, const std::vector<int>& zero, NearEnd& end);
  bool tellsEvents(const Series& series, const std::vector<int>& zero, NearEnd& end) const;
  bool eventsHold(const NearEnd& end);
  /// Whether the series ended before the highest order, for an end that it reaches.
  bool endsEarly(const Series& series) const { return series.order() < order_; }

  // RunTrial.cpp: how far it goes.
  double longestLength() const;
  double firstLength(double radius) const;
  Trial acceptedTrial(Series& series, StepReport& report);
  bool goesNowhere(const Series& series, const Trial& trial) const;
  void keepClearOfLimitPoints(const Series& series, Trial& trial);
  PadeFit rationalForm(const Series& series, double polynomial);
  bool polynomialReaches(Series& series, double a);
  std::optional<Trial> padeTrial(Series& series, StepReport& report);
  Trial polynomialTrial(const Series& series, StepReport& report);
  void evaluate(const Series& series, Trial& trial);
  double rateDefect(const Series& series, const Trial& trial);
  bool astray(const Trial& trial);
  bool endAtBreak(const Series& series, Trial& trial);
  double startPart(double a) const;
  double shorterBy(double a, double residual, int order) const;
  const char* whyNotFalling(double residual, double ofLonger) const;
  void correct(const Series& series, Trial& trial, StepReport& report, double above);
  Border borderAt(const Series& series, double a, const std::optional<StopHit>& stop);

  /// Those that the series to come is measured by.
  std::vector<double> fieldFactors() const { return fieldSizes_.factors(weight_.value_or(0)); }

  /// Of the indices of events: breaks come behind the event functions.
  bool isBreak(int i) const { return i >= calls_.problem().eventCount(); }

  double bound() const { return options_.residualBound; }
  /// The states of a path meet the bound but for what an event that has just been applied adds to a residual.
  double boundAtEvents() const { return 10 * bound(); }
  /// A residual acts like an imperfection, and one above this makes one branch of two that cross.
  double correctAbove() const {
    constexpr double loosest = 1e-4;
    return std::min(options_.correctAbove * options_.residualBound, loosest);
  }

  const Options& options_;
  const Stops& stops_;
  const std::vector<Monitor>& monitors_;
  Observer& observer_;
  Outcome& outcome_;
  Calls calls_;
  std::optional<Landmarks>
      landmarks_;  ///< none where internal variables tell states with the same unknowns apart

  std::optional<StopHit> stop_;  ///< that the path has reached
  std::optional<int> backAt_;    ///< the step at whose start the path is again
  RCP<Vector> r_;                ///< R at the current state
  double residual_ = 0;          ///< its relative norm
  double relaxOver_ = 0;         ///< length over which the series under way takes R0 to zero; 0: it keeps R0
  double lastLength_ = 0;        ///< of the last accepted step; 0 before the first
  double lastEnd_ = 0;           ///< where the state is on the last series; > lastLength_ after a singularity
  int order_ = 0;                ///< of the next series
  int seriesOrders_ = 0, seriesBuilt_ = 0;  ///< orders of the accepted series in all; how many
  std::optional<double> weight_;
  FieldSizes fieldSizes_;               ///< up to the current state
  std::vector<double> lastFactors_;     ///< those of last_: it is measured by what was known at its start
  std::optional<Series> last_;          ///< the last accepted series
  std::optional<StepReport> pending_;   ///< its step, not yet seen by the observer
  EndTangent start_;                    ///< at the start of the pending step
  std::optional<PathTangent> tangent_;  ///< at the current state, of what led there
  std::vector<int> due_;      ///< event functions that fell to zero at the state and are not applied yet
  std::vector<int> applied_;  ///< applied at the state: their functions start at zero
  bool turned_ = false;       ///< lambda goes the other way after the events
  std::string mechanism_;     ///< the null vector of a singular start that was left aside
  double jump_ = 0;           ///< the residual that passJump has corrected at this state
  int standing_ = 0;          ///< events in a row without a step of sensible length
  int limitPoints_ = 0;       ///< passed, up to the last step that the observer has seen
  int bifurcations_ = 0;      ///< the same
  int padeFailures_ = 0;      ///< steps in a row that the rational form did not lengthen
  int padeWait_ = 0;          ///< steps until it is tried again
  int counted_ = 0;           ///< eigenvalues with negative real part when they were counted last
  int expected_ = 0;          ///< counted_ before that
};

/// Event function i without its value at the start where that is a known root (one of `zero`).
Polynomial eventPolynomial(const Series& series, int i, const std::vector<int>& zero);

/// A length with the first 7 bits of its mantissa. Step lengths come from the highest orders, whose last
/// digits are rounding; taken as they are, two runs that round differently (another machine, compiler, number
/// of ranks) would drift apart along the path and could not be compared point by point.
double rounded(double length);

RCP<Vector> copy(const Vector& v);

}  // namespace atrapos::path
