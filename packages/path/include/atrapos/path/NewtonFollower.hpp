#pragma once

#include <limits>
#include <optional>

#include "atrapos/path/Problem.hpp"
#include "atrapos/path/Report.hpp"
#include "atrapos/path/Stops.hpp"

namespace atrapos::path {

/// When the corrector factors the tangent.
enum class NewtonKind {
  full,     ///< at every iteration: quadratic convergence
  modified  ///< once a step, at its predictor; again only where the iterations contract too little
};

/// The knobs of Newton arc-length steps. Lengths are those of the path parameter, as in Options.
struct NewtonOptions {
  NewtonKind kind = NewtonKind::full;

  double residualBound = 1e-6;  ///< largest relative residual accepted at the end of a step

  /// Largest distance, sqrt(w <dX, dX> + dlambda^2), of the path inside a step from the cubic that the
  /// observer gets. Estimated in the middle of every step by one residual and one solve. Infinity: the points
  /// at the steps' ends are wanted, not what lies between them. The points themselves are iterated to a tenth
  /// of it.
  double accuracy = std::numeric_limits<double>::infinity();

  /// Step lengths aim at so many iterations: > 0, not necessarily whole. Empty: 4 (full) or 6 (modified),
  /// beyond which little is gained.
  std::optional<double> desiredIterations;
  int minIterations = 1;   ///< >= 1: the first one brings the next tangent
  int maxIterations = 10;  ///< of one trial; more: the step is halved

  /// modified: the tangent is factored again where an iteration leaves more than this part of the correction
  /// before, in (0, 1).
  double refactorAbove = 0.3;

  /// The tangent turns by less than this angle from one end of a step to the other: least cosine, in (0, 1).
  /// A step that does not keep to it is halved; a larger turn may be another branch.
  double minCosine = 0.7;

  double direction = 1;          ///< +1: lambda grows at the start of the path; -1: it falls
  std::optional<double> weight;  ///< w of the path parameter, as Options::weight

  double firstStep = 0.05;      ///< length of the first trial
  double maxGrowth = 3;         ///< of the length from one step to the next, > 1
  double maxStep = 1e3;         ///< longest step
  double minStep = 1e-10;       ///< a cut-back below this ends the path
  int maxSteps = 10000;         ///< >= 0
  int maxStartIterations = 25;  ///< at fixed lambda where the start is not in equilibrium

  /// Throws std::invalid_argument with one line that names the knob, its value and what is accepted.
  void validate() const;
};

/// Follows the solution path of a Problem by Newton's method with an arc-length condition (Riks, Keller): the
/// usual method, on the same Problem, tangent solver and stops as PathFollower.
///
/// A step of length s from a point with unit tangent T: the predictor X + s T, then iterations within the
/// plane normal to T through it, by block elimination. The tangent at the step's end comes from the last
/// factorization, without another one. The length follows from how fast the residual fell
/// (docs/theory/newton.md); a step that does not converge, turns too far or leaves its cubic is cut back.
///
/// The observer gets the cubic that has the path's points and tangents at both ends as a Series of order 3,
/// valid for a in [0, report.length] like any other: stops and limit points are roots of it, the path's point
/// at a stop is corrected. Of StepReport: `radius` is the length tried first, `corrections` the Newton
/// iterations of the step and of its rejected trials, `residualOfSeries` that of the predictor, `inertiaEnd`
/// (full Newton only) that of the last tangent factored, one correction away from the end. Bifurcation points
/// are not located; eigenvalues that changed sign beyond what limit points explain are `unexplained`.
///
/// Of Outcome: `corrections` counts all iterations of steps, `restarts` the tangents at steps' ends that had
/// to be factored for the direction there. With full Newton factorizations = 1 + startIterations +
/// corrections + restarts, less 1 where the start has a tangent and a weight.
class NewtonFollower {
 public:
  /// Problem and solver must outlive the follower. Throws std::invalid_argument, one line, on options or
  /// stops that make no sense and on a Problem with event functions.
  NewtonFollower(Problem& problem, linear::TangentSolver& solver, NewtonOptions options, Stops stops = {});

  /// As PathFollower::run: failures end the path with a reason.
  Outcome run(const State& start, Observer& observer);

  /// The same from a point with a direction, or from StepReport::next of an interrupted path: state, tangent,
  /// weight, length, steps and path length are taken up.
  Outcome runFrom(const Start& start, Observer& observer);

 private:
  Problem& problem_;
  linear::TangentSolver& solver_;
  NewtonOptions options_;
  Stops stops_;
};

}  // namespace atrapos::path
