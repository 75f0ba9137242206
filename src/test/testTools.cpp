// Decks with every kind of tool: tools that are the same surface give the same path.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "support/Command.hpp"
#include "support/Folder.hpp"
#include "support/NurbsRoll.hpp"
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
    return endOfDeck(tool);
  }

  End endOfDeck(const std::string& what) {
    const CommandResult r = runAtrapos({"run", "-q", "deck.yaml"}, folder_.path());
    EXPECT_EQ(r.exitCode, 0) << r.err;
    std::istringstream lines(readFile(folder_ / "deck_results" / "path.csv"));
    std::string line, last;
    while (std::getline(lines, line)) last = line;
    End e;
    EXPECT_EQ(std::sscanf(last.c_str(), "%*d,%*f,%lf,%lf,%lf", &e.loadFactor, &e.deflection, &e.force), 3)
        << last;
    EXPECT_NEAR(e.loadFactor, 0.5, 1e-12) << what;
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

/// The roll of the small deck as a NURBS surface, |y| <= 3.
std::string nurbsRoll() {
  return test::nurbsRoll([](double a, double b, int end) {
    return std::array<double, 3>{4 + a, end == 0 ? 3.0 : -3.0, b - 1.25};
  });
}

TEST_F(Tools, ANurbsCylinderIsTheCylinder) {
  const End cylinder = end(kRoll);
  same(end("{type: patches, surfaces: " + nurbsRoll() + "}"), cylinder);
  writeFile(folder_ / "roll.yaml", "# a roll\nsurfaces: " + nurbsRoll() + "\n");
  same(end("{type: patches, file: roll.yaml}"), cylinder);
  // Two half planes side by side, one the other way round, are the plane.
  const End plane = end("{type: plane, point: [0, 0, -0.25], normal: [0, 0, 1]}");
  same(
      end("{type: patches, surfaces: {left: {degree: [1, 1], points: [[-9, -9, -0.25], [-9, 9, -0.25], [3.7, "
          "-9, -0.25], [3.7, 9, -0.25]]}, right: {degree: [1, 1], points: [[9, 9, -0.25], [9, -9, -0.25], "
          "[3.7, 9, -0.25], [3.7, -9, -0.25]]}}}"),
      plane);
}

// The tip is beyond the plate: without contact it goes down by 0.82.
TEST_F(Tools, BesideAPlateIsNoContact) {
  const End e = end(
      "{type: patches, surfaces: {plate: {degree: [1, 1], points: [[-9, -9, -0.25], [-9, 9, -0.25], [-1, -9, "
      "-0.25], [-1, 9, -0.25]]}}}");
  EXPECT_LT(e.deflection, -0.8);
  EXPECT_EQ(e.force, 0.0);
}

class Moving : public Tools {
 protected:
  /// End of the small deck without loads, with a tool and a clamp.
  End endWith(const std::string& tool, const std::string& clamp = "z: 0") {
    std::string deck = edited(kSmallDeck, kRoll, tool);
    deck = edited(deck, "loads:\n  tip: {type: surface, set: x_max, total: [0, 0, -10]}\n", "");
    writeFile(folder_ / "deck.yaml", edited(deck, "y: 0, z: 0}", "y: 0, " + clamp + "}"));
    return endOfDeck(tool);
  }
};

// A roll that comes up and a body that comes down are the same, seen from the body.
TEST_F(Moving, AToolThatRisesIsABodyThatSinks) {
  const End sinking = endWith(kRoll, "z: {per_load_factor: -1}");
  EXPECT_GT(sinking.force, 1.0);
  const auto rising = [&](const std::string& tool) {
    End e = endWith(tool);
    e.deflection -= 0.5;
    same(e, sinking);
  };
  const std::string roll = kRoll.substr(0, kRoll.size() - 1);
  rising(roll + ", motion: {shift: [0, 0, 1]}}");
  rising(roll + ", motion: {shift: [[0, 0, 0.5], [0, 0, 1]]}}");  // as far at the load factor 0.5
  rising(roll + ", motion: {shift: [0, 0, 1], angle: [200], axis: [0, 1, 0], pivot: [4, 0, -1.25]}}");
  rising("{type: patches, surfaces: " + nurbsRoll() + ", motion: {shift: [0, 0, 1]}}");
}

// A sphere that swings up about a pivot ends where one that goes straight ends; so does the body.
TEST_F(Moving, ATurnEndsWhereAShiftEnds) {
  // 2 below the pivot, turned by 45 degrees.
  const std::string sphere = "{type: sphere, center: [3, 0.5, -1.3], radius: 1, motion: ";
  const End straight = endWith(sphere + "{shift: [2.8284271247461903, 0, 1.1715728752538097]}}");
  EXPECT_GT(straight.force, 0.5);
  same(endWith(sphere + "{angle: [-90], axis: [0, 1, 0], pivot: [3, 0.5, 0.7]}}"), straight);
}

class Laws : public Tools {
 protected:
  End endWith(const std::string& law) {
    writeFile(folder_ / "deck.yaml", edited(kSmallDeck, "stiffness: 1000, regularisation: 1.0e-3", law));
    return endOfDeck(law);
  }
};

// All laws stop the body at the surface, 0.25 below it, up to what they yield: with the chosen stiffness,
// ten times that of a layer as thick as the body, less than 1 %.
TEST_F(Laws, AllStopTheBody) {
  const End hard = endWith("law: barrier, regularisation: 1.0e-5");
  for (const char* law : {"law: hyperbola, stiffness: 1.0e6, regularisation: 1.0e-6", "law: hyperbola",
                          "law: barrier", "law: power, stiffness: 1.0e6, regularisation: 1.0e-6, exponent: 3",
                          "law: power, stiffness: rigid, regularisation: 1.0e-9",
                          "law: exponential, touching: 1, length: 1.0e-3",
                          "law: penalty, stiffness: 1.0e6, length: 1.0e-4", "law: penalty"}) {
    const End e = endWith(law);
    EXPECT_NEAR(e.deflection, hard.deflection, 0.03 * std::fabs(hard.deflection)) << law;
    EXPECT_NEAR(e.force, hard.force, 0.03 * hard.force) << law;
  }
}

// eta falls along a path to where a run with the smaller eta ends.
TEST_F(Laws, SharpenedIsTheRunWithTheSmallerEta) {
  const std::string law = "stiffness: 1.0e6, carried: all, regularisation: ";
  const End sharp = endWith(law + "1.0e-6");
  endWith(law + "1.0e-2");
  writeFile(folder_ / "deck.yaml",
            edited(readFile(folder_ / "deck.yaml"), "order: 15", "order: 15\n  sharpen: 1.0e-4"));
  const End soft = endOfDeck("with sharpen");
  EXPECT_GT(std::fabs(soft.force - sharp.force), 5e-4 * sharp.force);
  std::istringstream lines(readFile(folder_ / "deck_results" / "sharpen.csv"));
  std::string line, last;
  std::getline(lines, line);
  EXPECT_EQ(line, "factor,tip_uz,force,residual");
  int rows = 0;
  for (; std::getline(lines, line); ++rows) last = line;
  End e;
  double factor = 0;
  ASSERT_EQ(std::sscanf(last.c_str(), "%lf,%lf,%lf", &factor, &e.deflection, &e.force), 3) << last;
  EXPECT_NEAR(factor, 1e-4, 1e-12);
  same(e, sharp);
  EXPECT_GT(rows, 2);
  EXPECT_NE(readFile(folder_ / "deck_results" / "summary.json").find("\"sharpened\""), std::string::npos);
}

/// Decks of a block over a floor.
class Floor : public Tools {
 protected:
  /// Values of the last row of path.csv behind the load factor.
  std::vector<double> last(const std::string& deck, const std::string& name = "floor.yaml") {
    writeFile(folder_ / name, deck);
    EXPECT_EQ(runAtrapos({"mesh", "-q", name}, folder_.path()).exitCode, 0);
    const CommandResult r = runAtrapos({"run", "-q", name}, folder_.path());
    EXPECT_EQ(r.exitCode, 0) << r.err;
    return lastRow(name.substr(0, name.size() - 5) + "_results/path.csv");
  }
  std::vector<double> lastRow(const std::string& file) {
    std::istringstream lines(readFile(folder_ / file));
    std::string line, row, cell;
    while (std::getline(lines, line)) row = line;
    std::vector<double> values;
    for (std::istringstream cells(row); std::getline(cells, cell, ',');) values.push_back(std::stod(cell));
    return values;
  }
  int rowsOf(const std::string& file) {
    const std::string text = readFile(folder_ / file);
    return static_cast<int>(std::count(text.begin(), text.end(), '\n')) - 1;
  }
};

// The points that carry the law cross a border where the curvature of the tool jumps, as all of them do; what
// is left out is less than eta a unit of area.
TEST_F(Floor, NearPointsCrossTheBorderOfPatches) {
  const std::string deck = R"(mesh:
  file: block.exo
  generate: {shape: box, lengths: [1, 1, 1], divisions: [3, 3, 2], cell: HEX8}
materials:
  rubber: {law: saint_venant_kirchhoff, youngs_modulus: 10, poissons_ratio: 0.3, blocks: [body]}
supports:
  top: {set: z_max, x: {per_load_factor: 0.5}, y: 0, z: {per_load_factor: -0.1}}
tools:
  floor:
    type: patches
    surfaces:
      plate: {degree: [1, 1], points: [[-1, -1, -0.65], [-1, 2, 0.25], [0.55, -1, -0.65], [0.55, 2, 0.25]]}
      arc: {degree: [2, 1], points: [[0.55, -1, -0.65], [0.55, 2, 0.25], [1.3, -1, -0.65], [1.3, 2, 0.25],
                                     [2, -1, -0.3], [2, 2, 0.6]]}
contact:
  lower: {tool: floor, set: z_min, quadrature_degree: 2, carried: all, stiffness: 1.0e3, regularisation: 1.0e-4}
path:
  order: 15
  residual: 1.0e-8
  stop: {load_factor: 1}
output:
  monitors:
    force: {type: contact_force, contact: lower}
    aside: {type: contact_force, contact: lower, component: x}
)";
  const auto all = last(deck), near = last(edited(deck, "carried: all", "carried: near"), "near.yaml");
  ASSERT_GT(all.size(), 4u);
  EXPECT_GT(all[3], 0.2);
  EXPECT_LT(all[4], -0.03);  // pressed against the arc
  const auto carried =
      nlohmann::json::parse(readFile(folder_ / "near_results/summary.json"))["contacts"]["lower"];
  EXPECT_LT(carried["points_carried"], carried["points"]);
  EXPECT_EQ(near[2], 1.0);
  for (int i = 3; i < 5; ++i) EXPECT_NEAR(near[i], all[i], 1e-4) << i;
}

/// Pressed flat on a plane by 1 % of its height, without Poisson's ratio.
const std::string kFlat = R"(mesh:
  file: block.exo
  generate: {shape: box, lengths: [4, 4, 1], divisions: [4, 4, 2], cell: HEX20}
materials:
  rubber: {law: saint_venant_kirchhoff, youngs_modulus: 1000, poissons_ratio: 0, blocks: [body]}
supports:
  left: {set: x_min, x: 0}
  front: {set: y_min, y: 0}
  top: {set: z_max, z: {per_load_factor: -0.02}}
tools:
  floor: {type: plane, point: [0, 0, -0.01], normal: [0, 0, 1]}
contact:
  lower: {tool: floor, set: z_min, law: hard}
path:
  stop: {load_factor: 1}
output:
  fields: [displacement, contact]
  monitors:
    force: {type: contact_force, contact: lower}
)";

// The force of Saint Venant-Kirchhoff's law at the stretch 0.99 on 16, E l (1 - l^2)/2; 25 corners close.
TEST_F(Floor, QuadraticCellsAreFlatUnderHardContact) {
  const double exact = 16 * 1000 * 0.99 * (1 - 0.99 * 0.99) / 2;
  const auto end = last(kFlat);
  ASSERT_GT(end.size(), 3u);
  EXPECT_NEAR(end[3], exact, 1e-6 * exact);  // bound of the residual: 1e-6 of the forces
  EXPECT_LE(end[0], 3);
  EXPECT_EQ(rowsOf("floor_results/events.csv"), 25);
}

// What only touches its tool at the start is held by it while it is pressed.
TEST_F(Floor, HardContactHoldsWhatTouches) {
  for (const char* points : {"quadrature", "nodes"}) {
    std::string deck = edited(kFlat, "cell: HEX20", "cell: HEX8");
    deck = edited(deck, "point: [0, 0, -0.01]", "point: [0, 0, 0]");
    deck = edited(deck, "law: hard", std::string("law: hard, points: ") + points);
    deck = edited(deck, "  top: {set: z_max, z: {per_load_factor: -0.02}}\n",
                  "loads:\n  top: {type: surface, set: z_max, total: [0, 0, -50]}\n");
    const auto end = last(deck);
    ASSERT_GT(end.size(), 3u);
    EXPECT_NEAR(end[3], 50, 1e-4) << points;  // bound of the residual: 1e-6 of the forces
  }
}

// A sphere pressed into the block: corners close one after the other, and a restart from any step has the
// same path and events.
TEST_F(Floor, RestartsOverFacesHaveTheSameEvents) {
  std::string deck = edited(kFlat, "{type: plane, point: [0, 0, -0.01], normal: [0, 0, 1]}",
                            "{type: sphere, center: [1.7, 1.6, -10.02], radius: 10}");
  deck = edited(deck, "per_load_factor: -0.02", "per_load_factor: -0.1");
  const auto end = last(deck, "whole.yaml");
  ASSERT_GT(end.size(), 3u);
  EXPECT_GE(rowsOf("whole_results/events.csv"), 4);
  for (int step = 1; step < end[0]; ++step) {
    ASSERT_EQ(runAtrapos({"run", "-q", "whole.yaml", "--restart", "whole_results", "--from",
                          std::to_string(step), "-o", "again"},
                         folder_.path())
                  .exitCode,
              0);
    for (const char* file : {"path.csv", "events.csv"})
      EXPECT_EQ(readFile(folder_ / "again" / file), readFile(folder_ / "whole_results" / file)) << step;
  }
}

// The floor as two patches, one under each half.
TEST_F(Floor, HardFacesOnPatches) {
  const std::string deck =
      edited(kFlat, "{type: plane, point: [0, 0, -0.01], normal: [0, 0, 1]}",
             "{type: patches, surfaces: {left: {degree: [1, 1], points: [[-1, -1, -0.01], [-1, 5, -0.01], "
             "[1.9, -1, -0.01], [1.9, 5, -0.01]]}, right: {degree: [1, 1], points: [[1.9, -1, -0.01], "
             "[1.9, 5, -0.01], [5, -1, -0.01], [5, 5, -0.01]]}}}");
  const auto plane = last(kFlat, "plane.yaml"), patches = last(deck, "patches.yaml");
  ASSERT_GT(plane.size(), 3u);
  EXPECT_EQ(patches[0], plane[0]);
  EXPECT_NEAR(patches[3], plane[3], 1e-9 * plane[3]);  // the same equations but for rounding
  EXPECT_EQ(rowsOf("patches_results/events.csv"), 25);
}

}  // namespace
}  // namespace atrapos::test
