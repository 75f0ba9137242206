#include <gtest/gtest.h>

#include <Tpetra_Vector.hpp>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "CsvRows.hpp"
#include "PathCase.hpp"
#include "PathSamples.hpp"
#include "atrapos/linear/MakeTangentSolver.hpp"
#include "atrapos/path/PathFollower.hpp"

namespace atrapos::bench {
namespace {

/// The judge finds the displacement that a point of the path was given, and the tightest path to be nearest.
TEST(PathSamples, DistanceIsThatOfAKnownDisplacement) {
  const PathCase c = makePathCase("roof", 1);
  const auto solver = linear::makeTangentSolver({});
  path::Options options;
  options.delta = options.residualBound = 1e-9;
  path::Stops stops;
  stops.loadFactors = {0.5};
  PathSamples samples(0.2);
  const auto outcome = path::PathFollower(*c.problem, *solver, options, stops)
                           .run({c.problem->initialState(0.0), 0.0}, samples);
  ASSERT_GE(samples.samples().size(), 2u);
  const double own = worstDistance(*c.problem, *solver, samples, outcome.weight);
  EXPECT_LT(own, 1e-6);  // residuals of 1e-9, amplified by the membrane's stiffness over that of bending
  for (const double shift : {1e-4, 1e-3}) {
    // Normal to the tangent: (dU, dlambda) = (0, 1) less its part along the tangent.
    auto sample = samples.samples()[1];
    const auto& t = sample.tangent;
    const std::vector<double> none;
    const double square =
        outcome.weight * c.problem->inner({t.x.u, none}, {t.x.u, none}) + t.lambda * t.lambda;
    const double along = t.lambda / square;
    const auto u = Teuchos::rcp(new path::Vector(*sample.state.u, Teuchos::Copy));
    u->update(-shift * along, *t.x.u, 1);
    sample.state = {u, sample.state.lambda + shift * (1 - along * t.lambda)};
    const double expected = shift * std::sqrt(1 - t.lambda * t.lambda / square);
    // To the own error of the sample.
    EXPECT_NEAR(distanceToPath(*c.problem, *solver, sample, outcome.weight), expected, 2e-6) << shift;
  }
}

/// The refinement chosen has about the unknowns asked for.
TEST(PathCase, HasTheSizeAskedFor) {
  for (const std::string& name : pathCases())
    for (const double unknowns : {10000.0, 20000.0}) {
      const PathCase c = makePathCase(name, refinementFor(name, unknowns));
      EXPECT_NEAR(c.problem->numFreeDofs(), unknowns, 0.2 * unknowns) << name;  // whole refinements
    }
}

/// `bench_path --quick`: every method reaches the end, and what claims an accuracy has about that.
TEST(BenchPath, QuickRunWritesTheTable) {
  const std::string csv = testing::TempDir() + "bench_path_quick.csv";
  std::remove(csv.c_str());
  const std::string command =
      std::string(ATRAPOS_BENCH_PATH) + " --quick --cases roof --samples 20 --csv " + csv + " > /dev/null";
  ASSERT_EQ(std::system(command.c_str()), 0);
  const auto rows = csvRows(csv);
  ASSERT_GE(rows.size(), 5u);
  for (auto row : rows) {
    EXPECT_EQ(row["end"], "stopReached") << row["method"];
    EXPECT_GT(std::stoi(row["factorizations"]), 0);
    if (row["method"] == "newton" || row["method"] == "modified") {
      // The estimate is that of the middle; points, whose residual is bounded, and ends of steps add to it.
      EXPECT_LT(std::stod(row["error"]), 3 * std::stod(row["tolerance"])) << row["method"];
    }
    if (row["method"] == "series20") {
      EXPECT_LT(std::stod(row["error"]), 1e-3);
    }
  }
}

}  // namespace
}  // namespace atrapos::bench
