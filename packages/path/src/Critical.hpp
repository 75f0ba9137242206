#pragma once

#include <vector>

#include "Augmented.hpp"
#include "Modes.hpp"
#include "Stability.hpp"
#include "atrapos/path/Report.hpp"
#include "atrapos/path/SeriesStep.hpp"

namespace atrapos::path {

/// A place of a step at which the negative eigenvalues of the tangent have been counted.
struct CountedPlace {
  double a = 0;
  long long negative = 0;
  bool rising = true;  ///< lambda
};

/// Whether an odd number of eigenvalues has changed sign between them other than at limit points of the load.
bool oddBetween(const CountedPlace& first, const CountedPlace& second);

/// Eigenvalues that have changed sign for certain between two places of a step, other than at limit points of
/// the load (docs/theory/path.md).
int provenBetween(const CountedPlace& first, const CountedPlace& second,
                  const std::vector<LimitPoint>& limits);

/// A stretch of path in which the tangent says that there are bifurcation points.
struct CriticalSearch {
  const Series& series;      ///< of the step
  double length = 0;         ///< where the step ends on it
  const State& end;          ///< the state there; the solver holds its tangent
  const PathTangent& along;  ///< the direction there
  int order = 20;
  /// Eigenvalues that changed sign and are not those of limit points (at least). 0: none is known, points
  /// whose changes cancel are looked for.
  int signChanges = 1;
  int certain = 0;  ///< of these, how many the count of negative eigenvalues proves
  double residualBound = 1e-6;
  std::vector<ModeSample> samples = {};  ///< eigenvalues followed, at both ends of the step; may be empty
  std::vector<LimitPoint> limits = {};   ///< of the load, in the step: an eigenvalue vanishes there too
  int watchedModes = 0;
  std::vector<CountedPlace> counts = {};  ///< at both ends of the step; empty where inertia does not tell
  EigenProblem counted = EigenProblem::ofTangent;  ///< whose eigenvalues the numbers are of
  Observer* observer = nullptr;                    ///< told of the search (Observer::onSearch); may be null
};

/// Where the eigenvalues followed vanish other than at limit points of lambda.
ModeEvidence bifurcationZeros(const Series& series, double length, const std::vector<ModeSample>& samples,
                              const std::vector<LimitPoint>& limits);

struct CriticalFound {
  std::vector<CriticalPoint> points;  ///< ascending in a
  int factorizations = 0;
};

/// Locates them: eigenvalues followed or, where these do not explain all, poles of the response to a small
/// force seen from the step's end; then Newton on the extended system (docs/theory/path.md). At most two
/// factorizations a point, and two where none is found. What cannot be confirmed is left out. The solver's
/// factorization is another one afterwards.
CriticalFound findCriticalPoints(Calls& calls, const CriticalSearch& search);

/// The response of the path to a small force a f, as a series seen from a state whose tangent the solver
/// holds: difference of the path's series with the force and without. Its poles are the critical points.
Series pathResponse(Calls& calls, const State& from, const PathTangent& along, double weight, int order);

/// Real poles of the response to a small force, seen from a state whose tangent the solver holds: positions
/// relative to it in [-behind, ahead], nearest first, and the response's highest order, which is dominated by
/// the nearest null vector.
struct ResponsePoles {
  std::vector<double> a;
  RCP<Vector> direction;
};
ResponsePoles responsePoles(Calls& calls, const CriticalSearch& search, const State& from,
                            const PathTangent& along, double behind, double ahead);

/// What factorization a refinement starts with.
enum class Held {
  nothing,     ///< the tangent at the guess is factored
  near,        ///< first with the solver's factorization, of a state not far; no other where none is left
  eigenvector  ///< the same, and `nullGuess` is one of several eigenvectors of it
};

/// A simple bifurcation point near a = guess of the step's series, with its branches; `nullGuess` is a rough
/// null vector. False where none is confirmed.
bool refineSimple(Calls& calls, const CriticalSearch& search, double guess, const RCP<Vector>& nullGuess,
                  Held held, int maxFactorizations, CriticalPoint& point, int& factorizations);

/// Where eigenvalues of the tangent that are near zero at a = guess vanish along the step's series, nearest
/// first: mu_i + (a - guess) d mu_i/da = 0, each with its null vector. One factorization; symmetric tangents
/// only.
struct NearNull {
  std::vector<double> a;
  std::vector<RCP<Vector>> vectors;
};
NearNull nearNull(Calls& calls, const CriticalSearch& search, double guess, const RCP<Vector>& nullGuess,
                  int count);

/// A point where two or more eigenvalues vanish together, on a path that crosses it: `near` is what nearNull
/// gave at `at`, whose tangent the solver holds. With the tangents of all branches where they are two. False
/// where they do not vanish together.
bool confirmMultiple(Calls& calls, const CriticalSearch& search, const NearNull& near, double at,
                     CriticalPoint& point);

/// The point at a whose null vectors are given, known to `uncertainty`. False where the series is no solution
/// there.
bool multipleAt(Calls& calls, const CriticalSearch& search, double a, const std::vector<RCP<Vector>>& vectors,
                double uncertainty, CriticalPoint& point);

/// The same as confirmMultiple after a factorization nearer to them.
bool refineMultiple(Calls& calls, const CriticalSearch& search, const NearNull& zeros, CriticalPoint& point,
                    int& factorizations);

}  // namespace atrapos::path
