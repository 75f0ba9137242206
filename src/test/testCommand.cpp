// The command's manners: what it prints where, exit codes, and the files of good runs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <memory>
#include <nlohmann/json.hpp>

#include "atrapos/exodus/MeshFile.hpp"
#include "atrapos/exodus/ResultReader.hpp"
#include "support/Command.hpp"
#include "support/Folder.hpp"
#include "support/SmallDeck.hpp"

namespace atrapos::test {
namespace {

class CommandTest : public testing::Test {
 protected:
  void SetUp() override {
    writeFile(folder_ / "deck.yaml", kSmallDeck);
    const CommandResult made = runAtrapos({"mesh", "-q", "deck.yaml"}, folder_.path());
    ASSERT_EQ(made.exitCode, 0) << made.err;
  }

  nlohmann::json summary(const std::string& results) const {
    return nlohmann::json::parse(readFile(folder_ / results / "summary.json"));
  }

  TemporaryFolder folder_;
};

void expectNoChatter(const std::string& text) {
  for (const char* word : {"Kokkos", "OMP_PROC_BIND", "WARNING", "warning", "MPI"})
    EXPECT_EQ(text.find(word), std::string::npos) << word << " in:\n" << text;
}

TEST_F(CommandTest, HelpNamesTheSubcommands) {
  const CommandResult r = runAtrapos({"--help"}, folder_.path());
  EXPECT_EQ(r.exitCode, 0);
  EXPECT_EQ(r.err, "");
  for (const char* word : {"run", "mesh", "split", "join", "check", "--version"})
    EXPECT_NE(r.out.find(word), std::string::npos) << r.out;
  const CommandResult run = runAtrapos({"run", "--help"}, folder_.path());
  EXPECT_EQ(run.exitCode, 0);
  for (const char* word : {"DECK", "--output", "--threads", "--quiet"})
    EXPECT_NE(run.out.find(word), std::string::npos) << run.out;
}

TEST_F(CommandTest, StrayWordsAreNamed) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases{
      {{}, "a command is needed"},
      {{"solve"}, "'solve' is not a command"},
      {{"run"}, "DECK is required"},
      {{"run", "deck.yaml", "more"}, "'more' is not expected"},
      {{"mesh", "deck.yaml", "--quite"}, "'--quite' is not expected"}};
  for (const auto& [words, problem] : cases) {
    const CommandResult r = runAtrapos(words, folder_.path());
    EXPECT_EQ(r.exitCode, 2);
    EXPECT_EQ(r.out, "");
    ASSERT_EQ(r.errorLines().size(), 1u) << r.err;
    EXPECT_NE(r.err.find(problem), std::string::npos) << r.err;
  }
}

TEST_F(CommandTest, VersionIsOneLine) {
  const CommandResult r = runAtrapos({"--version"}, folder_.path());
  EXPECT_EQ(r.exitCode, 0);
  EXPECT_EQ(r.err, "");
  int major = -1, minor = -1, patch = -1, read = 0;
  ASSERT_EQ(std::sscanf(r.out.c_str(), "atrapos %d.%d.%d\n%n", &major, &minor, &patch, &read), 3) << r.out;
  EXPECT_EQ(static_cast<std::size_t>(read), r.out.size()) << r.out;
}

TEST_F(CommandTest, MeshWritesTheFile) {
  const fem::Mesh mesh = exodus::readMesh((folder_ / "box.exo").string());
  EXPECT_EQ(mesh.numNodes(), 20);
  EXPECT_EQ(mesh.numElements(), 4);
  const CommandResult r = runAtrapos({"mesh", "deck.yaml", "-o", "other.exo"}, folder_.path());
  EXPECT_EQ(r.exitCode, 0);
  EXPECT_EQ(r.err, "");
  EXPECT_EQ(r.out, "other.exo: 20 nodes, 4 HEX8 in block 'body'\n");
  EXPECT_EQ(exodus::readMesh((folder_ / "other.exo").string()).coordinates, mesh.coordinates);
}

/// Whoever changes mesh/generate and does not make the mesh anew is told.
TEST_F(CommandTest, MeshOfAnEarlierDeckIsTold) {
  const auto told = [&](const std::string& from, const std::string& to, const std::string& what) {
    std::string deck = kSmallDeck;
    deck.replace(deck.find(from), from.size(), to);
    writeFile(folder_ / "deck.yaml", deck);
    for (const char* command : {"check", "run"}) {
      const CommandResult r = runAtrapos({command, "deck.yaml"}, folder_.path());
      EXPECT_EQ(r.exitCode, 0) << r.err;
      EXPECT_EQ(r.out.find("is not what mesh/generate makes") != std::string::npos, !what.empty()) << r.out;
      EXPECT_NE(r.out.find(what), std::string::npos) << r.out;
    }
  };
  told("[4, 1, 1]", "[4, 1, 1]", "");
  told("divisions: [4, 1, 1]", "divisions: [8, 1, 1]", "(20 nodes, 4 elements in place of 36, 8)");
  told("lengths: [4, 1, 1]", "lengths: [5, 1, 1]", "(nodes lie up to 1 elsewhere)");
}

TEST_F(CommandTest, TitleInUtf8) {
  std::string umlauts;
  for (int i = 0; i < 60; ++i) umlauts += "\u00e4";
  writeFile(folder_ / "deck.yaml", edited(kSmallDeck, "title: Small box", "title: a" + umlauts));
  const CommandResult made = runAtrapos({"mesh", "-q", "deck.yaml"}, folder_.path());
  EXPECT_EQ(made.exitCode, 0) << made.err;
  // Of the 80 bytes that Exodus holds, 79 are whole characters.
  EXPECT_EQ(exodus::readMesh((folder_ / "box.exo").string()).title, "a" + umlauts.substr(0, 78));
  const CommandResult r = runAtrapos({"run", "-q", "deck.yaml"}, folder_.path());
  EXPECT_EQ(r.exitCode, 0) << r.err;
  EXPECT_EQ(summary("deck_results").at("title"), "a" + umlauts);
  const auto info = exodus::ResultReader((folder_ / "deck_results" / "results.exo").string()).info();
  EXPECT_NE(std::find(info.begin(), info.end(), "title: a" + umlauts), info.end());
}

TEST_F(CommandTest, QuietMeshPrintsNothing) {
  const CommandResult r = runAtrapos({"mesh", "-q", "deck.yaml"}, folder_.path());
  EXPECT_EQ(r.exitCode, 0);
  EXPECT_EQ(r.out + r.err, "");
}

TEST_F(CommandTest, CheckPrintsTheWholeDeckAndWritesNothing) {
  const auto before = snapshot(folder_.path());
  const CommandResult r = runAtrapos({"check", "deck.yaml"}, folder_.path());
  EXPECT_EQ(r.exitCode, 0);
  EXPECT_EQ(r.err, "");
  expectNoChatter(r.out);
  // Defaults that the deck leaves unsaid, and what the mesh makes of it: 20 nodes, 4 of them held.
  for (const char* word : {"accuracy: 1", "order: 15", "60 (48 free)", "smallest gap 0.25"})
    EXPECT_NE(r.out.find(word), std::string::npos) << word << " is not in:\n" << r.out;
  EXPECT_TRUE(snapshot(folder_.path()) == before);

  // What it prints is a deck, the same one.
  writeFile(folder_ / "printed.yaml", r.out);
  const CommandResult again = runAtrapos({"check", "printed.yaml"}, folder_.path());
  EXPECT_EQ(again.exitCode, 0) << again.err;
  // What the process has in memory is measured.
  const auto upToMemory = [](const std::string& text) { return text.substr(0, text.find("# memory")); };
  EXPECT_LT(upToMemory(r.out).size(), r.out.size());
  EXPECT_EQ(upToMemory(again.out), upToMemory(r.out));
}

TEST_F(CommandTest, RunReportsEveryStepOnStdout) {
  const CommandResult r = runAtrapos({"run", "deck.yaml"}, folder_.path());
  EXPECT_EQ(r.exitCode, 0);
  EXPECT_EQ(r.err, "");
  expectNoChatter(r.out);
  const int steps = summary("deck_results").at("steps");
  int reported = 0;
  std::istringstream lines(r.out);
  for (std::string line; std::getline(lines, line);) {
    int step = 0, order = 0;
    if (std::sscanf(line.c_str(), "%d %d ", &step, &order) == 2 && order == 15) {
      EXPECT_EQ(step, reported + 1) << line;
      ++reported;
    }
  }
  EXPECT_EQ(reported, steps);
  EXPECT_NE(r.out.find("load factor 0.5 reached\nresults in deck_results\n"), std::string::npos) << r.out;
}

TEST_F(CommandTest, QuietRunPrintsNothing) {
  const CommandResult r = runAtrapos({"run", "-q", "deck.yaml", "-o", "there/below"}, folder_.path());
  EXPECT_EQ(r.exitCode, 0);
  EXPECT_EQ(r.out + r.err, "");
  for (const char* name : {"path.csv", "results.exo", "summary.json"})
    EXPECT_TRUE(std::filesystem::is_regular_file(folder_ / "there" / "below" / name)) << name;
}

/// The last column of path.csv.
std::vector<double> residuals(const std::filesystem::path& folder) {
  std::istringstream rows(readFile(folder / "path.csv"));
  std::vector<double> all;
  std::string row;
  std::getline(rows, row);
  while (std::getline(rows, row)) all.push_back(std::stod(row.substr(row.rfind(',') + 1)));
  return all;
}

TEST_F(CommandTest, ResidualsAreThoseOfStepEndsOrOfAllPoints) {
  const std::string all = edited(kSmallDeck, "points_per_step: 2", "points_per_step: 2\n  residuals: points");
  writeFile(folder_ / "all.yaml", all);
  for (const char* deck : {"deck.yaml", "all.yaml"})
    ASSERT_EQ(runAtrapos({"run", "-q", deck}, folder_.path()).exitCode, 0);
  const auto ends = residuals(folder_ / "deck_results"), points = residuals(folder_ / "all_results");
  ASSERT_EQ(ends.size(), points.size());
  ASSERT_GT(ends.size(), 3u);
  double worst = 0;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    EXPECT_EQ(std::isnan(ends[i]), i % 2 == 1) << i;  // the start, then two rows a step
    if (i % 2 == 0) {
      EXPECT_EQ(ends[i], points[i]) << i;
    }
    EXPECT_LE(points[i], 1e-8) << i;
    if (i > 0) worst = std::max(worst, points[i]);
  }
  // Four digits are printed in the table.
  EXPECT_NEAR(summary("all_results").at("worst_residual"), worst, 1e-3 * worst);
  EXPECT_EQ(summary("deck_results").at("worst_residual"),
            summary("deck_results").at("worst_residual_at_step_ends"));
}

// One process has MPI keep off networks (machine/Runtime.cpp); programs that it starts know nothing of that.
TEST_F(CommandTest, WhatItStartsInheritsNothingOfMpi) {
  const std::filesystem::path program = folder_ / "gnuplot";
  writeFile(program, "#!/bin/sh\nenv > inherited\n");
  std::filesystem::permissions(program, std::filesystem::perms::owner_all);
  writeFile(folder_ / "deck.yaml", "problem: {name: bratu_1d}\npath: {stop: {steps: 2}}\n");
  const std::string path = std::getenv("PATH");
  setenv("PATH", (folder_.path().string() + ':' + path).c_str(), 1);
  const CommandResult run = runDeck({}, folder_.path());
  setenv("PATH", path.c_str(), 1);
  ASSERT_EQ(run.exitCode, 0) << run.err;
  const std::string environment = readFile(folder_ / "deck_results" / "inherited");
  EXPECT_NE(environment.find("PATH="), std::string::npos);
  EXPECT_EQ(environment.find("OMPI_MCA"), std::string::npos) << environment;
}

// Processes without a daemon of MPI must not meet in a folder of its sessions.
TEST_F(CommandTest, ManyStartAtOnce) {
  writeFile(folder_ / "deck.yaml", "problem: {name: bratu_1d}\npath: {stop: {steps: 2}}\n");
  for (int round = 0; round < 5; ++round) {
    std::vector<std::unique_ptr<Command>> all;
    for (int i = 0; i < 8; ++i)
      all.push_back(
          std::make_unique<Command>(std::vector<std::string>{"check", "deck.yaml"}, folder_.path()));
    for (const auto& command : all) {
      const CommandResult result = command->wait();
      EXPECT_EQ(result.exitCode, 0) << result.err;
    }
  }
}

TEST_F(CommandTest, TitlesAndFoldersAreNeverRun) {
  writeFile(folder_ / "`touch pwned`.yaml", "problem: {name: bratu_1d}\npath: {stop: {steps: 2}}\n");
  writeFile(folder_ / "title.yaml",
            "title: '`touch pwned` \"`touch pwned`\"'\n"
            "problem: {name: bratu_1d}\npath: {stop: {steps: 2}}\n");
  for (const char* deck : {"`touch pwned`.yaml", "title.yaml"}) {
    const CommandResult r = runAtrapos({"run", "-q", deck, "-o", "it's `touch pwned`"}, folder_.path());
    EXPECT_EQ(r.exitCode, 0) << r.err;
    EXPECT_TRUE(std::filesystem::is_regular_file(folder_ / "it's `touch pwned`" / "path.png"));
    std::filesystem::remove(folder_ / "it's `touch pwned`" / "path.png");
  }
  for (const auto& [name, content] : snapshot(folder_.path()))
    EXPECT_NE(std::filesystem::path(name).filename().string(), "pwned") << name;
}

TEST_F(CommandTest, ThreadsAreUsedOrRefused) {
  ASSERT_EQ(runAtrapos({"run", "-q", "deck.yaml", "-t", "1"}, folder_.path()).exitCode, 0);
  EXPECT_EQ(summary("deck_results").at("threads"), 1);
  const bool serial = summary("deck_results").at("execution_space") == "Serial";
  const CommandResult r = runAtrapos({"run", "-q", "deck.yaml", "-t", "2"}, folder_.path());
  if (serial) {
    EXPECT_EQ(r.exitCode, 2);
    EXPECT_NE(r.err.find("--threads 2"), std::string::npos) << r.err;
    EXPECT_EQ(r.errorLines().size(), 1u) << r.err;
  } else {
    EXPECT_EQ(r.exitCode, 0) << r.err;
    EXPECT_EQ(summary("deck_results").at("threads"), 2);
  }
}

TEST_F(CommandTest, PathThatCannotBeContinued) {
  // Rounding alone leaves more than this of a residual.
  writeFile(folder_ / "deck.yaml", edited(kSmallDeck, "residual: 1.0e-8", "residual: 1.0e-17"));
  const CommandResult r = runAtrapos({"run", "-q", "deck.yaml"}, folder_.path());
  EXPECT_EQ(r.exitCode, 3);
  EXPECT_EQ(r.out, "");
  ASSERT_EQ(r.errorLines().size(), 2u) << r.err;
  EXPECT_NE(r.errorLines()[0].find("over the bound 1e-17"), std::string::npos) << r.err;
  EXPECT_EQ(r.errorLines()[1], "results in deck_results");
  const auto json = summary("deck_results");
  EXPECT_EQ(json.at("reached_stop"), false);
  EXPECT_EQ(json.at("ended"), "stepTooSmall");
  EXPECT_EQ(json.at("why"), r.errorLines()[0]);
  exodus::ResultReader results((folder_ / "deck_results" / "results.exo").string());
  EXPECT_EQ(results.numSteps(), static_cast<int>(json.at("steps")) + 1);
}

TEST_F(CommandTest, StepsOfTheDeckEndThePath) {
  writeFile(folder_ / "deck.yaml", edited(kSmallDeck, "{load_factor: 0.5}", "{load_factor: 0.5, steps: 3}"));
  const CommandResult r = runAtrapos({"run", "-q", "deck.yaml"}, folder_.path());
  EXPECT_EQ(r.exitCode, 0) << r.err;
  EXPECT_EQ(summary("deck_results").at("steps"), 3);
}

TEST_F(CommandTest, StopsNextToTheStartAreHitInTheFirstStep) {
  writeFile(folder_ / "deck.yaml", edited(kSmallDeck, "{load_factor: 0.5}", "{load_factor: 1.0e-300}"));
  const CommandResult r = runAtrapos({"run", "-q", "deck.yaml"}, folder_.path());
  EXPECT_EQ(r.exitCode, 0) << r.err;
  EXPECT_EQ(summary("deck_results").at("steps"), 1);
  EXPECT_EQ(summary("deck_results").at("load_factor"), 1e-300);
}

TEST_F(CommandTest, ASecondRunReplacesTheFirst) {
  ASSERT_EQ(runAtrapos({"run", "-q", "deck.yaml"}, folder_.path()).exitCode, 0);
  const std::string first = readFile(folder_ / "deck_results" / "path.csv");
  writeFile(folder_ / "deck_results" / "notes.txt", "mine");
  ASSERT_EQ(runAtrapos({"run", "-q", "deck.yaml"}, folder_.path()).exitCode, 0);
  EXPECT_EQ(readFile(folder_ / "deck_results" / "path.csv"), first);
  EXPECT_EQ(readFile(folder_ / "deck_results" / "notes.txt"), "mine");
}

}  // namespace
}  // namespace atrapos::test
