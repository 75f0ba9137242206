// Hard tools that come from afar: until one touches, nothing moves but the load factor.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "support/Command.hpp"
#include "support/Folder.hpp"

namespace atrapos::test {
namespace {

/// A clamped sheet, top at z = 0.4, under a spherical punch whose centre moves down by the load factor.
std::string deck(double centre, double last, double down = 1) {
  std::ostringstream text;
  text.precision(12);
  text << "mesh:\n  file: sheet.exo\n  generate: {shape: shell_plate, length: 25, width: 25, divisions: [4, "
          "4], thickness: 0.8, block: sheet}\n"
          "materials:\n  steel: {law: saint_venant_kirchhoff, youngs_modulus: 210000, poissons_ratio: 0.3, "
          "blocks: [sheet]}\n"
          "supports:\n  sx: {set: x_min, condition: symmetry_x}\n  sy: {set: y_min, condition: symmetry_y}\n"
          "  rx: {set: x_max, condition: clamped}\n"
          "tools:\n  punch: {type: sphere, center: [0, 0, "
       << centre << "], radius: 10, motion: {shift: [0, 0, " << -down << "]}}\n"
       << "contact:\n  punch: {tool: punch, set: top, at: top, law: hard, points: nodes}\n"
          "path:\n  stop: {load_factor: "
       << last << "}\n"
       << "output:\n  monitors:\n    centre: {type: displacement, set: x_min_y_min, component: z}\n"
          "    force: {type: contact_force, contact: punch, component: z}\n";
  return text.str();
}

class Approach : public testing::Test {
 protected:
  /// Results in the folder of this name.
  CommandResult run(const std::string& name, const std::string& text) {
    writeFile(folder_ / (name + ".yaml"), text);
    if (!std::filesystem::exists(folder_ / "sheet.exo")) {
      EXPECT_EQ(runAtrapos({"mesh", "-q", name + ".yaml"}, folder_.path()).exitCode, 0);
    }
    return runAtrapos({"run", "-q", name + ".yaml", "-o", name}, folder_.path());
  }
  nlohmann::json summary(const std::string& name) const {
    return nlohmann::json::parse(readFile(folder_ / name / "summary.json"));
  }
  /// Columns of the last row of path.csv behind the load factor: centre, force.
  std::vector<double> last(const std::string& name) const {
    std::istringstream rows(readFile(folder_ / name / "path.csv"));
    std::string row, cell;
    for (std::string next; std::getline(rows, next);) row = next;
    std::istringstream cells(row);
    std::vector<double> numbers;
    while (std::getline(cells, cell, ',')) numbers.push_back(std::stod(cell));
    return {numbers.at(2), numbers.at(3), numbers.at(4)};
  }

  TemporaryFolder folder_;
};

// A gap delays: behind it the path is the one without a gap.
TEST_F(Approach, GapsDelay) {
  ASSERT_EQ(run("near", deck(10.4, 2)).exitCode, 0);
  for (const double gap : {1e-6, 0.1, 30.0}) {
    SCOPED_TRACE(gap);
    const CommandResult r = run("far", deck(10.4 + gap, 2 + gap));
    ASSERT_EQ(r.exitCode, 0) << r.err;
    const auto near = last("near"), far = last("far");
    EXPECT_NEAR(far[0], 2 + gap, 1e-12 * far[0]);
    // Both are exact to the residual's bound, 1e-6 of the forces, and the sheet stiffens.
    EXPECT_NEAR(far[1], near[1], 2e-6 * std::abs(near[1]));
    EXPECT_NEAR(far[2], near[2], 1e-5 * std::abs(near[2]));
  }
}

TEST_F(Approach, GoesOnFromBeforeTheTouch) {
  ASSERT_EQ(run("whole", deck(10.5, 2)).exitCode, 0);
  std::string text = deck(10.5, 2);
  const auto stop = text.find("stop: {");
  text.insert(stop + 7, "steps: 1, ");
  ASSERT_EQ(run("part", text).exitCode, 0);
  EXPECT_NEAR(last("part")[0], 0.1, 1e-9);
  writeFile(folder_ / "part.yaml", deck(10.5, 2));
  const CommandResult r =
      runAtrapos({"run", "-q", "part.yaml", "--restart", "part", "-o", "rest"}, folder_.path());
  ASSERT_EQ(r.exitCode, 0) << r.err;
  EXPECT_EQ(readFile(folder_ / "rest" / "path.csv"), readFile(folder_ / "whole" / "path.csv"));
}

/// The same under a penalty, whose force is below any number where the tool is not near.
std::string softened(std::string text) {
  return text.replace(text.find("law: hard"), 9, "law: penalty, stiffness: 1.0e4, length: 1.0e-3");
}

// No event tells where forces begin; the residual does. (With a gap below the length the law, zero at that
// gap, is another.)
TEST_F(Approach, PenaltiesFromAfar) {
  for (const double gap : {0.1, 3.0}) {
    const CommandResult r = run(gap < 1 ? "near" : "far", softened(deck(10.4 + gap, 1 + gap)));
    ASSERT_EQ(r.exitCode, 0) << r.err;
  }
  const auto near = last("near"), far = last("far");
  EXPECT_LT(near[1], -0.9);
  EXPECT_NEAR(far[1], near[1], 2e-6 * std::abs(near[1]));
  EXPECT_NEAR(far[2], near[2], 1e-5 * std::abs(near[2]));
  const CommandResult beside = run("beside", softened(deck(10.5, 3, 0)));
  EXPECT_EQ(beside.exitCode, 3);
  EXPECT_NE(beside.err.find("the load parameter does not move the unknowns"), std::string::npos)
      << beside.err;
}

// A tool that goes away moves nothing up to the stop; one that stands still is no path.
TEST_F(Approach, NothingTouches) {
  const CommandResult away = run("away", deck(10.5, 3, -1));
  ASSERT_EQ(away.exitCode, 0) << away.err;
  EXPECT_EQ(last("away"), (std::vector<double>{3, 0, 0}));
  // ... and without a stop on its way it ends, with a reason.
  std::string backwards = deck(10.5, 3, -1);
  backwards.insert(backwards.find("path:\n") + 6, "  direction: -1\n");
  backwards.replace(backwards.find("shift: [0, 0, 1]"), 16, "shift: [0, 0, -1]");
  const CommandResult never = run("never", backwards);
  EXPECT_EQ(never.exitCode, 3);
  EXPECT_NE(never.err.find("moves nothing, and neither an event nor a stop lies ahead"), std::string::npos)
      << never.err;
  const CommandResult beside = run("beside", deck(10.5, 3, 0));
  EXPECT_EQ(beside.exitCode, 3);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "beside" / "path.png"));  // of one point
  EXPECT_NE(beside.err.find("the load parameter does not move the unknowns"), std::string::npos)
      << beside.err;
}

}  // namespace
}  // namespace atrapos::test
