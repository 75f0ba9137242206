// Decks that end at limit and bifurcation points: where, what is told of them, and how runs go on behind
// them.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "support/Command.hpp"
#include "support/Folder.hpp"

namespace atrapos::test {
namespace {

/// The truss that sways, lambda = x (1 - x) (2 - x): limit points at x = 1 -+ sqrt(1/3), pitchforks at
/// 1 -+ sqrt(1/2).
std::string deck(const std::string& path) { return "problem: {name: sway_truss}\npath: {" + path + "}\n"; }

double load(double x) { return x * (1 - x) * (2 - x); }

class StopPoints : public testing::Test {
 protected:
  CommandResult run(const std::string& path, const std::vector<std::string>& more) {
    writeFile(folder_ / "deck.yaml", deck(path));
    std::vector<std::string> words{"run", "deck.yaml"};
    words.insert(words.end(), more.begin(), more.end());
    return runAtrapos(words, folder_.path());
  }
  nlohmann::json summary(const std::string& results) const {
    return nlohmann::json::parse(readFile(folder_ / results / "summary.json"));
  }
  TemporaryFolder folder_;
};

TEST_F(StopPoints, LimitPointsAreToldWithTheirValues) {
  const CommandResult r = run("stop: {limit_point: 2}", {"-o", "a"});
  ASSERT_EQ(r.exitCode, 0) << r.err;
  EXPECT_NE(r.out.find("limit point 2 passed\nresults in a\n"), std::string::npos) << r.out;
  for (const char* kind :
       {"limit point (maximum) at load factor 0.3849", "limit point (minimum) at load factor -0.3849"})
    EXPECT_NE(r.out.find(kind), std::string::npos) << r.out;
  const auto all = summary("a");
  EXPECT_EQ(all.at("ended"), "stopReached");
  EXPECT_EQ(all.at("why"), "limit point 2 passed");
  EXPECT_EQ(all.at("limit_points"), 2);
  const auto& limits = all.at("load_limits");
  ASSERT_EQ(limits.size(), 2u);
  for (const int i : {0, 1}) {
    const double x = 1 + (i == 0 ? -1 : 1) * std::sqrt(1.0 / 3);
    EXPECT_EQ(limits[i].at("kind"), i == 0 ? "maximum" : "minimum");
    // The residual bound of 1e-6 leaves so much of the load, and its root of the place: the load is flat
    // there.
    EXPECT_NEAR(limits[i].at("load_factor"), load(x), 1e-6);
    EXPECT_NEAR(limits[i].at("monitors").at("sinking"), x, 1e-3);
    EXPECT_NE(r.out.find(": sinking = "), std::string::npos) << r.out;
  }
}

TEST_F(StopPoints, ARunGoesOnToTheNextPoint) {
  ASSERT_EQ(run("stop: {limit_point: 2}", {"-q", "-o", "whole"}).exitCode, 0);
  ASSERT_EQ(run("stop: {limit_point: 1}", {"-q", "-o", "parts"}).exitCode, 0);
  EXPECT_EQ(summary("parts").at("load_limits").size(), 1u);
  ASSERT_EQ(run("stop: {limit_point: 2}", {"-q", "--restart", "parts"}).exitCode, 0);
  for (const char* name : {"path.csv", "points.csv", "steps.csv"})
    EXPECT_EQ(readFile(folder_ / "parts" / name), readFile(folder_ / "whole" / name)) << name;
  EXPECT_EQ(summary("parts").at("load_limits"), summary("whole").at("load_limits"));
  // Once more, and nothing is left to do.
  const CommandResult again = run("stop: {limit_point: 2}", {"--restart", "parts"});
  EXPECT_EQ(again.exitCode, 0) << again.err;
  EXPECT_EQ(readFile(folder_ / "parts" / "path.csv"), readFile(folder_ / "whole" / "path.csv"));
}

TEST_F(StopPoints, TheFirstBifurcationPoint) {
  const CommandResult r = run("stop: {bifurcation: 1}", {"-o", "a"});
  ASSERT_EQ(r.exitCode, 0) << r.err;
  const auto all = summary("a");
  EXPECT_EQ(all.at("why"), "bifurcation point 1 passed");
  ASSERT_EQ(all.at("points").size(), 1u);
  EXPECT_NEAR(all.at("points")[0].at("load_factor"), load(1 - std::sqrt(0.5)), 1e-10);  // exact to rounding
  EXPECT_NE(r.out.find("bifurcation point (pitchfork) at load factor 0.35355339"), std::string::npos)
      << r.out;
}

TEST_F(StopPoints, WhatIsNeverLookedForIsRefused) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"stop: {bifurcation: 1}, critical_points: off", "needs path/critical_points"},
      {"stop: {bifurcation: 1}, method: newton", "needs path/method: series"},
      {"stop: {limit_point: 0}", "must be at least 1"}};
  for (const auto& [path, word] : cases) {
    const CommandResult r = run(path, {});
    EXPECT_EQ(r.exitCode, 2);
    ASSERT_EQ(r.errorLines().size(), 1u) << r.err;
    EXPECT_NE(r.err.find("path/stop/"), std::string::npos) << r.err;
    EXPECT_NE(r.err.find(word), std::string::npos) << r.err;
  }
}

TEST_F(StopPoints, NewtonStepsStopAtLimitPoints) {
  ASSERT_EQ(run("method: newton, stop: {limit_point: 1}", {"-q", "-o", "a"}).exitCode, 0);
  EXPECT_EQ(summary("a").at("why"), "limit point 1 passed");
}

TEST_F(StopPoints, NoWordsOfTheProgramsOwn) {
  const CommandResult r = run("branches: stable, stop: {bifurcation: 1}", {"-o", "a"});
  ASSERT_EQ(r.exitCode, 0) << r.err;
  for (const char* file : {"summary.json", "branches.csv"}) {
    const std::string text = readFile(folder_ / "a" / file);
    EXPECT_NE(text.find("notStable"), std::string::npos) << text;
    EXPECT_EQ(text.find("bserver"), std::string::npos) << text;
  }
}

TEST_F(StopPoints, HelpExplainsEveryColumn) {
  const CommandResult r = run("stop: {limit_point: 1}", {"-o", "a"});
  const std::size_t head = r.out.find(" step ");
  ASSERT_NE(head, std::string::npos) << r.out;
  const std::string help = runAtrapos({"run", "--help"}, folder_.path()).out;
  std::istringstream names(r.out.substr(head, r.out.find('\n', head) - head));
  int columns = 0;
  for (std::string name; names >> name; ++columns)
    EXPECT_NE(help.find(name), std::string::npos) << name << " is not in:\n" << help;
  EXPECT_GE(columns, 11);
}

}  // namespace
}  // namespace atrapos::test
