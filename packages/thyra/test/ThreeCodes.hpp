#pragma once

#include <gtest/gtest.h>

#include <Tpetra_Vector.hpp>
#include <string>
#include <vector>

#include "LocaRun.hpp"
#include "atrapos/path/NewtonFollower.hpp"
#include "atrapos/path/PathFollower.hpp"

namespace atrapos::thyra::test {

/// Keeps the limit points.
struct Limits final : path::Observer {
  std::vector<double> lambda;
  bool onStep(const path::StepReport& report, const path::Series&) override {
    for (const auto& p : report.limitPoints) lambda.push_back(p.lambda);
    return true;
  }
};

/// Costs of a path, for the test's report.
inline void record(const std::string& who, int steps, long long factorizations, long long solves) {
  testing::Test::RecordProperty(who + "_steps", steps);
  testing::Test::RecordProperty(who + "_factorizations", std::to_string(factorizations));
  testing::Test::RecordProperty(who + "_solves", std::to_string(solves));
}

inline path::Outcome withSeries(path::Problem& problem, const path::State& start, const path::Stops& stops,
                                Limits& limits, linear::TangentSolver& solver) {
  const auto outcome = path::PathFollower(problem, solver, {}, stops).run(start, limits);
  EXPECT_EQ(outcome.reason, path::EndReason::stopReached) << outcome.text;
  record("series", outcome.steps, outcome.factorizations, outcome.solves);
  return outcome;
}

inline path::Outcome withNewton(path::Problem& problem, const path::State& start, const path::Stops& stops,
                                Limits& limits, linear::TangentSolver& solver, path::NewtonOptions options) {
  const auto outcome = path::NewtonFollower(problem, solver, options, stops).run(start, limits);
  EXPECT_EQ(outcome.reason, path::EndReason::stopReached) << outcome.text;
  record("newton", outcome.steps, outcome.factorizations, outcome.solves);
  return outcome;
}

}  // namespace atrapos::thyra::test
