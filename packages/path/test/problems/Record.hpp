#pragma once

#include <algorithm>
#include <functional>
#include <vector>

#include <Tpetra_Vector.hpp>

#include "DenseSolver.hpp"
#include "JetProblem.hpp"
#include "Laws.hpp"
#include "SymmetricDenseSolver.hpp"
#include "atrapos/path/PathFollower.hpp"

/// Keeps every step.
struct Record : atrapos::path::Observer {
  std::vector<atrapos::path::StepReport> steps;
  std::vector<atrapos::path::Series> series;
  std::function<bool()> goOn = [] { return true; };

  bool onStep(const atrapos::path::StepReport& report, const atrapos::path::Series& s) override {
    steps.push_back(report);
    series.push_back(s);
    return goOn();
  }

  std::vector<atrapos::path::LimitPoint> limitPoints() const {
    std::vector<atrapos::path::LimitPoint> all;
    for (const auto& s : steps) all.insert(all.end(), s.limitPoints.begin(), s.limitPoints.end());
    return all;
  }
};

/// Bifurcation points in the order of the path.
inline std::vector<atrapos::path::CriticalPoint> criticalPoints(const Record& record) {
  std::vector<atrapos::path::CriticalPoint> all;
  for (const auto& s : record.steps) all.insert(all.end(), s.criticalPoints.begin(), s.criticalPoints.end());
  return all;
}

/// A path followed from (u, lambda) with the dense solver, and all there is to know about it.
template <class Law, class Solver = DenseSolver>
struct Followed {
  JetProblem<Law> problem;
  Solver solver;
  Record record;
  atrapos::path::Outcome outcome;

  Followed(Law law, std::vector<double> u, double lambda, atrapos::path::Options options,
           atrapos::path::Stops stops = {}, double internalWeight = 0)
      : problem(law, internalWeight) {
    atrapos::path::PathFollower follower(problem, solver, options, std::move(stops));
    outcome = follower.run({problem.vector(u), lambda}, record);
  }

  double final(int i) const { return outcome.final.u->getData()[i]; }

  /// Largest relative residual at `samples` points inside every step.
  double worstInside(int samples = 20) {
    auto u = problem.vector({}), r = problem.vector({});
    double worst = 0;
    for (std::size_t s = 0; s < record.steps.size(); ++s)
      for (int i = 0; i <= samples; ++i) {
        const double lambda = record.series[s].evaluate(record.steps[s].length * i / samples, *u);
        worst = std::max(worst, problem.residual({u, lambda}, *r).relative());
      }
    return worst;
  }
};
