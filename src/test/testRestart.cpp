// Runs that go on: behind a kill, behind any step, into another folder, with other settings; every number is
// that of one run.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstring>
#include <functional>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>
#include <thread>

#include "atrapos/exodus/ResultReader.hpp"
#include "support/Command.hpp"
#include "support/Folder.hpp"
#include "support/SmallDeck.hpp"

namespace atrapos::test {
namespace {

/// Rows of path.csv up to and with a step.
std::string rowsUpTo(const std::string& table, int step) {
  const auto next = table.find("\n" + std::to_string(step + 1) + ",");
  return table.substr(0, next == std::string::npos ? next : next + 1);
}

void expectSameResults(const std::filesystem::path& a, const std::filesystem::path& b) {
  for (const char* name : {"path.csv", "points.csv", "steps.csv", "restart.bin"})
    EXPECT_TRUE(readFile(a / name) == readFile(b / name)) << name << " differs";
  const exodus::ResultReader x((a / "results.exo").string()), y((b / "results.exo").string());
  ASSERT_EQ(x.numSteps(), y.numSteps());
  EXPECT_EQ(x.times(), y.times());
  for (int s = 0; s < x.numSteps(); ++s) {
    EXPECT_EQ(x.globals(s), y.globals(s)) << "state " << s;
    for (const auto& name : x.nodalNames()) EXPECT_EQ(x.nodal(s, name), y.nodal(s, name)) << name << ' ' << s;
    for (const auto& name : x.elementNames())
      EXPECT_EQ(x.element(s, name), y.element(s, name)) << name << ' ' << s;
  }
}

class Restart : public testing::Test {
 protected:
  void SetUp() override {
    writeFile(folder_ / "deck.yaml", kSmallDeck);
    ASSERT_EQ(runAtrapos({"mesh", "-q", "deck.yaml"}, folder_.path()).exitCode, 0);
    ASSERT_EQ(runAtrapos({"run", "-q", "deck.yaml", "-o", "whole"}, folder_.path()).exitCode, 0);
    whole_ = readFile(folder_ / "whole" / "path.csv");
    steps_ = summary("whole").at("steps");
    ASSERT_GT(steps_, 4);
  }
  nlohmann::json summary(const std::string& results) const {
    return nlohmann::json::parse(readFile(folder_ / results / "summary.json"));
  }
  void run(const std::vector<std::string>& words) {
    const CommandResult r = runDeck(words, folder_.path());
    ASSERT_EQ(r.exitCode, 0) << r.err;
  }
  /// The command refuses, in one line with these words, and changes nothing.
  void refuses(const std::vector<std::string>& words, const std::vector<std::string>& expected) {
    const auto before = snapshot(folder_.path());
    const CommandResult r = runDeck(words, folder_.path());
    EXPECT_EQ(r.exitCode, 2);
    ASSERT_EQ(r.errorLines().size(), 1u) << r.err;
    for (const auto& word : expected) EXPECT_NE(r.err.find(word), std::string::npos) << word << ": " << r.err;
    EXPECT_TRUE(snapshot(folder_.path()) == before) << "something was written";
  }

  TemporaryFolder folder_;
  std::string whole_;
  int steps_ = 0;
};

TEST_F(Restart, KilledRunGoesOnBitForBit) {
  Command command({"run", "-q", "deck.yaml", "-o", "killed"}, folder_.path());
  const auto table = folder_ / "killed" / "path.csv";
  const auto limit = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (!(std::filesystem::exists(table) && readFile(table).find("\n3,") != std::string::npos)) {
    ASSERT_LT(std::chrono::steady_clock::now(), limit);
    std::this_thread::sleep_for(std::chrono::microseconds(200));
  }
  if (command.running()) command.send(SIGKILL);
  // A run as small as this may be over before the signal: then it is cut by hand, in the middle of a record.
  if (command.wait().signal != SIGKILL) {
    const std::string states = readFile(folder_ / "killed" / "restart.bin");
    writeFile(folder_ / "killed" / "restart.bin", states.substr(0, states.size() - 100));
  }
  run({"--restart", "killed"});
  expectSameResults(folder_ / "killed", folder_ / "whole");
  EXPECT_EQ(summary("killed").at("steps"), steps_);
  EXPECT_GE(summary("killed").at("restarted_behind_step"), 2);
  for (const auto& entry : std::filesystem::directory_iterator(folder_ / "killed"))
    EXPECT_NE(entry.path().extension(), ".new") << entry.path();
}

TEST_F(Restart, BehindAnyStepIntoAnotherFolder) {
  const auto before = snapshot(folder_ / "whole");
  for (int step = 1; step < steps_; step += 2) {
    SCOPED_TRACE(step);
    run({"--restart", "whole", "--from", std::to_string(step), "-o", "again"});
    expectSameResults(folder_ / "again", folder_ / "whole");
    EXPECT_EQ(summary("again").at("restarted_behind_step"), step);
  }
  EXPECT_TRUE(snapshot(folder_ / "whole") == before);
}

// The set of active points goes on too, behind steps that end with an event and others, and where a limit of
// steps has come before the event at the end of the last one was applied.
TEST_F(Restart, OfHardContact) {
  const std::string hard =
      edited(edited(kSmallDeck, "{tool: roll, set: z_min, stiffness: 1000, regularisation: 1.0e-3}",
                    "{tool: roll, set: z_min, points: nodes, law: hard}"),
             "{load_factor: 0.5}", "{load_factor: 3}");
  writeFile(folder_ / "deck.yaml", hard);
  run({"-o", "hard"});
  const int steps = summary("hard").at("steps");
  const std::string events = readFile(folder_ / "hard" / "events.csv");
  ASSERT_GT(std::count(events.begin(), events.end(), '\n'), 2) << events;  // the two nodes at the end
  for (int step = 1; step < steps; ++step) {
    SCOPED_TRACE(step);
    writeFile(folder_ / "deck.yaml", hard);
    run({"--restart", "hard", "--from", std::to_string(step), "-o", "again"});
    expectSameResults(folder_ / "again", folder_ / "hard");
    EXPECT_EQ(readFile(folder_ / "again" / "events.csv"), events);
    writeFile(folder_ / "deck.yaml",
              edited(hard, "{load_factor: 3}", "{load_factor: 3, steps: " + std::to_string(step) + "}"));
    run({"-o", "part"});
    writeFile(folder_ / "deck.yaml", hard);
    run({"--restart", "part"});
    EXPECT_EQ(readFile(folder_ / "part" / "path.csv"), readFile(folder_ / "hard" / "path.csv"));
  }
}

/// branches.csv without the column of factorizations, which counts from the restart on.
std::string branchRows(const std::filesystem::path& folder) {
  std::istringstream in(readFile(folder / "branches.csv"));
  std::string all;
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string word;
    for (int column = 0; std::getline(words, word, ','); ++column)
      if (column != 8) all += word + ',';
    all += '\n';
  }
  return all;
}

/// Diagrams: a run of `deck` is cut behind steps of every branch and goes on in another folder.
class BranchRestart : public testing::Test {
 protected:
  void run(const std::vector<std::string>& words) {
    const CommandResult r = runDeck(words, folder_.path());
    ASSERT_EQ(r.exitCode, 0) << r.err;
  }
  /// (branch, step) of all finished steps.
  std::vector<std::pair<int, int>> places() const {
    std::istringstream in(readFile(folder_ / "whole" / "path.csv"));
    std::string line;
    std::getline(in, line);
    const auto columns = std::count(line.begin(), line.end(), ',');
    std::vector<std::pair<int, int>> all;
    while (std::getline(in, line)) {
      std::istringstream words(line);
      std::string word;
      std::vector<std::string> row;
      while (std::getline(words, word, ',')) row.push_back(word);
      const std::pair<int, int> place{std::stoi(row.at(columns - 1)), std::stoi(row.at(0))};
      if (place.second > 0 && (all.empty() || all.back() != place)) all.push_back(place);
    }
    return all;
  }
  void expectSame(const std::string& results) {
    for (const char* name : {"path.csv", "points.csv"})
      EXPECT_TRUE(readFile(folder_ / results / name) == readFile(folder_ / "whole" / name)) << name;
    EXPECT_EQ(branchRows(folder_ / results), branchRows(folder_ / "whole"));
    for (const auto& entry : std::filesystem::directory_iterator(folder_ / "whole")) {
      if (entry.path().extension() != ".exo") continue;
      const exodus::ResultReader x(entry.path().string());
      const exodus::ResultReader y((folder_ / results / entry.path().filename().string()).string());
      ASSERT_EQ(x.numSteps(), y.numSteps()) << entry.path();
      for (int s = 0; s < x.numSteps(); ++s) {
        EXPECT_EQ(x.globals(s), y.globals(s)) << entry.path() << " state " << s;
        for (const auto& name : x.nodalNames()) EXPECT_EQ(x.nodal(s, name), y.nodal(s, name)) << entry.path();
      }
    }
  }
  void goesOnFromEvery(int stride, const std::string& deck) {
    writeFile(folder_ / "deck.yaml", deck);
    run({"-o", "whole"});
    const auto all = places();
    for (std::size_t i = 0; i < all.size(); i += stride) {
      const std::string place = std::to_string(all[i].first) + ":" + std::to_string(all[i].second);
      SCOPED_TRACE(place);
      run({"--restart", "whole", "--from", place, "-o", "again"});
      expectSame("again");
    }
  }
  TemporaryFolder folder_;
};

constexpr const char* kArch = "problem: {name: shallow_arch}\npath: {branches: all}\n";

TEST_F(BranchRestart, ArchWithBothLoops) { goesOnFromEvery(3, kArch); }

TEST_F(BranchRestart, ColumnWithBranchesAndImperfectPaths) {
  goesOnFromEvery(4, "problem: {name: euler_column}\npath: {branches: all, imperfections: [0.01, -0.01]}\n");
}

TEST_F(BranchRestart, ImperfectPathsWithoutBranches) {
  goesOnFromEvery(2, "problem: {name: euler_column}\npath: {imperfections: [0.01, -0.02]}\n");
}

TEST_F(BranchRestart, KilledOnABranchGoesOnBitForBit) {
  writeFile(folder_ / "deck.yaml", kArch);
  run({"-o", "whole"});
  const auto all = places();
  Command command({"run", "-q", "deck.yaml", "-o", "killed"}, folder_.path());
  const auto table = folder_ / "killed" / "path.csv";
  const auto limit = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  // Four rows a step from the fourth step of the first branch on.
  const auto rows = [&] {
    const std::string text = readFile(table);
    return std::count(text.begin(), text.end(), '\n');
  };
  const auto enough = 1 + 5 * static_cast<long>(std::count_if(all.begin(), all.end(), [](const auto& p) {
                            return p.first == 0 || p.second < 5;
                          }));
  while (!(std::filesystem::exists(table) && rows() > enough)) {
    ASSERT_LT(std::chrono::steady_clock::now(), limit);
    std::this_thread::sleep_for(std::chrono::microseconds(200));
  }
  if (command.running()) command.send(SIGKILL);
  // Where the run was over before the signal it is cut by hand, in the middle of a record.
  if (command.wait().signal != SIGKILL) {
    const std::string states = readFile(folder_ / "killed" / "restart.bin");
    writeFile(folder_ / "killed" / "restart.bin", states.substr(0, states.size() / 2));
  }
  run({"--restart", "killed"});
  expectSame("killed");
}

// A diagram that is complete has nothing left to do; from a step of its first path on it goes on with other
// settings.
TEST_F(BranchRestart, OfACompleteDiagram) {
  writeFile(folder_ / "deck.yaml", kArch);
  run({"-o", "whole"});
  const auto before = readFile(folder_ / "whole" / "branches.csv");
  run({"--restart", "whole", "-o", "again"});
  expectSame("again");
  EXPECT_EQ(readFile(folder_ / "again" / "branches.csv"), before);
  writeFile(folder_ / "deck.yaml", "problem: {name: shallow_arch}\npath: {branches: all, order: 12}\n");
  run({"--restart", "whole", "--from", "2", "-o", "other"});
  const auto other = readFile(folder_ / "other" / "path.csv"),
             whole = readFile(folder_ / "whole" / "path.csv");
  EXPECT_EQ(rowsUpTo(other, 2), rowsUpTo(whole, 2));
  EXPECT_NE(rowsUpTo(other, 3), rowsUpTo(whole, 3));
}

TEST_F(BranchRestart, WhatDoesNotFitIsRefused) {
  writeFile(folder_ / "deck.yaml", "problem: {name: euler_column}\npath: {imperfections: 0.01}\n");
  run({"-o", "whole"});
  const auto refuses = [&](const std::string& deck, const std::vector<std::string>& words,
                           const std::vector<std::string>& expected) {
    writeFile(folder_ / "deck.yaml", deck);
    std::vector<std::string> all{"run", "-q", "deck.yaml", "--restart", "whole"};
    all.insert(all.end(), words.begin(), words.end());
    const CommandResult r = runAtrapos(all, folder_.path());
    EXPECT_EQ(r.exitCode, 2);
    ASSERT_EQ(r.errorLines().size(), 1u) << r.err;
    for (const auto& word : expected) EXPECT_NE(r.err.find(word), std::string::npos) << word << ": " << r.err;
  };
  refuses("problem: {name: euler_column}\npath: {branches: all}\n", {}, {"path/branches", "no branches"});
  refuses("problem: {name: euler_column}\npath: {imperfections: 0.02}\n", {}, {"path/imperfections", "0.01"});
  refuses("problem: {name: euler_column}\npath: {imperfections: 0.01}\n", {"--from", "3:1"},
          {"no step 1 of branch 3"});
  refuses("problem: {name: euler_column}\npath: {imperfections: 0.01}\n", {"--from", "x"}, {"--from 'x'"});
}

TEST_F(Restart, WithOtherSettingsFromTheMiddle) {
  writeFile(folder_ / "deck.yaml",
            edited(edited(kSmallDeck, "order: 15", "order: 8"), "{load_factor: 0.5}", "{load_factor: 0.7}"));
  run({"--restart", "whole", "--from", "2", "-o", "other"});
  const std::string other = readFile(folder_ / "other" / "path.csv");
  EXPECT_EQ(rowsUpTo(other, 2), rowsUpTo(whole_, 2));
  EXPECT_NE(rowsUpTo(other, 3), rowsUpTo(whole_, 3));
  EXPECT_EQ(summary("other").at("load_factor"), 0.7);
}

TEST_F(Restart, FinishedRunGoesFurther) {
  writeFile(folder_ / "deck.yaml", edited(kSmallDeck, "{load_factor: 0.5}", "{load_factor: 0.6}"));
  run({"--restart", "whole"});
  EXPECT_EQ(readFile(folder_ / "whole" / "path.csv").substr(0, whole_.size()), whole_);
  EXPECT_EQ(summary("whole").at("load_factor"), 0.6);
  EXPECT_EQ(summary("whole").at("restarted_behind_step"), steps_);
}

TEST_F(Restart, WithFieldsOfSomeStepsOnly) {
  const auto states = [&](const std::string& results) {
    return exodus::ResultReader((folder_ / results / "results.exo").string()).numSteps();
  };
  ASSERT_EQ(states("whole"), steps_ + 1);
  for (const int every : {2, 3, 1000}) {
    SCOPED_TRACE(every);
    const std::string key = "points_per_step: 2\n  fields_every: " + std::to_string(every);
    writeFile(folder_ / "deck.yaml", edited(kSmallDeck, "points_per_step: 2", key));
    run({"-o", "some"});
    EXPECT_EQ(readFile(folder_ / "some" / "path.csv"), whole_);
    // The start, every so many steps, and the stop.
    EXPECT_EQ(states("some"), 1 + steps_ / every + (steps_ % every != 0));
    const exodus::ResultReader all((folder_ / "whole" / "results.exo").string()),
        some((folder_ / "some" / "results.exo").string());
    for (int s = 0; s < some.numSteps(); ++s) {
      const int step = std::min(s * every, steps_);
      EXPECT_EQ(some.globals(s), all.globals(step)) << s;
      EXPECT_EQ(some.nodal(s, "displ_z"), all.nodal(step, "displ_z")) << s;
    }
    for (int from = 1; from <= steps_; ++from) {
      run({"--restart", "some", "--from", std::to_string(from), "-o", "other"});
      expectSameResults(folder_ / "some", folder_ / "other");
    }
  }
  refuses({"--restart", "whole", "--from", "4"}, {"results.exo", "output/fields_every"});
  writeFile(folder_ / "deck.yaml", kSmallDeck);
  refuses({"--restart", "some"}, {"results.exo", "states"});
}

TEST_F(Restart, WhatCannotGoOnIsRefused) {
  refuses({"--restart", "nowhere"}, {"nowhere/restart.bin", "cannot be read"});
  refuses({"--restart", "whole", "--from", "1000"},
          {"no step 1000 of branch 0", "last one is " + std::to_string(steps_)});
  refuses({"--from", "2"}, {"--restart"});
  writeFile(folder_ / "whole" / "restart.bin", "not one");
  refuses({"--restart", "whole"}, {"not a restart file"});
}

TEST_F(Restart, AnotherDeckIsRefused) {
  const std::string monitors = "tip_uz: {type: displacement, set: x_max, component: z}";
  writeFile(folder_ / "deck.yaml",
            edited(kSmallDeck, monitors, "tip_uy: {type: displacement, set: x_max, component: y}"));
  refuses({"--restart", "whole"}, {"restart.bin: is of another problem", "output/monitors/tip_uz"});
  writeFile(folder_ / "deck.yaml",
            edited(kSmallDeck, "points_per_step: 2", "points_per_step: 2\n  fields: [displacement]"));
  refuses({"--restart", "whole"}, {"results.exo", "other fields"});
  writeFile(folder_ / "deck.yaml", edited(kSmallDeck, "order: 15", "order: 15\n  branches: all"));
  refuses({"--restart", "whole"}, {"path/branches"});
  writeFile(folder_ / "deck.yaml", edited(kSmallDeck, "divisions: [4, 1, 1]", "divisions: [5, 1, 1]"));
  ASSERT_EQ(runAtrapos({"mesh", "-q", "deck.yaml"}, folder_.path()).exitCode, 0);
  refuses({"--restart", "whole"}, {"the mesh had 20 nodes and 4 elements and has 24 and 5 now"});
}

// 20.4: everything that the path is of is compared; how it is followed and what is written is the user's
// choice.
TEST_F(Restart, AnotherProblemIsToldByItsFirstDifference) {
  const std::vector<std::array<std::string, 3>> edits{
      {"youngs_modulus: 1000", "youngs_modulus: 500",
       "materials/rubber/youngs_modulus was 1000 and is 500 now"},
      {"poissons_ratio: 0.3", "poissons_ratio: 0", "materials/rubber/poissons_ratio was 0.3 and is 0 now"},
      {"x: 0, y: 0, z: 0}", "x: 0, y: 0, z: 0.01}", "supports/clamp/z"},
      {"total: [0, 0, -10]", "total: [0, 0, -11]", "loads/tip/total"},
      {"tip: {type: surface", "top: {type: surface", "loads/tip/type was surface and is not there now"},
      {"radius: 1}", "radius: 0.9}", "tools/roll/radius was 1 and is 0.9 now"},
      {"stiffness: 1000", "stiffness: 1001", "contact/lower/stiffness"},
      {"component: z}", "component: x}", "output/monitors/tip_uz/component was z and is x now"},
      {"contact: lower}", "contact: lower, component: z}", "output/monitors/force/component"}};
  for (const auto& [from, to, word] : edits) {
    SCOPED_TRACE(to);
    writeFile(folder_ / "deck.yaml", edited(kSmallDeck, from, to));
    refuses({"--restart", "whole"}, {"deck.yaml: whole/restart.bin: is of another problem: ", word});
  }
  // Another mesh of the same size, by its file alone.
  writeFile(folder_ / "deck.yaml", edited(kSmallDeck, "lengths: [4, 1, 1]", "lengths: [4.01, 1, 1]"));
  ASSERT_EQ(runAtrapos({"mesh", "-q", "deck.yaml"}, folder_.path()).exitCode, 0);
  writeFile(folder_ / "deck.yaml", kSmallDeck);
  refuses({"--restart", "whole"}, {"the nodes of the mesh were in other places"});
}

TEST_F(Restart, FilesThatAreNotAsTheRunLeftThem) {
  const auto changed = [&](const std::string& name, const std::string& content,
                           const std::vector<std::string>& words) {
    const std::string before = readFile(folder_ / "whole" / name);
    ASSERT_NE(content, before);
    writeFile(folder_ / "whole" / name, content);
    std::vector<std::string> all{"whole/" + name};
    all.insert(all.end(), words.begin(), words.end());
    refuses({"--restart", "whole"}, all);
    writeFile(folder_ / "whole" / name, before);
  };
  const auto lines = [](const std::string& text, const std::function<void(std::vector<std::string>&)>& edit) {
    std::vector<std::string> all;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) all.push_back(line);
    edit(all);
    std::string result;
    for (const auto& line : all) result += line + '\n';
    return result;
  };
  changed("path.csv", lines(whole_, [](auto& all) { all.erase(all.begin() + 3); }),
          {"rows up to where the run goes on"});
  changed("path.csv", lines(whole_, [](auto& all) { all.pop_back(); }), {"rows up to where the run goes on"});
  changed("path.csv", lines(whole_, [](auto& all) { all[4][all[4].find('.') + 3] ^= 1; }),
          {"rows were changed"});
  changed("path.csv", lines(whole_, [](auto& all) { std::swap(all[2], all[3]); }), {"rows were changed"});
  changed("path.csv", lines(whole_, [](auto& all) { all[4] = "garbage"; }), {"row 4 is damaged"});
  changed("path.csv", lines(whole_, [](auto& all) { all[4] = "99999999999999999999" + all[4]; }),
          {"row 4 is damaged"});
  changed("path.csv", lines(whole_, [](auto& all) { all[4].clear(); }), {"row 4 is damaged"});
  const std::string events = readFile(folder_ / "whole" / "events.csv");
  changed("events.csv", lines(events, [](auto& all) { all.push_back(all.back()); }), {"rows"});
  // The last value of the last state.
  std::string states = readFile(folder_ / "whole" / "results.exo");
  states[states.size() - 5] ^= 1;
  changed("results.exo", states, {"its states were changed"});
  // Nothing of it counts where the run goes on before.
  writeFile(folder_ / "whole" / "results.exo", states);
  run({"--restart", "whole", "--from", "2", "-o", "again"});
}

std::uint64_t checkSum(const std::string& bytes) {
  std::uint64_t hash = 14695981039346656037ull;
  for (const unsigned char c : bytes) hash = (hash ^ c) * 1099511628211ull;
  return hash;
}

/// The records of a restart file behind its head of 24 bytes, with sums that are right again.
std::string forged(const std::string& file, const std::function<void(std::vector<std::string>&)>& edit) {
  std::vector<std::string> records;
  for (std::size_t at = 24; at + 16 <= file.size();) {
    std::uint64_t length = 0;
    std::memcpy(&length, &file[at], sizeof length);
    records.push_back(file.substr(at + 16, length));
    at += 16 + length;
  }
  edit(records);
  std::string result = file.substr(0, 24);
  for (const auto& record : records)
    for (const std::uint64_t number : {std::uint64_t{record.size()}, checkSum(record)}) {
      result.append(reinterpret_cast<const char*>(&number), sizeof number);
      if (number == checkSum(record)) result += record;
    }
  return result;
}

// Sums that are right on records that no run writes: lengths beyond everything, indices of nothing, records
// cut short.
TEST_F(Restart, ForgedRecords) {
  const std::string file = readFile(folder_ / "whole" / "restart.bin");
  ASSERT_EQ(forged(file, [](auto&) {}), file);
  std::mt19937 random(6);
  int refused = 0;
  for (int trial = 0; trial < 36; ++trial) {
    SCOPED_TRACE(trial);
    const std::string changed = forged(file, [&](std::vector<std::string>& records) {
      std::string& record = trial % 10 == 0 ? records.front() : trial % 2 == 0 ? records[1] : records.back();
      const std::size_t at = random() % std::min<std::size_t>(record.size() - 8, 700);
      if (trial % 3 == 0) record.resize(at);
      const std::uint64_t numbers[]{~std::uint64_t{0}, std::uint64_t{1} << 40, 0x7fffffff, 0x80000000,
                                    random()};
      if (trial % 3 != 0) std::memcpy(&record[at], &numbers[random() % 5], 8);
    });
    writeFile(folder_ / "whole" / "restart.bin", changed);
    const CommandResult r = runDeck({"--restart", "whole", "-o", "again"}, folder_.path());
    // A number of the state, or of costs: another path, or none.
    EXPECT_TRUE(r.exitCode == 0 || r.exitCode == 2 || r.exitCode == 3)
        << r.exitCode << ' ' << r.signal << ' ' << r.err;
    refused += r.exitCode == 2 ? 1 : 0;
    EXPECT_LE(r.errorLines().size(), r.exitCode == 3 ? 2u : 1u) << r.err;
  }
  EXPECT_GT(refused, 12);
}

TEST_F(Restart, AFolderIsOneRunsAtATime) {
  const int folder = open((folder_ / "whole").c_str(), O_RDONLY | O_DIRECTORY);
  ASSERT_EQ(flock(folder, LOCK_EX | LOCK_NB), 0);
  refuses({"-o", "whole"}, {"another run uses the folder whole"});
  refuses({"--restart", "whole"}, {"another run uses the folder whole"});
  refuses({"--restart", "whole", "-o", "other"}, {"another run writes into the folder whole"});
  ASSERT_EQ(flock(folder, LOCK_SH | LOCK_NB), 0);  // of another restart, which reads
  run({"--restart", "whole", "-o", "other"});
  refuses({"--restart", "whole"}, {"another run uses the folder whole"});
  close(folder);
  run({"--restart", "whole"});
}

TEST_F(Restart, NothingIsKeptWhereNotWanted) {
  writeFile(folder_ / "deck.yaml", edited(kSmallDeck, "order: 15", "order: 15\n  restart: false"));
  run({"-o", "plain"});
  EXPECT_FALSE(std::filesystem::exists(folder_ / "plain" / "restart.bin"));
  EXPECT_EQ(readFile(folder_ / "plain" / "path.csv"), whole_);
}

// A circle over (load factor, T): behind its first steps a restart still knows where they began.
TEST(ClosedRestart, KnowsTheStepsOfBefore) {
  const TemporaryFolder folder;
  writeFile(folder / "deck.yaml", R"(mesh:
  file: circle.exo
  generate: {shape: rectangle, cell: QUAD4, divisions: [2, 1], lengths: [1, 1]}
fields:
  T: {initial: 0.5}
physics:
  circle: {type: balance, field: T, blocks: [body], conductivity: 1, source: T^2 + (lambda - 0.5)^2 - 0.5}
path:
  stop: {load_factor: 3}
output:
  monitors:
    T: {type: field, field: T, set: x_min}
)");
  ASSERT_EQ(runAtrapos({"mesh", "-q", "deck.yaml"}, folder.path()).exitCode, 0);
  const std::string closed = "comes to the state with which step 1 began";
  const CommandResult whole = runAtrapos({"run", "deck.yaml", "-o", "whole"}, folder.path());
  EXPECT_NE(whole.out.find(closed), std::string::npos) << whole.out << whole.err;
  const CommandResult rest =
      runAtrapos({"run", "deck.yaml", "--restart", "whole", "--from", "3", "-o", "rest"}, folder.path());
  EXPECT_NE(rest.out.find(closed), std::string::npos) << rest.out << rest.err;
  for (const char* const file : {"path.csv", "restart.bin"})
    EXPECT_EQ(readFile(folder / "rest" / file), readFile(folder / "whole" / file)) << file;
}

}  // namespace
}  // namespace atrapos::test
