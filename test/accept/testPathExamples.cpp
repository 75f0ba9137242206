// examples/path/*.yaml as shipped: each reaches its stop with default settings, finds the bifurcation points
// that are known, and spends no more factorizations on them than allowed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>

#include "atrapos/exodus/ResultReader.hpp"
#include "support/ExampleRun.hpp"

namespace atrapos::test {
namespace {

const double kFold = 2 / (3 * std::sqrt(3.0));

/// Load factors of the bifurcation points that are known, of all branches; decks that are not named have
/// none.
const std::map<std::string, std::vector<double>> kKnown{
    {"sway_truss", {std::sqrt(0.125), -std::sqrt(0.125)}},
    {"hill_top", {kFold, -kFold}},
    {"euler_column", {2.531151299}},
    {"euler_column_both", {2.531151299}},
    {"euler_column_solid", {1.10394464}},
    {"euler_column_crooked", {1.10394464}},
    {"shallow_arch", {12.48528137, -4.48528137}},
    {"arch_solid", {2.6352, -1.2046}},
    {"pitchfork", {0.575}},
    {"pitchfork_side_branch", {0.575}},
    {"transcritical", {0.575}},
    {"two_modes", {0.575, 1.143, 0.943, 0.943}},
    {"three_modes", {0.575}},
    {"square_plate", {0.575}},
    {"strut_on_foundation", {5}},
    // 4 pi^2 EI / (9 L^2) of a slender column; the load factor counts 75
    {"partial_follower", {4 * M_PI * M_PI / 9 * 17.5 / 75}},
    // six on the symmetric path; those of its branches in pairs, one the mirror image of the other
    {"hinged_roof",
     {0.1737883359, 0.1749822846, -0.003883845632, -0.08126093601, -0.09548473323, -0.07447288959,
      0.150246467, 0.150246467, 0.1223973955, 0.1223973955, 0.05918176749, 0.05918176749, 0.01986415314,
      0.01986415314, -0.08414962756, -0.08414962756, -0.01972561091, -0.01972561091}}};

/// Factorizations of searches that find nothing: next to the point of the straight column an eigenvalue comes
/// close to zero and turns.
const std::map<std::string, int> kInVain = {{"euler_column_imperfect", 2}};

/// Paths whose load only rises along every branch. (So it does along partial_follower's, which begin so flat
/// that the bound of the residual allows for a maximum.)
const std::set<std::string> kWithoutLimitPoints = {
    "euler_column",         "euler_column_both", "euler_column_imperfect", "euler_column_solid",
    "euler_column_crooked", "pitchfork",         "square_plate",           "branch_trap"};

/// What one run spends: at most two factorizations to locate a point, each time it is met, and two to switch
/// to a branch.
void checkCosts(const ExampleRun& run, int inVain) {
  const auto& s = run.summary;
  EXPECT_EQ(s.at("unexplained_sign_changes"), 0);
  int located = 0;
  const Table points(run.folder.results("points.csv"));
  for (const double nullity : points.column("nullity")) located += nullity > 0;
  EXPECT_LE(s.at("critical_factorizations").get<int>(), 2 * located + inVain);
  int switches = 0;
  for (const auto& branch : s.at("branches"))
    switches += branch.value("depth", 0) > 0 && branch.value("imperfection", 0.0) == 0;
  EXPECT_LE(s.at("switch_factorizations").get<int>(), 2 * switches);
  EXPECT_LE(s.at("worst_residual").get<double>(), s.at("residual_bound").get<double>());
  // Nothing else than steps, their corrections and what is named.
  int steps = 0;
  for (const char* part : {"steps", "start_iterations", "corrections", "restarts", "retreats", "closings",
                           "critical_factorizations", "switch_factorizations"})
    steps += s.at(part).get<int>();
  const int tried = static_cast<int>(s.at("branches").size());  // a last series that became no step
  EXPECT_LE(s.at("factorizations").get<int>(), steps + tried);
}

TEST(PathExamples, PointsAndWhatTheyCost) {
  std::set<std::string> decks;
  for (const auto& entry : std::filesystem::directory_iterator(ATRAPOS_EXAMPLES_FOLDER "/path"))
    if (entry.path().extension() == ".yaml") decks.insert(entry.path().stem());
  EXPECT_GE(decks.size(), 20u);
  for (const auto& [name, loads] : kKnown) EXPECT_TRUE(decks.count(name)) << name;
  for (const std::string& name : decks) {
    SCOPED_TRACE(name);
    const ExampleRun run("path/" + name + ".yaml");
    if (kWithoutLimitPoints.count(name)) {
      EXPECT_EQ(run.summary.at("limit_points"), 0);
    }
    checkCosts(run, kInVain.count(name) ? kInVain.at(name) : 0);
    std::vector<double> found, known;
    for (const auto& point : run.summary.at("points")) found.push_back(point.at("load_factor"));
    if (kKnown.count(name)) known = kKnown.at(name);
    std::sort(found.begin(), found.end());
    std::sort(known.begin(), known.end());
    ASSERT_EQ(found.size(), known.size());
    for (std::size_t i = 0; i < found.size(); ++i)
      // The digits that docs/examples_path.md gives; points are refined to far more. The columns' shortening
      // and shear is 1.6e-4 of their load.
      EXPECT_NEAR(found[i], known[i], 5e-4);
  }
}

/// A tangent that is not symmetric: its unstable eigenvalues are in path.csv and in the result files.
TEST(PathExamples, StabilityUnderALoadThatFollows) {
  const ExampleRun run("path/partial_follower.yaml");
  const double buckling = run.summary.at("points").at(0).at("load_factor");
  EXPECT_EQ(run.summary.at("points").at(0).at("negative_change"), 1);
  const auto load = run.column("load_factor"), negative = run.column("negative_eigenvalues"),
             branch = run.column("branch");
  int before = 0, behind = 0;
  for (std::size_t i = 0; i < load.size(); ++i) {
    if (branch[i] != 0) {
      EXPECT_EQ(negative[i], 0) << load[i];  // the bent column is stable
      continue;
    }
    (load[i] < buckling ? before : behind) += 1;
    EXPECT_EQ(negative[i], load[i] < buckling ? 0 : 1) << load[i];
  }
  EXPECT_GT(before, 0);
  EXPECT_GT(behind, 0);
  const exodus::ResultReader results(run.folder.results("results.exo").string());
  const int last = results.numSteps() - 1;
  EXPECT_EQ(results.global(0, "negative_pivots"), 0);
  EXPECT_EQ(results.global(last, "negative_pivots"), 1);
}

}  // namespace
}  // namespace atrapos::test
