// examples/reaction, heat and electric on several ranks and threads.
#include <gtest/gtest.h>

#include <string>

#include "support/ExampleRun.hpp"
#include "support/SameTable.hpp"

namespace atrapos::test {

/// Hopf points are the same on several ranks.
TEST(Brusselator, OnSeveralRanks) {
  const ExampleRun one("reaction/brusselator.yaml");
  const auto& known = one.summary.at("hopf_points");
  for (const int ranks : {2, 3}) {
    const auto result =
        runAtraposOnRanks(ranks, {"run", "-q", "-o", "ranks", "deck.yaml"}, one.folder.path());
    ASSERT_EQ(result.exitCode, 0) << result.err;
    const auto found =
        nlohmann::json::parse(readFile(one.folder.path() / "ranks/summary.json")).at("hopf_points");
    ASSERT_EQ(found.size(), known.size()) << ranks;
    for (std::size_t n = 0; n < found.size(); ++n) {
      // A hundred times what eigenvalues are computed to.
      const double load = known[n].at("load_factor");
      EXPECT_NEAR(found[n].at("load_factor"), load, 1e-6 * load);
      EXPECT_EQ(found[n].at("negative_change"), 2);
    }
  }
}

/// The same paths on one, two and three ranks and on two threads, to what sums in another order make: 1e-12
/// is seen. (Not those with branches here: near a bifurcation point the radius of a series is that of its
/// rounding, and so are the steps.)
TEST(Physics, OnRanksAndThreads) {
  for (const char* name : {"reaction/bratu_square.yaml", "reaction/bratu_cube.yaml", "heat/thermistor.yaml",
                           "electric/pull_in.yaml", "electric/elastomer.yaml"}) {
    const ExampleFolder folder(name);
    const auto run = [&](int ranks, const std::string& threads, const std::string& results) {
      const CommandResult r =
          runAtraposOnRanks(ranks, {"run", "-q", "deck.yaml", "-o", results, "-t", threads}, folder.path());
      EXPECT_EQ(r.exitCode, 0) << r.err;
      return Table(folder.path() / results / "path.csv");
    };
    const Table one = run(1, "1", "one");
    const bool threads =
        nlohmann::json::parse(readFile(folder.path() / "one" / "summary.json")).at("execution_space") !=
        "Serial";
    for (int other : {2, 3, 0}) {
      if (other == 0 && !threads) continue;
      const Table many = run(other == 0 ? 1 : other, other == 0 ? "2" : "1", "on" + std::to_string(other));
      SCOPED_TRACE(std::string(name) + " on " + std::to_string(other));
      expectSameTable(one, many, 1e-10);
    }
  }
}

}  // namespace atrapos::test
