// Decks that follow branches: the diagram in path.csv, points.csv, branches.csv, summary.json and the result
// files.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "atrapos/exodus/ResultReader.hpp"
#include "support/Command.hpp"
#include "support/Folder.hpp"

namespace atrapos::test {
namespace {

/// A table of comma-separated values: rows of words, by the header's names.
std::vector<std::map<std::string, std::string>> rows(const std::filesystem::path& file) {
  std::istringstream in(readFile(file));
  const auto words = [](const std::string& line) {
    std::vector<std::string> list;
    std::istringstream parts(line);
    for (std::string word; std::getline(parts, word, ',');) list.push_back(word);
    return list;
  };
  std::string line;
  std::getline(in, line);
  const auto header = words(line);
  std::vector<std::map<std::string, std::string>> table;
  while (std::getline(in, line)) {
    const auto values = words(line);
    EXPECT_EQ(values.size(), header.size()) << line;
    auto& row = table.emplace_back();
    for (std::size_t i = 0; i < std::min(values.size(), header.size()); ++i) row[header[i]] = values[i];
  }
  return table;
}

double number(const std::map<std::string, std::string>& row, const std::string& name) {
  return std::stod(row.at(name));
}

class BranchDeck : public testing::Test {
 protected:
  nlohmann::json run(const std::string& deck) {
    writeFile(folder_ / "deck.yaml", deck);
    const CommandResult r = runAtrapos({"run", "deck.yaml"}, folder_.path());
    EXPECT_EQ(r.exitCode, 0) << r.err;
    out_ = r.out;
    return nlohmann::json::parse(readFile(folder_ / "deck_results" / "summary.json"));
  }
  std::vector<std::map<std::string, std::string>> table(const std::string& name) const {
    return rows(folder_ / "deck_results" / name);
  }
  TemporaryFolder folder_;
  std::string out_;
};

TEST_F(BranchDeck, TrussThatSways) {
  const auto summary = run("problem: {name: sway_truss}\npath: {branches: all}\n");
  ASSERT_EQ(summary.at("branches").size(), 2u);
  ASSERT_EQ(summary.at("points").size(), 2u);
  EXPECT_EQ(summary.at("limit_points").get<int>() >= 2, true);
  EXPECT_EQ(summary.at("branches")[1].at("end"), "joined");
  EXPECT_EQ(summary.at("branches_complete"), true);
  // x = 1 -+ sqrt(1 - 2 b^2), lambda = x (1 - x) (2 - x); points are exact to rounding.
  for (const int i : {0, 1}) {
    const double x = 1 + (i == 0 ? -1 : 1) * std::sqrt(0.5);
    EXPECT_NEAR(summary.at("points")[i].at("load_factor"), x * (1 - x) * (2 - x), 1e-10);
    EXPECT_NEAR(summary.at("points")[i].at("monitors").at("sinking"), x, 1e-10);
    EXPECT_EQ(summary.at("points")[i].at("kind"), "pitchfork");
  }
  // Between the two points the straight truss has one negative eigenvalue, or two beyond its limit points.
  std::set<std::string> seen;
  for (const auto& row : table("path.csv")) {
    const double x = number(row, "sinking");
    const int negative = std::stoi(row.at("negative_eigenvalues"));
    seen.insert(row.at("branch"));
    if (row.at("branch") != "0") continue;
    const bool sways = std::abs(x - 1) < std::sqrt(0.5), snaps = std::abs(x - 1) < std::sqrt(1.0 / 3);
    EXPECT_EQ(negative, int(sways) + int(snaps)) << "x = " << x;
  }
  EXPECT_EQ(seen, (std::set<std::string>{"0", "1"}));
  const auto branches = table("branches.csv");
  ASSERT_EQ(branches.size(), 2u);
  EXPECT_EQ(branches[1].at("parent"), "0");
  EXPECT_EQ(branches[1].at("kind"), "pitchfork");
  EXPECT_NE(out_.find("branch 1: from the pitchfork on branch 0"), std::string::npos) << out_;
  int pitchforks = 0, folds = 0;
  for (const auto& row : table("points.csv")) {
    pitchforks += row.at("kind") == "pitchfork" && row.at("branch") == "0";
    if (row.at("kind") != "maximum" && row.at("kind") != "minimum") continue;
    if (row.at("branch") != "0") continue;
    ++folds;
    // 2 sqrt(3) / 9; the path's residual bound is 1e-6, the load is flat there.
    EXPECT_NEAR(std::abs(number(row, "load_factor")), 2 / (3 * std::sqrt(3.0)), 1e-6);
  }
  EXPECT_EQ(pitchforks, 2);
  EXPECT_EQ(folds, 2);
}

TEST_F(BranchDeck, StableOnesOnlyAndLimits) {
  const std::string deck = "problem: {name: sway_truss}\npath: {branches: stable}\n";
  const auto stable = run(deck);
  for (std::size_t b = 1; b < stable.at("branches").size(); ++b) {
    EXPECT_EQ(stable.at("branches")[b].at("end"), "notStable");
    EXPECT_EQ(stable.at("branches")[b].at("steps"), 0);
  }
  const auto none = run("problem: {name: sway_truss}\npath: {branches: all, branch_count: 0}\n");
  EXPECT_EQ(none.at("branches").size(), 1u);
  EXPECT_EQ(none.at("branches_complete"), false);
  const auto shallow = run("problem: {name: sway_truss}\npath: {branches: all, branch_depth: 0}\n");
  EXPECT_EQ(shallow.at("branches").size(), 1u);
}

TEST_F(BranchDeck, ColumnOfSolids) {
  const std::string example = std::string(ATRAPOS_EXAMPLES) + "/path/euler_column_solid.yaml";
  writeFile(folder_ / "deck.yaml", readFile(example));
  ASSERT_EQ(runAtrapos({"mesh", "-q", "deck.yaml"}, folder_.path()).exitCode, 0);
  const auto summary = run(readFile(example));
  ASSERT_GE(summary.at("points").size(), 1u);
  // pi^2 EI / (4 L^2); the Saint Venant-Kirchhoff solid is shortened and sheared before it buckles, and 10
  // elements are a little stiff: together below two per cent of the slender column's load.
  const double EI = 210000.0 * 8 * 64 / 12, exact = M_PI * M_PI * EI / 4e4 / 2000;
  EXPECT_NEAR(summary.at("points")[0].at("load_factor"), exact, 0.02 * exact);
  ASSERT_GE(summary.at("branches").size(), 3u);
  // The two halves are mirror images: the same load where the top has moved by 50.
  std::vector<double> ends, loads;
  for (const int b : {1, 2}) {
    EXPECT_EQ(summary.at("branches")[b].at("ended"), "stopReached");
    loads.push_back(summary.at("branches")[b].at("load_factor"));
    const exodus::ResultReader fields(
        (folder_ / "deck_results" / ("results_branch" + std::to_string(b) + ".exo")).string());
    EXPECT_EQ(fields.numSteps(), summary.at("branches")[b].at("steps").get<int>() + 1);
    for (int s = 0; s < fields.numSteps(); ++s) {
      EXPECT_EQ(fields.global(s, "branch"), b);
      EXPECT_EQ(fields.global(s, "negative_pivots"), 0);
    }
  }
  // Relative residual bound 1e-6, on a column that is soft in bending.
  EXPECT_NEAR(loads[0], loads[1], 1e-5 * loads[0]);
  for (const auto& row : table("path.csv")) {
    const int branch = std::stoi(row.at("branch"));
    if (branch != 0) continue;
    EXPECT_EQ(number(row, "negative_eigenvalues") > 0,
              number(row, "load_factor") > summary.at("points")[0].at("load_factor"))
        << row.at("load_factor");
  }
  // A second run without branches: what those of the first left is gone.
  const auto alone = run(edited(readFile(example), "branches: all", "branches: none"));
  EXPECT_EQ(alone.at("branches").size(), 1u);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "deck_results" / "results_branch1.exo"));
}

/// Perfect path, both halves of its branch and both imperfect paths in one deck: v + 0.3 v^2 - x^2/2 =
/// lambda, (1/2 - v) x + x^3 = eps with x the mode. At the start K_T = 1/2 in x, so that a deflection d needs
/// eps = d/2.
TEST_F(BranchDeck, PerfectAndImperfect) {
  const auto summary =
      run("problem: {name: pitchfork}\npath: {branches: all, imperfections: [0.01, -0.01]}\n");
  ASSERT_EQ(summary.at("branches").size(), 5u);
  const auto branches = table("branches.csv");
  for (const int b : {0, 1, 2}) EXPECT_EQ(branches[b].at("imperfection"), "0");
  for (const int b : {3, 4}) {
    const double size = b == 3 ? 0.01 : -0.01;
    EXPECT_EQ(summary.at("branches")[b].at("imperfection"), size);
    EXPECT_EQ(branches[b].at("kind"), "imperfect");
    EXPECT_EQ(branches[b].at("parent"), "-1");
    int rows = 0;
    for (const auto& row : table("path.csv")) {
      if (row.at("branch") != std::to_string(b)) continue;
      ++rows;
      const double x = number(row, "mode_1"), lambda = number(row, "load_factor");
      const double v = 0.5 + x * x - 0.5 * size / x;
      // The residual bound 1e-6 over forces of size 0.1, over the slope d(lambda)/dx of the curve.
      EXPECT_NEAR(lambda, v + 0.3 * v * v - 0.5 * x * x, 1e-5 * (1 + std::abs(0.5 * size / (x * x)))) << x;
      EXPECT_GT(x * size, 0) << "it bends to the side of the imperfection";
      EXPECT_EQ(row.at("negative_eigenvalues"), "0");
    }
    EXPECT_GT(rows, 10);
    EXPECT_EQ(summary.at("branches")[b].at("ended"), "stopReached");
  }
  EXPECT_NE(out_.find("branch 3: the path with imperfection 0.01"), std::string::npos) << out_;

  writeFile(folder_ / "deck.yaml", "problem: {name: von_mises_truss}\npath: {imperfections: 0.01}\n");
  const CommandResult none = runAtrapos({"run", "-q", "deck.yaml"}, folder_.path());
  EXPECT_EQ(none.exitCode, 3);
  EXPECT_NE(none.err.find("no bifurcation point was found"), std::string::npos) << none.err;
  EXPECT_TRUE(std::filesystem::exists(folder_ / "deck_results" / "path.csv"));
}

TEST_F(BranchDeck, ProblemsAndTheirParameters) {
  const auto summary =
      run("problem: {name: bratu_1d, parameters: {points: 20}}\n"
          "path: {accuracy: 1.0e-8, residual: 1.0e-10, stop: {monitor: {middle: 2}}}\n");
  EXPECT_EQ(summary.at("unknowns"), 20);
  const auto points = table("points.csv");
  ASSERT_EQ(points.size(), 1u);
  EXPECT_EQ(points[0].at("kind"), "maximum");
  // Fold of -u'' = lambda exp(u) to 13 digits (computed independently); collocation of 40 points is exact to
  // rounding, the path to its residual bound.
  EXPECT_NEAR(number(points[0], "load_factor"), 3.513830719125161, 1e-8);
  EXPECT_NEAR(number(table("path.csv").back(), "middle"), 2, 1e-12);
}

TEST_F(BranchDeck, LimitPointsOfMonitors) {
  run("problem: {name: truss_on_spring, parameters: {stiffness: 0.3}}\npath: {residual: 1.0e-9, accuracy: "
      "1.0e-8}\n");
  // The load's point z = x + x (1 - x) (2 - x) / k turns where 3 x^2 - 6 x + 2 + k = 0.
  const double k = 0.3, r = std::sqrt((1 - k) / 3);
  int maxima = 0, minima = 0;
  for (const auto& row : table("points.csv")) {
    const bool maximum = row.at("kind") == "maximum:load_point",
               minimum = row.at("kind") == "minimum:load_point";
    maxima += maximum;
    minima += minimum;
    // Flat in x: the root of the residual bound.
    if (!maximum && !minimum) continue;
    EXPECT_NEAR(number(row, "sinking"), maximum ? 1 - r : 1 + r, 1e-4);
  }
  EXPECT_EQ(maxima, 1);
  EXPECT_EQ(minima, 1);
}

TEST_F(BranchDeck, ProblemDecksThatAreWrong) {
  const std::vector<std::pair<std::string, std::vector<std::string>>> cases{
      {"problem: {name: bratu}", {"problem/name", "'bratu' is not a choice", "bratu_1d"}},
      {"problem: {}", {"problem"}},
      {"problem: {name: bratu_1d, parameters: {pints: 3}}",
       {"problem/parameters/pints", "did you mean 'points'"}},
      {"problem: {name: bratu_1d, parameters: {points: 2.5}}", {"problem/parameters", "points = 2.5"}},
      {"problem: {name: bratu_1d}\nmesh: {file: a.exo}", {"mesh", "is not a key here"}},
      {"problem: {name: bratu_1d}\npath: {stop: {monitor: {top: 1}}}", {"path/stop/monitor/top", "middle"}},
      {"problem: {name: bratu_1d}\npath: {stop: {displacement: {middle: 1}}}", {"path/stop/displacement"}},
      {"problem: {name: bratu_1d}\npath: {order: best}", {"path/order", "auto", "'best'"}},
      {"problem: {name: bratu_1d}\npath: {pade: yes}", {"path/pade", "off, automatic, on"}},
      {"problem: {name: bratu_1d}\npath: {weight: 0}", {"path/weight", "positive"}},
      {"problem: {name: sway_truss}\npath: {branches: all, critical_points: off}",
       {"path/branches", "critical_points"}},
      {"problem: {name: sway_truss}\npath: {branches: all}\nsolver: {type: amesos2, name: klu2}",
       {"path/branches", "mumps"}}};
  for (const auto& [deck, words] : cases) {
    SCOPED_TRACE(deck);
    writeFile(folder_ / "deck.yaml", deck + "\n");
    const CommandResult r = runAtrapos({"run", "deck.yaml"}, folder_.path());
    EXPECT_EQ(r.exitCode, 2);
    ASSERT_EQ(r.errorLines().size(), 1u) << r.err;
    for (const auto& word : words) EXPECT_NE(r.err.find(word), std::string::npos) << word << ": " << r.err;
  }
  writeFile(folder_ / "deck.yaml", "problem: {name: bratu_1d}\n");
  const CommandResult mesh = runAtrapos({"mesh", "deck.yaml"}, folder_.path());
  EXPECT_EQ(mesh.exitCode, 2);
  EXPECT_NE(mesh.err.find("no mesh"), std::string::npos) << mesh.err;
}

TEST_F(BranchDeck, CheckPrintsAProblemDeck) {
  writeFile(folder_ / "deck.yaml",
            "problem: {name: euler_column, parameters: {links: 12}}\npath: {order: auto}\n");
  const CommandResult r = runAtrapos({"check", "deck.yaml"}, folder_.path());
  EXPECT_EQ(r.exitCode, 0) << r.err;
  for (const char* word : {"links: 12", "order: auto", "# unknowns  13", "# monitor   tip_rotation"})
    EXPECT_NE(r.out.find(word), std::string::npos) << word << " is not in:\n" << r.out;
  writeFile(folder_ / "printed.yaml", r.out);
  EXPECT_EQ(runAtrapos({"check", "printed.yaml"}, folder_.path()).out,
            edited(r.out, "title: deck", "title: deck"));
}

/// Of four held corners one is missing: a single shell element has a motion without strains, which no support
/// as a rigid body stops. The message names its nodes.
TEST_F(BranchDeck, AMechanismIsNamed) {
  writeFile(folder_ / "deck.yaml", R"(mesh:
  file: deck.exo
  generate: {shape: shell_plate, length: 10, width: 10, divisions: [1, 1], block: plate}
materials:
  steel: {law: saint_venant_kirchhoff, youngs_modulus: 210000, poissons_ratio: 0.3, blocks: [plate]}
shells:
  sections:
    skin: {blocks: [plate], thickness: 0.5}
supports:
  a: {set: x_min_y_min, x: 0, y: 0, z: 0}
  b: {set: x_max_y_min, x: 0, y: 0, z: 0}
  c: {set: x_min_y_max, x: 0, y: 0, z: 0}
loads:
  push: {type: edge, set: x_max, total: [0, 0, 1]}
path: {stop: {load_factor: 1}}
)");
  EXPECT_EQ(runAtrapos({"mesh", "deck.yaml"}, folder_.path()).exitCode, 0);
  const CommandResult r = runAtrapos({"run", "deck.yaml"}, folder_.path());
  EXPECT_NE(r.exitCode, 0);
  const std::string why =
      nlohmann::json::parse(readFile(folder_ / "deck_results" / "summary.json")).at("why");
  EXPECT_NE(why.find("largest entries of its null vector: director's change "), std::string::npos) << why;
  EXPECT_NE(why.find(" at node "), std::string::npos) << why;
}

/// Three null vectors: told in the step's line and in points.csv, none of the branches is followed.
TEST_F(BranchDeck, ThreeModesAtOnce) {
  const auto summary = run("problem: {name: three_modes}\npath: {branches: all}\n");
  EXPECT_EQ(summary.at("ended"), "stopReached");
  ASSERT_EQ(summary.at("points").size(), 1u);
  EXPECT_EQ(summary.at("points")[0].at("kind"), "multiple");
  EXPECT_EQ(summary.at("points")[0].at("nullity"), 3);
  EXPECT_EQ(summary.at("points")[0].at("negative_change"), 3);
  EXPECT_EQ(summary.at("branches").size(), 1u);
  for (const char* word :
       {"3 null vectors", "the directions of the branches at load factor", "none is followed"})
    EXPECT_NE(out_.find(word), std::string::npos) << word << " is not in:\n" << out_;
  int multiple = 0;
  for (const auto& row : table("points.csv"))
    multiple += row.at("kind") == "multiple" && row.at("nullity") == "3";
  EXPECT_EQ(multiple, 1);
}

}  // namespace
}  // namespace atrapos::test
