// A run that is ended in the middle: by SIGKILL nothing of the finished steps is lost; SIGINT and SIGTERM end
// it in good order after the step under way.
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <stdexcept>
#include <thread>

#include "atrapos/exodus/ResultReader.hpp"
#include "support/StripRun.hpp"

namespace atrapos::test {
namespace {

constexpr int kPoints = 5;  ///< per step, in the deck

/// Waits until path.csv has the first row of this step.
void waitForStep(Command& command, const StripFolder& folder, int step) {
  const auto limit = std::chrono::steady_clock::now() + std::chrono::seconds(120);
  while (std::chrono::steady_clock::now() < limit) {
    if (!command.running()) throw std::runtime_error("the run ended by itself: " + command.wait().err);
    if (std::filesystem::exists(folder.results("path.csv")) &&
        readFile(folder.results("path.csv")).find("\n" + std::to_string(step) + ",") != std::string::npos)
      return;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  throw std::runtime_error("no step " + std::to_string(step) + " in two minutes");
}

/// The result file's steps are those of the table, state by state. Returns their number, the start not
/// counted.
int consistentSteps(const StripFolder& folder) {
  const exodus::ResultReader results(folder.results("results.exo").string());
  const std::string text = readFile(folder.results("path.csv"));
  EXPECT_EQ(text.back(), '\n') << "a row was cut";
  const Table path(folder.results("path.csv"));
  const auto step = path.column("step"), length = path.column("path_length"),
             load = path.column("load_factor");
  const int steps = results.numSteps() - 1;
  const auto times = results.times();
  EXPECT_GE(path.numRows(), 1 + kPoints * steps);
  for (int s = 0; s <= steps && kPoints * s < path.numRows(); ++s) {
    EXPECT_EQ(step[kPoints * s], s);
    EXPECT_EQ(times[s], length[kPoints * s]);
    EXPECT_EQ(results.global(s, "load_factor"), load[kPoints * s]);
    for (const std::string& name : results.nodalNames()) EXPECT_FALSE(results.nodal(s, name).empty());
  }
  // A step's rows come before its fields, so that at most one step is in the table alone.
  EXPECT_LE(path.numRows(), 1 + kPoints * (steps + 1));
  return steps;
}

TEST(Interrupted, KilledRunKeepsEveryFinishedStep) {
  StripFolder folder("solid.yaml");
  std::filesystem::create_directory(folder.path() / "results");
  // Of an earlier run: what others wrote is not replaced.
  writeFile(folder.results("summary.json"), "{\n  \"program\": \"atrapos 0.1.0\"\n}\n");
  Command command(StripFolder::run(), folder.path());
  waitForStep(command, folder, 30);
  command.send(SIGKILL);
  const CommandResult r = command.wait();
  EXPECT_EQ(r.signal, SIGKILL);
  const int steps = consistentSteps(folder);
  EXPECT_GE(steps, 29);
  EXPECT_LT(steps, 150) << "the run was not ended in the middle";
  // A summary beside them would be taken for theirs.
  EXPECT_FALSE(std::filesystem::exists(folder.results("summary.json")));

  // What was written is the beginning of the whole path.
  const StripRun again("solid.yaml", {{"{load_factor: 0.25}", "{load_factor: 0.25, steps: 29}"}});
  const std::string whole = readFile(again.folder.results("path.csv"));
  EXPECT_EQ(readFile(folder.results("path.csv")).substr(0, whole.size()), whole);
}

class Signal : public testing::TestWithParam<int> {};

TEST_P(Signal, EndsTheRunInGoodOrder) {
  StripFolder folder("solid.yaml");
  Command command(StripFolder::run(), folder.path());
  waitForStep(command, folder, 20);
  command.send(GetParam());
  const CommandResult r = command.wait();
  EXPECT_EQ(r.signal, 0);
  EXPECT_EQ(r.exitCode, 3);
  EXPECT_EQ(r.out, "");
  EXPECT_NE(r.err.find("interrupted"), std::string::npos) << r.err;
  const int steps = consistentSteps(folder);
  const auto summary = nlohmann::json::parse(readFile(folder.results("summary.json")));
  EXPECT_EQ(summary.at("steps"), steps);
  EXPECT_EQ(summary.at("reached_stop"), false);
  EXPECT_EQ(summary.at("ended"), "interrupted");
  EXPECT_EQ(Table(folder.results("path.csv")).numRows(), 1 + kPoints * steps);
  // The step under way and, the signal coming between two looks at it, one more.
  EXPECT_LT(steps, 150) << "the run was not ended in the middle";
}

INSTANTIATE_TEST_SUITE_P(Interrupted, Signal, testing::Values(SIGINT, SIGTERM),
                         [](const auto& info) { return info.param == SIGINT ? "SIGINT" : "SIGTERM"; });

}  // namespace
}  // namespace atrapos::test
