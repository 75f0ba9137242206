#pragma once

#include "FieldSizes.hpp"
#include "OrderChoice.hpp"
#include "Position.hpp"
#include "Trial.hpp"
#include "atrapos/path/Options.hpp"

namespace atrapos::path {

/// The last accepted step's series.
struct LastStep {
  Series series;
  std::vector<double> factors;  ///< of the fields: it is measured by what was known at its start
  bool behindEvents = false;    ///< it began where events had just been applied
  double at = 0;                ///< where the path is on it: the step's length, more behind a singularity
};

/// A path as it is followed: what the parts of Run have in common.
/// Options::maxStep where nothing is said and lambda moves.
constexpr double defaultMaxStep = 1e3;

struct PathUnderWay {
  PathUnderWay(Calls& calls, const Options& options, const Stops& stops, const Start& start);

  /// A trial becomes a step, and its end the position.
  void accept(Trial trial, StepReport report, LastStep step);

  /// A better state at the end of the pending step.
  void improveEnd(State state, RCP<Vector> r, double residual);

  /// Newton iterations at the position, which are the pending step's where there is one.
  void countCorrections(int iterations);

  double bound() const { return options.residualBound; }
  /// The states of a path meet the bound but for what an event that has just been applied adds to a residual.
  double boundAtEvents() const { return 10 * bound(); }
  /// A residual acts like an imperfection, and one above this makes one branch of two that cross.
  double correctAbove() const;

  /// Beyond relaxOver the residual taken away comes back with the other sign: stay below half the bound.
  double longestLength() const;

  /// Whether a series ended before the highest order, for an end that it reaches.
  bool endsEarly(const Series& series) const { return series.order() < order; }
  /// Of the indices of events: breaks come behind the event functions.
  bool isBreak(int event) const { return event >= calls.problem().eventCount(); }
  /// Those that the series to come is measured by.
  std::vector<double> fieldFactors() const { return fieldSizes.factors(here.weight.value_or(0)); }

  Calls& calls;
  const Options& options;
  const Stops& stops;

  Position here;
  int order = 0;  ///< of the next series
  OrderChoice orders;
  FieldSizes fieldSizes;              ///< up to the position
  std::optional<LastStep> last;       ///< none before the first step
  std::optional<StepReport> pending;  ///< of the last step, not yet seen by the observer
  Outcome outcome;  ///< counts, and how the path has ended; where, and what was called, is added at the end
};

}  // namespace atrapos::path
