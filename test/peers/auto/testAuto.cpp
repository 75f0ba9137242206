// Folds, branch points and branches of model problems against those that AUTO-07p found (README.md).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "support/Command.hpp"
#include "support/Folder.hpp"

namespace atrapos::test {
namespace {

using Rows = std::vector<std::map<std::string, std::string>>;

Rows rows(const std::filesystem::path& file) {
  std::istringstream in(readFile(file));
  std::string line, word;
  std::vector<std::string> header;
  std::getline(in, line);
  for (std::istringstream parts(line); std::getline(parts, word, ',');) header.push_back(word);
  Rows table;
  while (std::getline(in, line)) {
    auto& row = table.emplace_back();
    std::istringstream parts(line);
    for (const auto& name : header) row[name] = std::getline(parts, word, ',') ? word : "";
  }
  return table;
}

double number(const std::map<std::string, std::string>& row, const std::string& name) {
  return std::stod(row.at(name));
}

struct Peer {
  const char* name;
  const char* parameters;
  const char* stop;                   ///< as far as AUTO went
  std::vector<std::string> monitors;  ///< those of curves.csv
};

void PrintTo(const Peer& peer, std::ostream* out) { *out << peer.name; }

class Auto : public testing::TestWithParam<Peer> {
 protected:
  void SetUp() override {
    const Peer& peer = GetParam();
    // AUTO goes both ways from its branch points. Output points are close, so that straight lines between
    // them are the curve.
    for (const std::string direction : {"1", "-1"}) {
      writeFile(folder_ / "deck.yaml",
                std::string("problem: {name: ") + peer.name + ", parameters: " + peer.parameters +
                    "}\npath: {accuracy: 1.0e-8, residual: 1.0e-10, branches: all, direction: " + direction +
                    ", stop: " + peer.stop + "}\noutput: {points_per_step: 100}\n");
      const CommandResult r = runAtrapos({"run", "-q", "deck.yaml"}, folder_.path());
      ASSERT_EQ(r.exitCode, 0) << r.err;
      for (const auto& row : rows(folder_ / "deck_results" / "points.csv")) points_.push_back(row);
      for (auto row : rows(folder_ / "deck_results" / "path.csv")) {
        row["branch"] = direction + " " + row["branch"];
        path_.push_back(row);
      }
    }
  }
  Rows points_, path_;
  TemporaryFolder folder_;
};

TEST_P(Auto, SameFoldsAndBranchPoints) {
  const Peer& peer = GetParam();
  const Rows& ours = points_;
  int compared = 0;
  const Rows theirs = rows(std::string(ATRAPOS_PEER_DATA) + "/points.csv");
  for (const auto& point : theirs) {
    if (point.at("problem") != peer.name) continue;
    ++compared;
    double nearest = 1e300;
    for (const auto& mine : ours) {
      const bool fold = mine.at("kind") == "maximum" || mine.at("kind") == "minimum";
      if (fold != (point.at("kind") == "LP")) continue;
      const double load = number(mine, "load_factor") - number(point, "load_factor");
      const double value = number(mine, point.at("monitor")) - number(point, "value");
      // A fold's place is known to the square root of its load's error on either side.
      nearest = std::min(nearest, std::max(std::abs(load), (fold ? 1e-3 : 1.0) * std::abs(value)));
    }
    // AUTO's numbers have 11 digits and its tolerances are 1e-11; our path's residual bound is 1e-10.
    EXPECT_LE(nearest, 1e-8) << point.at("kind") << " at load " << point.at("load_factor");
  }
  EXPECT_GT(compared, 0);
  // Nothing that AUTO does not know: bifurcation points one by one, in the range that AUTO went.
  for (const auto& mine : ours) {
    if (mine.at("nullity") == "0") continue;
    const bool known = std::any_of(theirs.begin(), theirs.end(), [&](const auto& point) {
      return point.at("problem") == peer.name && point.at("kind") == "BP" &&
             std::abs(number(mine, "load_factor") - number(point, "load_factor")) <= 1e-8;
    });
    EXPECT_TRUE(known) << mine.at("kind") << " at load " << mine.at("load_factor");
  }
}

TEST_P(Auto, SameDiagram) {
  const Peer& peer = GetParam();
  const Rows& ours = path_;
  const auto place = [&](const auto& row, bool mine) {
    std::vector<double> x{number(row, "load_factor")};
    for (std::size_t m = 0; m < peer.monitors.size(); ++m)
      x.push_back(number(row, mine ? peer.monitors[m] : "monitor_" + std::to_string(m + 1)));
    return x;
  };
  double worst = 0;
  int compared = 0;
  for (const auto& point : rows(std::string(ATRAPOS_PEER_DATA) + "/curves.csv")) {
    if (point.at("problem") != peer.name) continue;
    ++compared;
    const auto x = place(point, false);
    double nearest = 1e300;
    for (std::size_t i = 1; i < ours.size(); ++i) {
      if (ours[i].at("branch") != ours[i - 1].at("branch")) continue;
      const auto p = place(ours[i - 1], true), q = place(ours[i], true);
      double dot = 0, square = 0, distance = 0;
      for (std::size_t k = 0; k < x.size(); ++k) {
        dot += (x[k] - p[k]) * (q[k] - p[k]);
        square += (q[k] - p[k]) * (q[k] - p[k]);
      }
      const double t = square > 0 ? std::clamp(dot / square, 0.0, 1.0) : 0.0;
      for (std::size_t k = 0; k < x.size(); ++k) distance += std::pow(x[k] - p[k] - t * (q[k] - p[k]), 2);
      nearest = std::min(nearest, std::sqrt(distance));
    }
    worst = std::max(worst, nearest);
  }
  EXPECT_GT(compared, 50);
  // The sagitta of a hundredth of a step, on diagrams of size 1 to 15: curvature 1, chords of 0.05 at most.
  EXPECT_LE(worst, 1e-3);
}

INSTANTIATE_TEST_SUITE_P(
    Peers, Auto,
    testing::Values(
        Peer{"sway_truss", "{half_width: 0.5}", "{load_factor: [-0.62, 0.62]}", {"sinking", "sway"}},
        Peer{"shallow_arch", "{modes: 4, rise: 4}", "{load_factor: [-20.2, 20.2]}", {"mode_1", "mode_2"}},
        Peer{"euler_column", "{links: 10}", "{load_factor: [5.1, -0.2]}", {"shortening", "tip_rotation"}},
        Peer{"bratu_1d", "{points: 24}", "{monitor: {middle: [7.8, -1]}}", {"middle"}}),
    [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace atrapos::test
