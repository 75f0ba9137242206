#pragma once

#include <functional>
#include <string>
#include <vector>

#include "atrapos/linear/TangentSolver.hpp"
#include "atrapos/path/State.hpp"

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

/// Follows the path of a Problem from an equilibrium with LOCA through thyra::PathModel.
LocaRun followWithLoca(path::Problem& problem, linear::TangentSolver& solver, const path::State& start,
                       const LocaOptions& options);

/// Extremum of lambda: the vertex of the parabola through the three points around the largest lambda, in the
/// distance along the path; `sign` -1: the smallest. Error of third order in the steps.
double foldOf(const std::vector<path::State>& points, double sign);

}  // namespace atrapos::thyra::test
