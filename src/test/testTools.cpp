// Decks with every kind of tool: tools that are the same surface give the same path.
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "support/Command.hpp"
#include "support/Folder.hpp"
#include "support/SmallDeck.hpp"

namespace atrapos::test {
namespace {

const std::string kRoll = "{type: cylinder, center: [4, 0, -1.25], axis: [0, 1, 0], radius: 1}";

struct End {
  double loadFactor = 0, deflection = 0, force = 0;
};

class Tools : public testing::Test {
 protected:
  void SetUp() override {
    writeFile(folder_ / "deck.yaml", kSmallDeck);
    ASSERT_EQ(runAtrapos({"mesh", "-q", "deck.yaml"}, folder_.path()).exitCode, 0);
  }

  /// Last row of path.csv of the small deck with another tool.
  End end(const std::string& tool) {
    SCOPED_TRACE(tool);
    writeFile(folder_ / "deck.yaml", edited(kSmallDeck, kRoll, tool));
    const CommandResult r = runAtrapos({"run", "-q", "deck.yaml"}, folder_.path());
    EXPECT_EQ(r.exitCode, 0) << r.err;
    std::istringstream lines(readFile(folder_ / "deck_results" / "path.csv"));
    std::string line, last;
    while (std::getline(lines, line)) last = line;
    End e;
    EXPECT_EQ(std::sscanf(last.c_str(), "%*d,%*f,%lf,%lf,%lf", &e.loadFactor, &e.deflection, &e.force), 3)
        << last;
    EXPECT_NEAR(e.loadFactor, 0.5, 1e-12) << tool;
    return e;
  }

  void same(const End& a, const End& b) {
    // The path's residual bound is 1e-8.
    EXPECT_NEAR(a.deflection, b.deflection, 1e-7 * std::fabs(b.deflection));
    EXPECT_NEAR(a.force, b.force, 1e-7 * b.force);
  }

  TemporaryFolder folder_;
};

TEST_F(Tools, RollsWithAConstantRadiusAreTheCylinder) {
  const End cylinder = end(kRoll);
  same(end("{type: crowned_roll, center: [4, 0.3, -1.25], axis: [0, 1, 0], coefficients: [1]}"), cylinder);
  same(end("{type: crowned_roll, center: [4, 0.3, -1.25], axis: [0, -3, 0], places: [-2, -1, 0, 1.5], "
           "radii: [1, 1, 1, 1]}"),
       cylinder);
  same(end("{type: tapered_roll, center: [4, 0, -1.25], axis: [0, 1, 0], radius: 1, flat: 5, angle: 6, "
           "smoothing: 0.1}"),
       cylinder);
}

TEST_F(Tools, ATaperFarFromItsVertexIsACone) {
  // Half angle with the tangent 0.1, radius 1 at y = 0.5.
  const End cone =
      end("{type: cone, apex: [4, -9.5, -1.25], axis: [0, 1, 0], half_angle: 5.710593137499643}");
  same(end("{type: tapered_roll, center: [4, 0.5, -1.25], axis: [0, 2, 0], radius: 0.5, flat: -5, "
           "angle: -5.710593137499643, smoothing: 0.1, ends: one}"),
       cone);
}

TEST_F(Tools, EveryKindStopsTheBody) {
  // Without contact the tip goes down by 0.82.
  for (const char* tool :
       {"{type: plane, point: [0, 0, -0.25], normal: [0, 0, 2]}",
        "{type: sphere, center: [4, 0.5, -1.25], radius: 1}",
        "{type: sphere, center: [2, 0.5, 20], radius: 20.35, side: inside}",
        "{type: cylinder, center: [4, 0, 5], axis: [1, 0, 0], radius: 5.3, side: inside}",
        "{type: torus, center: [4, 0.5, -6.25], axis: [1, 0, 0], radius: 5, tube_radius: 1}",
        "{type: tapered_roll, center: [4, 0.5, -1.25], axis: [0, 1, 0], radius: 1, flat: 0.2, angle: 6, "
        "smoothing: 0.2}",
        "{type: crowned_roll, center: [4, 0.5, -1.25], axis: [0, 1, 0], coefficients: [1, 0, -0.1]}"}) {
    const End e = end(tool);
    EXPECT_LT(e.deflection, -0.2) << tool;
    EXPECT_GT(e.deflection, -0.4) << tool;
    EXPECT_GT(e.force, 2.5) << tool;  // of the 5 that pull the tip down
    EXPECT_LT(e.force, 5.0) << tool;
  }
}

}  // namespace
}  // namespace atrapos::test
