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

TEST_F(MapTest, BadWords) {
  writeFile(folder_ / "truss.yaml", "problem: {name: von_mises_truss}\n");
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases{
      {{"map"}, "DECK is required"},
      {{"map", "nowhere.yaml"}, "No such file"},
      {{"map", "truss.yaml", "--orders", "10,many"}, "--orders 'many'"},
      {{"map", "truss.yaml", "--orders", "70"}, "--orders '70'"},
      {{"map", "truss.yaml", "--deltas", "2"}, "--deltas '2'"},
      {{"map", "truss.yaml", "--pade", "maybe"}, "--pade 'maybe'"}};
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
