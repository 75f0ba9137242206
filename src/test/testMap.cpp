// `atrapos map`: a row per run, what its outcomes mean, bad words.
#include <gtest/gtest.h>

#include <map>
#include <set>
#include <sstream>

#include "support/Command.hpp"
#include "support/Folder.hpp"

namespace atrapos::test {
namespace {

std::vector<std::map<std::string, std::string>> rows(const std::string& text) {
  std::istringstream in(text);
  std::string line, word;
  std::vector<std::string> header;
  std::getline(in, line);
  for (std::istringstream parts(line); std::getline(parts, word, ',');) header.push_back(word);
  std::vector<std::map<std::string, std::string>> table;
  while (std::getline(in, line)) {
    auto& row = table.emplace_back();
    std::istringstream parts(line);
    for (const auto& name : header) {
      EXPECT_TRUE(std::getline(parts, word, ',')) << line;
      row[name] = word;
    }
  }
  return table;
}

class MapTest : public testing::Test {
 protected:
  std::vector<std::map<std::string, std::string>> map(const std::vector<std::string>& words) {
    std::vector<std::string> all{"map"};
    all.insert(all.end(), words.begin(), words.end());
    const CommandResult r = runAtrapos(all, folder_.path(), 250);
    EXPECT_EQ(r.exitCode, 0) << r.err;
    out_ = r.out;
    return rows(readFile(folder_ / "map.csv"));
  }
  TemporaryFolder folder_;
  std::string out_;
};

TEST_F(MapTest, OneRowForEverySetting) {
  writeFile(folder_ / "truss.yaml", "problem: {name: von_mises_truss}\n");
  writeFile(folder_ / "sway.yaml", "title: Sway, a truss\nproblem: {name: sway_truss}\n");
  const auto table = map({"truss.yaml", "sway.yaml", "--orders", "10,20,auto", "--deltas", "1e-4,1e-8",
                          "--pade", "off,automatic"});
  ASSERT_EQ(table.size(), 2u * 3 * 2 * 2);
  std::set<std::string> settings;
  std::map<std::string, int> steps;
  for (const auto& row : table) {
    settings.insert(row.at("problem") + row.at("order") + row.at("delta") + row.at("pade"));
    EXPECT_EQ(row.at("outcome"), "end") << row.at("reason");
    EXPECT_GT(std::stoi(row.at("steps")), 0);
    EXPECT_GE(std::stoi(row.at("factorizations")), std::stoi(row.at("steps")));
    EXPECT_LE(std::stod(row.at("worst_residual")), 2 * std::stod(row.at("delta")));
    EXPECT_EQ(row.at("points_expected"), row.at("problem") == "truss" ? "0" : "2");
    if (row.at("order") != "auto" && row.at("pade") == "off")
      steps[row.at("problem") + row.at("order") + ' ' + row.at("delta")] = std::stoi(row.at("steps"));
  }
  EXPECT_EQ(settings.size(), table.size());
  // Eq. (36): a higher order or a looser bound goes further.
  EXPECT_LT(steps.at("truss20 1e-08"), steps.at("truss10 1e-08"));
  EXPECT_LT(steps.at("truss10 0.0001"), steps.at("truss10 1e-08"));
  EXPECT_NE(out_.find("truss: 12 end"), std::string::npos) << out_;
}

TEST_F(MapTest, FewStepsAreALimit) {
  writeFile(folder_ / "truss.yaml", "problem: {name: von_mises_truss}\npath: {stop: {steps: 2}}\n");
  const auto table = map({"truss.yaml", "--orders", "10", "--deltas", "1e-8", "--pade", "off"});
  ASSERT_EQ(table.size(), 1u);
  EXPECT_EQ(table[0].at("outcome"), "limit");
  EXPECT_EQ(table[0].at("steps"), "2");
}

TEST_F(MapTest, ARunThatEndsBeforeItsStopSaysWhy) {
  // Rounding alone leaves more than this of a residual.
  writeFile(folder_ / "bratu.yaml", "problem: {name: bratu_1d}\n");
  const auto table = map({"bratu.yaml", "--orders", "10", "--deltas", "1e-17", "--pade", "off"});
  ASSERT_EQ(table.size(), 1u);
  EXPECT_NE(table[0].at("outcome"), "end");
  EXPECT_NE(table[0].at("reason").find("over the bound"), std::string::npos) << table[0].at("reason");
}

/// What is hardest here: a pitchfork passed on its side branch, two branches 1e-3 apart, two bifurcation
/// points and a frame that turns back in load and displacement, with series that are short, long and at the
/// end of double precision, and bounds that see hardly a difference between the branches.
TEST_F(MapTest, WorstCasesReachTheirEnd) {
  for (const std::string name : {"pitchfork_side_branch", "branch_trap", "two_modes", "lee_frame"})
    writeFile(folder_ / (name + ".yaml"), "problem: {name: " + name + "}\n");
  const auto table = map({"pitchfork_side_branch.yaml", "branch_trap.yaml", "two_modes.yaml",
                          "lee_frame.yaml", "--orders", "5,20,30,40", "--deltas", "1e-2,1e-4,1e-7"});
  EXPECT_EQ(table.size(), 4u * 4 * 3 * 2);
  for (const auto& row : table) {
    EXPECT_EQ(row.at("outcome"), "end")
        << row.at("problem") << " K = " << row.at("order") << " delta " << row.at("delta") << " pade "
        << row.at("pade") << ": " << row.at("reason");
    EXPECT_EQ(row.at("points"), row.at("points_expected")) << row.at("problem");
  }
}

/// Every combination of the values, each with the mesh that it generates.
TEST_F(MapTest, VariesKeysOfTheDeck) {
  writeFile(folder_ / "bar.yaml",
            "mesh: {file: bar.exo, generate: {shape: box, lengths: [4, 1, 1], divisions: [2, 1, 1]}}\n"
            "materials: {m: {law: saint_venant_kirchhoff, youngs_modulus: 100, poissons_ratio: 0.3,\n"
            "  blocks: [body]}}\n"
            "supports: {left: {set: x_min, x: 0, y: 0, z: 0}}\n"
            "loads: {pull: {type: surface, set: x_max, total: [10, 0, 0]}}\n"
            "path: {stop: {load_factor: 1}}\n");
  const auto table = map({"bar.yaml", "--orders", "10", "--deltas", "1e-6", "--pade", "off", "--vary",
                          "mesh/generate/divisions=[[2, 1, 1], [4, 2, 2]]", "--vary",
                          "materials/m/poissons_ratio=[0, 0.3]"});
  ASSERT_EQ(table.size(), 4u);
  std::set<std::string> values;
  for (const auto& row : table) {
    EXPECT_EQ(row.at("outcome"), "end") << row.at("reason");
    values.insert(row.at("values"));
  }
  EXPECT_EQ(values.size(), 4u);
  EXPECT_EQ(values.count("mesh/generate/divisions=[4; 2; 2] materials/m/poissons_ratio=0.3"), 1u);
  EXPECT_NE(out_.find("bar mesh/generate/divisions=[2, 1, 1] materials/m/poissons_ratio=0: 1 end"),
            std::string::npos)
      << out_;
}

/// Stages one after another, and contact of points that get their law when they come near.
TEST_F(MapTest, StagesAndContact) {
  writeFile(folder_ / "press.yaml",
            "mesh: {file: bar.exo, generate: {shape: box, lengths: [8, 1, 1], divisions: [8, 2, 1],\n"
            "  cell: HEX20}}\n"
            "materials: {m: {law: saint_venant_kirchhoff, youngs_modulus: 1000, poissons_ratio: 0.3,\n"
            "  blocks: [body]}}\n"
            "supports: {left: {set: x_min, x: 0, y: 0, z: 0}}\n"
            "loads:\n"
            "  pull: {type: surface, set: x_max, total: [10, 0, 0]}\n"
            "tools: {ball: {type: sphere, center: [7, 0.5, 4], radius: 2.5, motion: {shift: [0, 0, -1]}}}\n"
            "contact: {top: {tool: ball, set: z_max, law: hard}}\n"
            "path:\n"
            "  stages:\n"
            "    stretch: {stop: {load_factor: 1}, drives: [pull]}\n"
            "    press: {stop: {load_factor: 2}, drives: [ball]}\n");
  ASSERT_EQ(runAtrapos({"mesh", "-q", "press.yaml"}, folder_.path()).exitCode, 0);
  const auto table = map({"press.yaml", "--orders", "10,20", "--deltas", "1e-5,1e-7", "--pade", "automatic"});
  ASSERT_EQ(table.size(), 4u);
  for (const auto& row : table) {
    EXPECT_EQ(row.at("outcome"), "end") << row.at("reason");
    EXPECT_GT(std::stoi(row.at("steps")), 3) << "of both stages";
  }
}

TEST_F(MapTest, BadWords) {
  writeFile(folder_ / "truss.yaml", "problem: {name: von_mises_truss}\n");
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases{
      {{"map"}, "DECK is required"},
      {{"map", "nowhere.yaml"}, "No such file"},
      {{"map", "truss.yaml", "--orders", "10,many"}, "--orders 'many'"},
      {{"map", "truss.yaml", "--orders", "70"}, "--orders '70'"},
      {{"map", "truss.yaml", "--deltas", "2"}, "--deltas '2'"},
      {{"map", "truss.yaml", "--pade", "maybe"}, "--pade 'maybe'"},
      {{"map", "truss.yaml", "--vary", "path/order"}, "--vary 'path/order': expected KEY=LIST"},
      {{"map", "truss.yaml", "--vary", "path/order=[3"}, "--vary 'path/order=[3'"},
      {{"map", "truss.yaml", "--vary", "path/order=3"}, "--vary 'path/order=3'"},
      {{"map", "truss.yaml", "--vary", "path/method=[series, newton]"},
       "path/method: the map varies the settings of series"},
      {{"map", "truss.yaml", "--vary", "path/none=[1]"}, "--vary path/none=1: "},
      {{"map", "truss.yaml", "--vary", "problem/name/a=[1]"}, "below what is no map"}};
  for (const auto& [words, problem] : cases) {
    const CommandResult r = runAtrapos(words, folder_.path());
    EXPECT_EQ(r.exitCode, 2);
    ASSERT_EQ(r.errorLines().size(), 1u) << r.err;
    EXPECT_NE(r.err.find(problem), std::string::npos) << r.err;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "map.csv"));
  }
}

}  // namespace
}  // namespace atrapos::test
