#pragma once

#include <functional>
#include <string>
#include <vector>

#include "atrapos/linear/TangentSolver.hpp"
#include "atrapos/path/Problem.hpp"
#include "atrapos/path/State.hpp"
#include "atrapos/path/Stops.hpp"

namespace atrapos::thyra::test {

/// Knobs of LOCA's pseudo-arclength continuation; lengths in LOCA's own scaling.
struct LocaOptions {
  double firstStep = 0.05, minStep = 1e-8, maxStep = 1e3;
  double aggressiveness = 0.5;  ///< of its adaptive step length
  int maxIterations = 10;
  double residualBound = 1e-6;  ///< relative residual of the Problem
  int maxSteps = 2000;
  double lambdaMin = -1e6, lambdaMax = 1e6;
  std::string predictor = "Tangent";
  /// Ends the run at the first point for which it is true.
  std::function<bool(const path::State&)> stop = [](const path::State&) { return false; };
};

/// The points that LOCA accepted, and what they cost.
struct LocaRun {
  std::vector<path::State> points;  ///< the start included
  bool stopped = false;             ///< by LocaOptions::stop
  int steps = 0, failedSteps = 0;
  long long factorizations = 0, solves = 0, residuals = 0, tangents = 0;
  double seconds = 0;
};

/// For LocaOptions::stop: whether a state is past the first load factor of the stops, else past their first
/// functional. Throws std::invalid_argument where they have neither.
std::function<bool(const path::State&)> pastFirst(const path::Stops& stops);

/// Follows the path of a Problem from an equilibrium with LOCA through thyra::PathModel.
LocaRun followWithLoca(path::Problem& problem, linear::TangentSolver& solver, const path::State& start,
                       const LocaOptions& options);

/// A limit point of the load by LOCA's own means: Newton's method on the system of Moore and Spence, R = 0,
/// K phi = 0, l . phi = 1.
struct LocaFold {
  bool converged = false;
  double lambda = 0;
  path::State state;
};

/// Started from the point of the run with the largest (`sign` 1) or smallest (-1) lambda; what it moves by
/// between the neighbours is the first guess of phi.
LocaFold foldByLoca(path::Problem& problem, linear::TangentSolver& solver,
                    const std::vector<path::State>& points, double sign, double tolerance);

}  // namespace atrapos::thyra::test
