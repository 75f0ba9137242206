// Decks whose path is followed by Newton steps: what they write, how they go on, what they refuse.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "support/Command.hpp"
#include "support/Folder.hpp"
#include "support/SmallDeck.hpp"

namespace atrapos::test {
namespace {

std::string withMethod(const std::string& method) {
  return edited(edited(kSmallDeck, "order: 15", "method: " + method), "points_per_step: 2",
                "points_per_step: 1");
}

class NewtonDeck : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    writeFile(folder_ / "deck.yaml", withMethod(GetParam()));
    ASSERT_EQ(runAtrapos({"mesh", "-q", "deck.yaml"}, folder_.path()).exitCode, 0);
  }
  std::string result(const std::string& file) const { return readFile(folder_ / "deck_results" / file); }
  TemporaryFolder folder_;
};

/// One row a step end, all under the residual bound; the summary names the method and counts no orders.
TEST_P(NewtonDeck, WritesStepEnds) {
  const CommandResult r = runAtrapos({"run", "deck.yaml"}, folder_.path());
  ASSERT_EQ(r.exitCode, 0) << r.err;
  EXPECT_NE(r.out.find("load factor 0.5 reached"), std::string::npos) << r.out;
  const auto summary = nlohmann::json::parse(result("summary.json"));
  EXPECT_EQ(summary.at("method"), GetParam());
  EXPECT_FALSE(summary.contains("order"));
  EXPECT_EQ(summary.at("orders_computed"), 0);
  EXPECT_DOUBLE_EQ(summary.at("load_factor").get<double>(), 0.5);  // lambda is an unknown, too
  EXPECT_GT(summary.at("corrections"), 0);
  EXPECT_LE(summary.at("worst_residual"), 1e-8);
  const std::string path = result("path.csv");
  const int rows = static_cast<int>(std::count(path.begin(), path.end(), '\n')) - 1;
  EXPECT_EQ(rows, summary.at("steps").get<int>() + 1);  // the start has one too
}

/// A path that goes on behind a step is the same to the bit.
TEST_P(NewtonDeck, GoesOn) {
  ASSERT_EQ(runAtrapos({"run", "-q", "deck.yaml", "-o", "whole"}, folder_.path()).exitCode, 0);
  const CommandResult r =
      runAtrapos({"run", "-q", "deck.yaml", "--restart", "whole", "--from", "3", "-o", "on"}, folder_.path());
  ASSERT_EQ(r.exitCode, 0) << r.err;
  for (const char* file : {"path.csv", "points.csv", "steps.csv", "restart.bin"})
    EXPECT_TRUE(readFile(folder_ / "whole" / file) == readFile(folder_ / "on" / file)) << file;
}

/// What `check` prints reads back.
TEST_P(NewtonDeck, PrintsDecksThatReadBack) {
  const CommandResult once = runAtrapos({"check", "deck.yaml"}, folder_.path());
  ASSERT_EQ(once.exitCode, 0) << once.err;
  EXPECT_NE(once.out.find(std::string("method: ") + GetParam()), std::string::npos) << once.out;
  writeFile(folder_ / "printed.yaml", once.out);
  const CommandResult twice = runAtrapos({"check", "printed.yaml"}, folder_.path());
  ASSERT_EQ(twice.exitCode, 0) << twice.err;
  EXPECT_EQ(once.out.substr(0, once.out.find("\n#")), twice.out.substr(0, twice.out.find("\n#")));
}

INSTANTIATE_TEST_SUITE_P(Kinds, NewtonDeck, testing::Values("newton", "modified_newton"),
                         [](const auto& info) { return std::string(info.param); });

/// The command refuses the deck in one line that begins with its place and the key.
void refuses(const std::string& deck, const std::string& line) {
  const TemporaryFolder folder;
  writeFile(folder / "deck.yaml", deck);
  const CommandResult r = runAtrapos({"check", "deck.yaml"}, folder.path());
  EXPECT_EQ(r.exitCode, 2);
  ASSERT_EQ(r.errorLines().size(), 1u) << r.err;
  EXPECT_EQ(r.err.find("deck.yaml:"), 0u) << r.err;
  EXPECT_EQ(r.err.find(line), r.err.find_first_not_of("0123456789: ", r.err.find(':'))) << r.err;
}

TEST(NewtonDecks, RefuseWhatOnlySeriesHave) {
  const std::string deck = withMethod("newton");
  for (const char* setting : {"order: 20", "pade: on", "critical_points: every_step", "branches: all",
                              "branch_depth: 1", "branch_count: 1", "imperfections: 0.1", "sharpen: 0.1"}) {
    const std::string key = std::string(setting).substr(0, std::string(setting).find(':'));
    refuses(edited(deck, "residual:", std::string(setting) + "\n  residual:"),
            "path/" + key + ": needs method: series, the deck has method: newton");
  }
  refuses(edited(deck, "points_per_step: 1", "points_per_step: 4"),
          "output/points_per_step: Newton steps have points at their ends only; expected 1, or path/method: "
          "series");
  refuses(edited(deck, "{tool: roll, set: z_min, stiffness: 1000, regularisation: 1.0e-3}",
                 "{tool: roll, set: z_min, points: nodes, law: hard}"),
          "contact/lower/law: hard contact needs path/method: series");
  refuses(edited(deck, "method: newton", "method: secant"),
          "path/method: 'secant' is not a choice here; expected one of series, newton");
}

TEST(NewtonDecks, HaveNoMap) {
  const TemporaryFolder folder;
  writeFile(folder / "deck.yaml", "problem: {name: von_mises_truss}\npath: {method: newton}\n");
  ASSERT_EQ(runAtrapos({"run", "-q", "deck.yaml"}, folder.path()).exitCode, 0);
  const CommandResult r = runAtrapos({"map", "deck.yaml"}, folder.path());
  EXPECT_EQ(r.exitCode, 2);
  EXPECT_NE(r.err.find("path/method: the map varies the settings of series; expected series"),
            std::string::npos)
      << r.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "map.csv"));
}

}  // namespace
}  // namespace atrapos::test
