#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "atrapos/linear/TangentSolver.hpp"
#include "atrapos/path/Landmark.hpp"
#include "atrapos/path/Series.hpp"

namespace atrapos::path {

/// A limit point of the load: dlambda/da = 0 inside a step.
struct LimitPoint {
  double a = 0;       ///< on the step's series
  double lambda = 0;  ///< load factor there
  bool maximum = false;
  bool smooth = true;  ///< false: lambda turns because an event changed the Problem
};

/// A limit point of a monitor: d(weights . U)/da = 0 inside a step.
struct Extremum {
  int monitor = 0;    ///< index into the monitors given to PathFollower::watch
  double a = 0;       ///< on the step's series
  double lambda = 0;  ///< load factor there
  double value = 0;   ///< of the monitor
  bool maximum = false;
};

enum class CriticalKind {
  transcritical,  ///< two branches cross, lambda goes on along both
  pitchfork,      ///< lambda turns along one of the two branches
  multiple,       ///< at least two eigenvalues of the tangent vanish together: more than two branches
  hilltop         ///< lambda turns along both branches: limit point and bifurcation point in one
};

/// "transcritical" and so on.
const char* toString(CriticalKind kind);

/// A bifurcation point on the path (docs/theory/path.md).
struct CriticalPoint {
  double a = 0;                      ///< on the step's series
  double stepLength = 0;             ///< of the step: what is near and far here
  std::vector<double> fieldSizes{};  ///< Start::fieldSizes at the step's end
  CriticalKind kind = CriticalKind::transcritical;
  State state;          ///< corrected: exact to rounding at a simple point
  double residual = 0;  ///< relative, at `state`
  /// The last correction of its location, as a part of the step's length.
  double uncertainty = 0;
  int negativeChange = 0;  ///< of the number of negative eigenvalues from before to behind it
  /// Number of null vectors found: 1, or more where `kind` is multiple.
  int nullity = 1;
  /// Unit directions (w <X, X> + lambda^2 = 1) of the branches through it, that of the path first and with
  /// its sense. At a multiple point those of all branches found, two null vectors and a symmetric tangent
  /// given; empty otherwise.
  std::vector<PathTangent> tangents;
  std::vector<RCP<Vector>> nullVectors;  ///< of K_T there, Euclidean norm 1
};

/// A point of the path at which a conjugate pair of eigenvalues of K x = mu M x crosses the imaginary axis:
/// next to it a state that moves by M dU/dt = -R(U, lambda) turns around the path's with this frequency.
struct HopfPoint {
  double a = 0;            ///< on the step's series
  State state;             ///< that of the series there
  double frequency = 0;    ///< angular, |mu|, > 0
  double residual = 0;     ///< relative, at `state`
  double uncertainty = 0;  ///< of its place on the series, as a part of the step's length
  int negativeChange = 2;  ///< of the number of unstable eigenvalues from before to behind it, +-2
};

/// An eigenvalue of the tangent next to zero, as it is followed from step to step.
struct FollowedEigenvalue {
  RCP<Vector> vector;  ///< Euclidean norm 1
  double value = 0;
  double rate = 0;  ///< by the path parameter; not a number where it was not wanted
};

/// Where and how a path starts. The state alone starts a new one; the other entries go on with one that was
/// interrupted, and are taken from StepReport::next as they are.
struct Start {
  State state;
  std::optional<PathTangent> tangent;  ///< of the path that led here: the sense is kept
  int steps = 0;                       ///< taken before, counted against Options::maxSteps
  double pathLength = 0;               ///< gone before
  int limitPoints = 0;                 ///< passed before, counted against Stops::limitPoints
  int bifurcations = 0;                ///< the same against Stops::bifurcations
  std::optional<double> weight;        ///< w of the path; empty: by Options::weight
  /// How far the fields and, last, the load factor have moved in a step at most. Empty: not at all, or the
  /// unknowns have one unit.
  std::vector<double> fieldSizes;
  double length = 0;                   ///< of the step that led here; 0: none
  double relaxLength = 0;              ///< over which its residual is taken away; 0: none
  std::vector<int> events;             ///< applied at this state: their functions are zero here
  std::vector<int> due;                ///< not applied yet at this state, and their functions are zero here
  int order = 0;                       ///< of the series to come; 0: Options::order
  int padeFailures = 0, padeWait = 0;  ///< when the rational form is tried again
  Trail landmarks;                     ///< of all steps before; of paths that remember none
  /// Those of the step that led here, from which the ones at this state are found.
  std::vector<FollowedEigenvalue> eigenvalues;
  /// How many negative ones to expect here where they are counted one by one.
  int expectedNegative = 0;
  /// The stop that this state is at (StopHit::text): a path that still has it is over. Empty: none.
  std::string stop;
};

/// What happened in one step.
struct StepReport {
  int step = 0;       ///< from 1
  int order = 0;      ///< of the series; below Options::order where its end is near (Options::fewerOrders)
  double radius = 0;  ///< eq. (36); infinity where the series terminates or has order 1
  double length = 0;  ///< accepted length a
  int cutBacks = 0;   ///< trial lengths rejected by the residual
  double lambdaStart = 0, lambdaEnd = 0;
  double residual = 0;          ///< relative, at the end, after corrections
  double residualOfSeries = 0;  ///< the same before corrections
  int corrections = 0;          ///< Newton iterations at the end, one factorization each
  int restarts = 0;      ///< singular tangents at the start, each stepped over along the previous series
  int retreats = 0;      ///< times the step was halved because the direction at its end was another one
  double padeRange = 0;  ///< range of the rational form; 0 where none was tried or none is good
  bool pade = false;     ///< the step follows the rational form
  std::optional<linear::Inertia> inertia;     ///< of the tangent at the step's start
  std::optional<linear::Inertia> inertiaEnd;  ///< and at its end, i.e. the next step's start
  /// The negative eigenvalues at the end had to be computed one by one (a tangent that is not symmetric), and
  /// that left their number open: pairs of them may have changed sign in this step or the next, unseen.
  bool uncounted = false;
  std::vector<LimitPoint> limitPoints;
  std::vector<Extremum> extrema;  ///< of the monitors, ascending in a
  /// Event functions that fell to zero at the step's end, or breaks there (indices from Problem::eventCount()
  /// on; see Pieces), that were applied: `next` has the memory of the changed Problem, `end` and the series
  /// have that of the Problem before.
  std::vector<int> events;
  /// Relative residual of `end` on the piece that the path goes on to, where forces jump and corrections were
  /// needed (Options::jumpBound): the next step does not start from `end`. Else 0.
  double jump = 0;
  std::vector<CriticalPoint> criticalPoints;  ///< bifurcation points inside the step, ascending
  std::vector<HopfPoint> hopfPoints;          ///< ascending (Options::hopfEigenvalues)
  /// Eigenvalues that changed sign inside the step and are explained by no point found: the tangent says that
  /// there is a bifurcation, its place is not known.
  int unexplained = 0;
  double pathLengthStart = 0, pathLengthEnd = 0;  ///< sums of the lengths
  State end;                                      ///< the accepted state, after corrections
  /// Number of negative eigenvalues of the tangent at a in [0, length]; empty where it is not known (a solver
  /// that does not tell, two limit points of which only the sum of the changes is known).
  std::optional<long long> negativeAt(double a) const;

  Start next;  ///< a path that starts from it goes on with the same bits
};

/// Watches a path as it is followed.
class Observer {
 public:
  virtual ~Observer() = default;

  /// After every accepted step, as soon as the tangent at its end is known; the series is valid for a in
  /// [0, report.length]. Return false to end the path.
  virtual bool onStep(const StepReport& report, const Series& series) = 0;

  /// While bifurcation points are looked for inside a step, after each of the search's factorizations:
  /// `wanted` eigenvalues have changed sign in it, those of the points found so far are `found`.
  virtual void onSearch(int /*found*/, int /*wanted*/) {}
};

enum class EndReason {
  stopReached,            ///< one of Stops
  stepLimit,              ///< Options::maxSteps
  observerStopped,        ///< onStep returned false
  startNotInEquilibrium,  ///< the Newton start failed
  singularTangent,        ///< K_T is singular where a step starts, and stepping over it failed
  solverFailed,           ///< the tangent solver failed for another reason than singularity
  loadWithoutEffect,      ///< Uhat = 0: the load parameter does not move the unknowns
  notFinite,              ///< the Problem or the solver gave a value that is not a number
  noAdmissibleDirection,  ///< after an event no change of the Problem lets the path go on
  eventsCycle,            ///< events follow one another without the path going on
  directionLost,          ///< the tangent at a step's end is not its series' derivative, however short
  stepTooSmall,           ///< the residual bound cannot be met by a step of sensible length
  problemFailed,          ///< the Problem threw; its message is in the text
  pathClosed              ///< the path is again at a state where it has been, in the same direction
};

/// "stopReached" and so on.
const char* toString(EndReason reason);

/// Why a series or a state could not be computed. PathFollower turns it into an Outcome.
class PathError : public std::runtime_error {
 public:
  PathError(EndReason reason, const std::string& text) : std::runtime_error(text), reason_(reason) {}
  EndReason reason() const { return reason_; }

 private:
  EndReason reason_;
};

/// Wall-clock seconds by part.
struct Timings {
  double tangent = 0;   ///< Problem::tangent
  double analysis = 0;  ///< symbolic, once a path
  double factor = 0;    ///< factorizations
  double solve = 0;     ///< forward and backward substitutions
  double orderRhs = 0;  ///< beginSeries, orderRhs, internalOrder, completeOrder
  double residual = 0;  ///< Problem::residual
  double total = 0;
};

/// Calls made to the tangent solver and the Problem.
struct Work {
  int factorizations = 0;
  int solves = 0;
  int orders = 0;  ///< right-hand sides F_k computed
  Timings seconds;
};

/// How a path ended, and what it cost. factorizations = steps + startIterations + corrections + restarts +
/// retreats + closings + criticalFactorizations + hopfFactorizations + eventTrials, plus 1 where the last
/// series did not become a step.
struct Outcome : Work {
  EndReason reason = EndReason::problemFailed;
  std::string text;  ///< one line
  int steps = 0;
  int startIterations = 0;         ///< Newton iterations before the first step
  int corrections = 0;             ///< Newton iterations at the ends of steps, and beyond breaks
  int restarts = 0;                ///< singular tangents met at the start of a step
  int retreats = 0;                ///< steps halved because the direction at their end was another one
  int criticalFactorizations = 0;  ///< spent on locating critical points
  int hopfFactorizations = 0;      ///< the same on Hopf points
  int events = 0;                  ///< applied
  int jumps = 0;                   ///< passed by corrections (StepReport::jump)
  int eventTrials = 0;             ///< factorizations of changes that turned out not to be admissible
  int closings = 0;                ///< factorizations at the path's end, for its inertia
  int cutBacks = 0;
  double worstResidual = 0;  ///< largest relative residual at the end of a step
  double worstJump = 0;      ///< largest StepReport::jump
  double weight = 0;         ///< w of the path parameter; 0 where no step was started
  double pathLength = 0;
  State final;  ///< the last accepted state
};

}  // namespace atrapos::path
