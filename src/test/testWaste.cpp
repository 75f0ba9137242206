// What check says of scenes that model more than they need.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "support/CheckedDeck.hpp"

namespace atrapos::test {
namespace {

/// A box under tension: its lengths and divisions, and supports beside x = 0 at its x_min.
std::string box(const std::string& generate, const std::string& supports, const std::string& path = "") {
  return "mesh:\n  file: m.exo\n  generate: {" + generate +
         "}\nmaterials:\n  m: {law: saint_venant_kirchhoff, youngs_modulus: 1000, poissons_ratio: 0.3, "
         "blocks: "
         "[body]}\nsupports:\n  left: {set: x_min, x: 0}\n" +
         supports +
         "loads:\n  right: {type: surface, set: x_max, total: [1, 0, 0]}\npath:\n  stop: {load_factor: 1}\n" +
         path;
}

class Waste : public ::testing::Test {
 protected:
  /// The lines of check that begin with "# waste".
  std::string of(const std::string& deck) {
    const std::string text = checkedDeck(folder_, deck);
    std::string lines;
    for (std::size_t at = text.find("# waste"); at != std::string::npos; at = text.find("# waste", at + 1))
      lines += text.substr(at, text.find('\n', at) + 1 - at);
    return lines;
  }
  TemporaryFolder folder_;
};

const std::string kHeld =
    "  front: {set: y_min, y: 0}\n  back: {set: y_max, y: 0}\n  below: {set: z_min, z: 0}\n";
const std::string kFree = "  front: {set: y_min, y: 0}\n  below: {set: z_min, z: 0}\n";

TEST_F(Waste, NothingMovesAcross) {
  const std::string lines =
      of(box("shape: box, lengths: [4, 1, 2], divisions: [4, 1, 2], cell: HEX20, block: body", kHeld));
  EXPECT_EQ(lines,
            "# waste     nothing moves along y: a plane body (plane: {kind: strain}) has a third of the "
            "unknowns and "
            "the same answer\n");
  EXPECT_EQ(of(box("shape: box, lengths: [4, 1, 2], divisions: [4, 1, 2], cell: HEX20, block: body", kFree)),
            "");
  EXPECT_EQ(of(box("shape: box, lengths: [4, 1, 2], divisions: [4, 2, 2], cell: HEX20, block: body", kHeld)),
            "");
  EXPECT_EQ(of(box("shape: box, lengths: [4, 1, 2], divisions: [4, 1, 2], cell: HEX20, block: body",
                   "  front: {set: y_min, y: 0}\n  back: {set: y_max, y: {per_load_factor: 0.01}}\n"
                   "  below: {set: z_min, z: 0}\n")),
            "");
}

TEST_F(Waste, ThinBodiesOfSolids) {
  const std::string thin =
      of(box("shape: box, lengths: [40, 30, 1], divisions: [4, 3, 1], cell: HEX20, block: body", kFree));
  EXPECT_EQ(
      thin.find("# waste     block 'body': HEX20 in a body 1 thick and 30 wide; shells (docs/shells.md)"), 0u)
      << thin;
  EXPECT_EQ(
      of(box("shape: box, lengths: [40, 19, 1], divisions: [4, 2, 1], cell: HEX20, block: body", kFree)), "");
}

TEST_F(Waste, OrdersThatCostMoreThanTheyBring) {
  const std::string mesh = "shape: box, lengths: [4, 1, 2], divisions: [4, 1, 2], cell: HEX20, block: body";
  EXPECT_NE(of(box(mesh, kFree, "  order: 5\n")).find("path/order: 5 takes several times"),
            std::string::npos);
  EXPECT_NE(of(box(mesh, kFree, "  order: 50\n")).find("path/order: 50 costs more than 30"),
            std::string::npos);
  EXPECT_EQ(of(box(mesh, kFree, "  order: 10\n")), "");
}

/// A block between two planes, with contact of all its sides, those above, and those that face the tool.
TEST_F(Waste, SidesThatLookAwayFromTheTool) {
  const std::string generate =
      "shape: box, lengths: [4, 4, 2], divisions: [4, 4, 2], cell: HEX20, block: body";
  const auto pressed = [&](const std::string& set) {
    return box(generate, "  below: {set: y_min, y: 0}\n  left_too: {set: x_min, z: 0}\n") +
           "tools:\n  floor: {type: plane, point: [0, 0, -0.1], normal: [0, 0, 1]}\n"
           "contact:\n  lower: {tool: floor, set: " +
           set + ", law: hard}\n";
  };
  EXPECT_EQ(of(pressed("z_min")), "");
  EXPECT_EQ(of(pressed("x_max")), "") << "across";
  EXPECT_EQ(of(pressed("z_max")),
            "# waste     contact/lower: 16 of the 16 sides in 'z_max' look away from 'floor', with the body "
            "between; a set without them has fewer points\n");
}

TEST_F(Waste, EdgesThatLookAwayFromTheTool) {
  const auto strip = [&](const std::string& set) {
    return box("shape: rectangle, lengths: [4, 1], divisions: [4, 1], block: body",
               "  left_too: {set: x_min, y: 0}\n") +
           "plane: {kind: strain}\n"
           "tools:\n  roll: {type: cylinder, center: [2, -3, 0], axis: [0, 0, 1], radius: 2}\n"
           "contact:\n  lower: {tool: roll, set: " +
           set + ", law: hard}\n";
  };
  EXPECT_EQ(of(strip("y_min")), "");
  EXPECT_NE(of(strip("y_max")).find("contact/lower: 4 of the 4 sides in 'y_max'"), std::string::npos);
}

/// What a run says in the end of a contact and of a metal that its path has made no use of.
TEST_F(Waste, WhatThePathHasMadeNoUseOf) {
  const auto run = [&](double yieldStress, double height) {
    writeFile(
        folder_ / "m.yaml",
        fmt::format("mesh: {{file: m.exo, generate: {{shape: rectangle, lengths: [4, 1], divisions: [4, 1], "
                    "block: body}}}}\n"
                    "plane: {{kind: strain}}\n"
                    "materials: {{metal: {{law: von_mises, youngs_modulus: 1000, poissons_ratio: 0.3, "
                    "yield_stress: {}, hardening_modulus: 100, blocks: [body]}}}}\n"
                    "supports: {{left: {{set: x_min, x: 0}}, below: {{set: y_min, y: 0}}}}\n"
                    "loads: {{up: {{type: surface, set: y_max, total: [0, 8, 0]}}}}\n"
                    "tools: {{lid: {{type: plane, point: [0, {}, 0], normal: [0, -1, 0]}}}}\n"
                    "contact: {{upper: {{tool: lid, set: y_max, law: hard}}}}\n"
                    "path: {{stop: {{load_factor: 1}}}}\n",
                    yieldStress, height));
    EXPECT_EQ(runAtrapos({"mesh", "-q", "m.yaml"}, folder_.path()).exitCode, 0);
    const CommandResult result = runAtrapos({"run", "m.yaml"}, folder_.path());
    EXPECT_EQ(result.exitCode, 0) << result.err;
    return result.out;
  };
  const std::string yield = "waste: materials/metal: has not yielded",
                    close = "waste: contact/upper: none of its";
  const std::string idle = run(100, 1.1);  // 2 of stress, 0.2 % of strain
  EXPECT_NE(idle.find(yield), std::string::npos) << idle;
  EXPECT_NE(idle.find(close), std::string::npos) << idle;
  EXPECT_NE(readFile(folder_ / "m_results/summary.json").find("\"unused\": ["), std::string::npos);
  const std::string yields = run(1, 1.1);
  EXPECT_EQ(yields.find(yield), std::string::npos) << yields;
  EXPECT_NE(yields.find(close), std::string::npos) << yields;
  const std::string closes = run(100, 1.001);
  EXPECT_NE(closes.find(yield), std::string::npos) << closes;
  EXPECT_EQ(closes.find(close), std::string::npos) << closes;
}

}  // namespace
}  // namespace atrapos::test
