// Kernels for several instruction sets in one program: each that the processor has gives the same path, and
// what cannot be is said in one line.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

#include "support/Command.hpp"
#include "support/Folder.hpp"
#include "support/SmallDeck.hpp"

using namespace atrapos::test;

namespace {

struct Level {
  const char* name;
  bool compiled, here;
};

std::vector<Level> levels() {
#ifdef ATRAPOS_KERNEL_LEVELS
  constexpr int lanes = ATRAPOS_KERNEL_LEVELS;
  return {{"v2", (lanes & 2) != 0, __builtin_cpu_supports("x86-64-v2") != 0},
          {"v3", (lanes & 4) != 0, __builtin_cpu_supports("x86-64-v3") != 0},
          {"v4", (lanes & 8) != 0, __builtin_cpu_supports("x86-64-v4") != 0}};
#else
  return {};
#endif
}

class Kernels : public testing::Test {
 protected:
  Kernels() {
    writeFile(folder_ / "deck.yaml", kSmallDeck);
    made_ = runAtrapos({"mesh", "-q", "deck.yaml"}, folder_.path());
    EXPECT_EQ(made_.exitCode, 0) << made_.err;
  }
  ~Kernels() override { unsetenv("ATRAPOS_KERNELS"); }

  /// All numbers of path.csv but the last column's, the residual's; of a run with these kernels.
  std::vector<double> pathWith(const std::string& level) {
    setenv("ATRAPOS_KERNELS", level.c_str(), 1);
    const CommandResult r = runAtrapos({"run", "-q", "deck.yaml", "-o", level}, folder_.path());
    EXPECT_EQ(r.exitCode, 0) << r.err;
    const auto summary = nlohmann::json::parse(readFile(folder_ / level / "summary.json"));
    EXPECT_NE(summary.at("kernels").get<std::string>().find("x86-64-" + level), std::string::npos);
    std::istringstream table(readFile(folder_ / level / "path.csv"));
    std::vector<double> numbers;
    std::string line, cell;
    std::getline(table, line);
    while (std::getline(table, line)) {
      std::vector<double> row;
      for (std::istringstream cells(line); std::getline(cells, cell, ',');)
        row.push_back(std::atof(cell.c_str()));
      numbers.insert(numbers.end(), row.begin(), row.end() - 1);
    }
    return numbers;
  }

  TemporaryFolder folder_;
  CommandResult made_;
};

TEST_F(Kernels, EveryLevelOfTheProcessorGivesThePath) {
  std::vector<double> first;
  int compared = 0;
  for (const Level& level : levels()) {
    if (!level.compiled || !level.here) continue;
    const auto path = pathWith(level.name);
    ASSERT_GT(path.size(), 20u);
    if (first.empty()) first = path;
    ASSERT_EQ(path.size(), first.size()) << level.name;
    // Fused multiplications round once, separate ones twice: 1e-16, times the conditioning of a bent cell's
    // tangent (1e4) and the length of sums. Steps end at rounding-dependent places: 1e-8 of the range.
    for (std::size_t i = 0; i < path.size(); ++i)
      EXPECT_NEAR(path[i], first[i], 1e-8 * (1 + std::abs(first[i]))) << level.name << ", number " << i;
    ++compared;
  }
  if (compared < 2) GTEST_SKIP() << "one set of kernels";
}

TEST_F(Kernels, AreNamedOrRefused) {
  if (levels().empty()) GTEST_SKIP() << "compiled for one instruction set";
  for (const Level& level : levels()) {
    setenv("ATRAPOS_KERNELS", level.name, 1);
    const CommandResult r = runAtrapos({"--version", "--verbose"}, folder_.path());
    if (level.compiled && level.here) {
      EXPECT_EQ(r.exitCode, 0) << r.err;
      EXPECT_NE(r.out.find(std::string("x86-64-") + level.name), std::string::npos) << r.out;
    } else {
      EXPECT_EQ(r.exitCode, 2);
      const std::string why = level.compiled ? std::string("this processor has no x86-64-") + level.name
                                             : "this build has kernels for v";
      ASSERT_EQ(r.errorLines().size(), 1u);
      EXPECT_EQ(r.errorLines()[0].rfind("atrapos: ATRAPOS_KERNELS=" + std::string(level.name) + ": " + why, 0),
                0u)
          << r.errorLines()[0];
    }
  }
  setenv("ATRAPOS_KERNELS", "avx", 1);
  const CommandResult r = runAtrapos({"run", "-q", "deck.yaml"}, folder_.path());
  EXPECT_EQ(r.exitCode, 2);
  EXPECT_EQ(r.errorLines(), std::vector<std::string>{"atrapos: ATRAPOS_KERNELS=avx: expected v2, v3 or v4"});
}

}  // namespace
