// examples/contact/die.yaml: a sheet between a ball and a die, hard contacts that grow over faces.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "support/ExampleRun.hpp"

namespace atrapos::test {
namespace {

ExampleRun sheet(int cells) {
  const std::string n = std::to_string(cells);
  return ExampleRun("contact/die.yaml", {{"[24, 24]", "[" + n + ", " + n + "]"}});
}

/// The same for all tests.
const ExampleRun& coarseSheet() {
  static const ExampleRun run = sheet(12);
  return run;
}

TEST(Die, IsReached) {
  const ExampleRun& run = coarseSheet();
  EXPECT_EQ(run.column("load_factor").back(), 15);
  EXPECT_LE(run.summary.at("worst_residual"), 1e-6);
  EXPECT_LE(run.summary.at("steps"), 20);  // 16
  EXPECT_LE(run.summary.at("factorizations"),
            run.summary.at("steps").get<int>() + 2);  // nothing was tried twice
  EXPECT_EQ(run.summary.at("unexplained_sign_changes"), 0);
}

/// Pressures of the contacts against reactions, which are forces of the elements.
TEST(Die, ForcesAreInEquilibrium) {
  const ExampleRun& run = coarseSheet();
  const auto punch = run.column("punch"), die = run.column("die"), x = run.column("edge_x"),
             y = run.column("edge_y"), corner = run.column("corner");
  double largest = 0;
  for (std::size_t i = 0; i < punch.size(); ++i) {
    EXPECT_LE(punch[i], 0);
    EXPECT_GE(die[i], 0);
    largest = std::max(largest, std::abs(punch[i]));
    EXPECT_NEAR(punch[i] + die[i] + x[i] + y[i] - corner[i], 0, 1e-5 * largest) << i;
  }
  EXPECT_GT(largest, 2e4);
}

/// As the mesh is refined: 25.58, 25.84, 27.17 and 27.62 kN with 12, 16, 24 and 32 cells along a side.
TEST(Die, ForceOnFinerCells) {
  const double coarse = coarseSheet().column("punch").back(), fine = sheet(16).column("punch").back();
  EXPECT_NEAR(fine, coarse, 0.05 * std::abs(coarse));
}

}  // namespace
}  // namespace atrapos::test
