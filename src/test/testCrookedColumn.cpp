// Imperfect geometry: columns whose nodes are moved by the buckling mode, against Young's amplification of
// their deflection and the straight column's own curve.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "atrapos/exodus/MeshFile.hpp"
#include "atrapos/exodus/ResultReader.hpp"
#include "support/Command.hpp"
#include "support/Folder.hpp"

namespace atrapos::test {
namespace {

constexpr const char* kColumn = R"(
mesh:
  file: column.exo
  generate: {shape: box, lengths: [100, 8, 4], origin: [0, -4, -2], divisions: [6, 1, 1], cell: HEX20}
materials:
  steel: {law: saint_venant_kirchhoff, youngs_modulus: 210000, poissons_ratio: 0, blocks: [body]}
supports:
  foot: {set: x_min, x: 0, y: 0, z: 0}
  plane: {set: y_min, y: 0}
loads:
  top: {type: surface, set: x_max, total: [-2000, 0, 0]}
path:
  branches: stable
  weight: 1.0e-4
  imperfections: [0.1, -0.2]
  imperfections_as: geometry
  stop: {load_factor: 1.3, displacement: {top_uz: [-20, 20]}}
output:
  monitors:
    top_uz: {type: displacement, set: x_max, component: z}
)";

struct Point {
  double loadFactor = 0, deflection = 0;
};

/// Output points of every branch.
std::map<int, std::vector<Point>> branches(const std::filesystem::path& results) {
  std::istringstream in(readFile(results / "path.csv"));
  std::string line;
  std::getline(in, line);
  EXPECT_EQ(line, "step,path_length,load_factor,top_uz,negative_eigenvalues,branch,residual");
  std::map<int, std::vector<Point>> all;
  while (std::getline(in, line)) {
    std::istringstream words(line);
    std::vector<std::string> row;
    for (std::string word; std::getline(words, word, ',');) row.push_back(word);
    all[std::stoi(row.at(5))].push_back({std::stod(row.at(2)), std::stod(row.at(3))});
  }
  return all;
}

class CrookedColumn : public testing::Test {
 protected:
  void run(const std::vector<std::string>& words) {
    const CommandResult r = runDeck(words, folder_.path());
    ASSERT_EQ(r.exitCode, 0) << r.err;
  }
  void SetUp() override {
    writeFile(folder_ / "deck.yaml", kColumn);
    ASSERT_EQ(runAtrapos({"mesh", "-q", "deck.yaml"}, folder_.path()).exitCode, 0);
    run({"-o", "whole"});
    summary_ = nlohmann::json::parse(readFile(folder_ / "whole" / "summary.json"));
    paths_ = branches(folder_ / "whole");
  }
  TemporaryFolder folder_;
  nlohmann::json summary_;
  std::map<int, std::vector<Point>> paths_;
};

TEST_F(CrookedColumn, DeflectsByYoungsAmplificationAndThenAsTheStraightOne) {
  const double critical = summary_.at("points").at(0).at("load_factor");
  const auto& list = summary_.at("branches");
  int crooked = 0;
  for (std::size_t b = 0; b < list.size(); ++b) {
    if (!list[b].contains("imperfection")) continue;
    ++crooked;
    const double e = list[b].at("imperfection");
    int below = 0;
    for (const Point& p : paths_.at(static_cast<int>(b))) {
      if (p.loadFactor < 0.1 * critical || p.loadFactor > 0.9 * critical) continue;
      ++below;
      // Off by 1.3e-3: the column's shortening before it buckles, strain 3.3e-4, has lowered lambda_c by four
      // times that (Euler's load of the undeformed column is 1.1055). The square of the slope, 1 % of the
      // length at most, times pi^2/32 against 1 - lambda/lambda_c = 0.1 adds as much again.
      const double w = e * p.loadFactor / (critical - p.loadFactor);
      EXPECT_NEAR(p.deflection, w, 3e-3 * std::abs(w)) << "at " << p.loadFactor << ", e = " << e;
    }
    EXPECT_GE(below, 3);
    // At 20 % of the length: as the straight column with that deflection in all, of which lambda gives w/(w +
    // e).
    const Point end = paths_.at(static_cast<int>(b)).back();
    EXPECT_NEAR(std::abs(end.deflection), 20, 1e-9);
    const double all = (end.deflection + e) / 100;
    // Two terms of the elastica's expansion; the third is of the size of (w/L)^4 = 2e-3 times 0.07, the
    // mesh's own stiffness 1e-4.
    const double straight = critical * (1 + M_PI * M_PI / 32 * all * all);
    EXPECT_NEAR(end.loadFactor, straight * end.deflection / (end.deflection + e), 1e-3 * critical);
  }
  EXPECT_EQ(crooked, 2);
}

// The undeformed body of the result files is the crooked one: its nodes are off by the mode, e at the top.
TEST_F(CrookedColumn, ResultsAreOnTheMovedMesh) {
  const auto& list = summary_.at("branches");
  for (std::size_t b = 0; b < list.size(); ++b) {
    if (!list[b].contains("imperfection")) continue;
    const double e = list[b].at("imperfection");
    const std::string file = "results_branch" + std::to_string(b) + ".exo";
    const auto straight = exodus::readMesh((folder_ / "whole" / "results.exo").string()).coordinates;
    const auto moved = exodus::readMesh((folder_ / "whole" / file).string()).coordinates;
    double largest = 0;
    for (std::size_t i = 0; i < moved.size(); ++i) {
      const double by = moved[i] - straight[i];
      if (std::abs(by) > std::abs(largest)) largest = by;
    }
    EXPECT_NEAR(largest, e, 1e-12 * 100);  // rounding of coordinates up to 100
  }
}

TEST_F(CrookedColumn, GoesOnBehindAStepOfACrookedPath) {
  const auto& list = summary_.at("branches");
  const std::string last = std::to_string(list.size() - 1), before = std::to_string(list.size() - 2);
  for (const std::string& place : {before + ":1", last + ":2"}) {
    SCOPED_TRACE(place);
    run({"--restart", "whole", "--from", place, "-o", "again"});
    for (const char* name : {"path.csv", "points.csv"})
      EXPECT_TRUE(readFile(folder_ / "again" / name) == readFile(folder_ / "whole" / name)) << name;
    const std::string file = "results_branch" + last + ".exo";
    const exodus::ResultReader a((folder_ / "again" / file).string()), b((folder_ / "whole" / file).string());
    ASSERT_EQ(a.numSteps(), b.numSteps());
    for (const auto& name : b.nodalNames())
      EXPECT_EQ(a.nodal(a.numSteps() - 1, name), b.nodal(b.numSteps() - 1, name)) << name;
  }
}

TEST_F(CrookedColumn, ModelProblemsHaveNoGeometry) {
  writeFile(folder_ / "deck.yaml",
            "problem: {name: euler_column}\npath: {imperfections: 0.01, imperfections_as: geometry}\n");
  const CommandResult r = runAtrapos({"run", "-q", "deck.yaml"}, folder_.path());
  EXPECT_EQ(r.exitCode, 2);
  ASSERT_EQ(r.errorLines().size(), 1u) << r.err;
  EXPECT_NE(r.err.find("path/imperfections_as"), std::string::npos) << r.err;
  EXPECT_NE(r.err.find("mesh"), std::string::npos) << r.err;
}

}  // namespace
}  // namespace atrapos::test
