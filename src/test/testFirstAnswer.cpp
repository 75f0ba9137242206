// What check says of a deck's numbers before any path, against a cantilever.
#include <gtest/gtest.h>

#include <cstdio>

#include "support/CheckedDeck.hpp"

namespace atrapos::test {
namespace {

// 20 x 1 x 1, E = 1000, I = 1/12: a force of 1e-3 at the tip bends it by F L^3/(3 E I) = 32 F, and by its
// shear F L/(5/6 G A) = 0.048 F.
const std::string kCantilever = R"(mesh:
  file: m.exo
  generate: {shape: box, lengths: [20, 1, 1], divisions: [10, 1, 1]}
materials:
  m: {law: saint_venant_kirchhoff, youngs_modulus: 1000, poissons_ratio: 0, blocks: [body]}
supports:
  clamp: {set: x_min, x: 0, y: 0, z: 0}
loads:
  tip: {type: surface, set: x_max, total: [0, 0, -0.001]}
  weight: {type: volume, blocks: [body], force: [0, -1.0e-6, 0], constant: true}
path:
  stop: {load_factor: 2}
)";

class FirstAnswer : public ::testing::Test {
 protected:
  std::string of(const std::string& deck) { return checkedDeck(folder_, deck); }
  static void expectIn(const std::string& text, const std::string& line) {
    EXPECT_NE(text.find(line), std::string::npos) << line << "\n" << text;
  }
  TemporaryFolder folder_;
};

TEST_F(FirstAnswer, IsTheBeams) {
  const std::string text = of(kCantilever);
  expectIn(text, "# forces    at load factor 1: (0, 0, -0.001) in all");
  expectIn(text, "# forces    that stay: (0, -2e-05, 0) in all");
  expectIn(text, "# slender   1 thick for 20: a strut of it buckles at strains of 0.0021");
  const std::string begin = "# linear    at load factor 2: largest displacement ";
  expectIn(text, begin);
  double largest = 0;
  ASSERT_EQ(std::sscanf(text.c_str() + text.find(begin) + begin.size(), "%lf", &largest), 1);
  EXPECT_NEAR(largest, 2 * 32.048e-3, 0.01 * 0.064);  // three digits
  expectIn(text, "0.0032 of the size 20");
  EXPECT_EQ(text.find("loads or units"), std::string::npos) << text;
}

// A modulus in Pa beside lengths in mm, or the other way round.
TEST_F(FirstAnswer, WarnsOfUnits) {
  expectIn(of(edited(kCantilever, "youngs_modulus: 1000", "youngs_modulus: 1.0e-3")),
           "# warning   loads or units: the linear answer is 3.2e+03 of the body's size");
  expectIn(of(edited(kCantilever, "youngs_modulus: 1000", "youngs_modulus: 1.0e+10")),
           "# warning   loads or units: the linear answer is 3.2e-10 of the body's size");
}

// A tool that has not arrived moves nothing at first, and what drives a support drives the answer.
TEST_F(FirstAnswer, OfDrivenSupportsAndTools) {
  const std::string noTip =
      edited(kCantilever, "  tip: {type: surface, set: x_max, total: [0, 0, -0.001]}\n", "");
  expectIn(of(edited(noTip, "supports:\n", "supports:\n  pull: {set: x_max, x: {per_load_factor: 0.5}}\n")),
           "# linear    at load factor 2: largest displacement 1 at node");
  const std::string tool =
      of(edited(noTip, "path:\n",
                "tools:\n  punch: {type: sphere, center: [20, 0.5, 3], radius: 1, motion: {shift: [0, 0, "
                "-1]}}\ncontact:\n  top: {tool: punch, set: z_max, law: hard, points: nodes}\npath:\n"));
  EXPECT_EQ(tool.find("# linear"), std::string::npos) << tool;
  expectIn(tool, "# forces    that stay");
}

// A quarter of a tube: what is the same all around its axis is told, and no other mesh or load.
TEST_F(FirstAnswer, TellsOfBodiesOfRevolution) {
  const std::string tube = R"(mesh:
  file: m.exo
  generate: {shape: cylinder_panel, mid_radius: 2, thickness: 1, theta: [0, 90], length: 1, divisions: [6, 1, 2], block: body}
materials:
  m: {law: saint_venant_kirchhoff, youngs_modulus: 1000, poissons_ratio: 0.3, blocks: [body]}
supports:
  a: {set: theta_min, condition: symmetry_x}
  b: {set: theta_max, condition: symmetry_z}
  c: {set: y_min, y: 0}
loads:
  inside: {type: surface, set: inner, pressure: 1}
path:
  stop: {load_factor: 1}
)";
  const std::string line = "# waste     the linear answer is the same all around y: a plane body";
  expectIn(of(tube), line);
  const auto expectNot = [&](const std::string& deck) {
    const std::string text = of(deck);
    EXPECT_NE(text.find("# linear"), std::string::npos) << text;
    EXPECT_EQ(text.find("all around"), std::string::npos) << text;
  };
  expectNot(edited(tube, "c: {set: y_min, y: 0}", "c: {set: y_min, x: 0, y: 0}"));
  // A bar in tension, of which corners and middles of sides move alike, but are no circle's.
  expectNot(R"(mesh:
  file: m.exo
  generate: {shape: box, lengths: [2, 2, 4], divisions: [2, 2, 2], origin: [-1, -1, 0]}
materials:
  m: {law: saint_venant_kirchhoff, youngs_modulus: 1000, poissons_ratio: 0.3, blocks: [body]}
supports:
  clamp: {set: z_min, z: 0}
  axis: {set: x_min_y_min_z_min, x: 0, y: 0}
  turn: {set: x_max_y_min_z_min, y: 0}
loads:
  tip: {type: surface, set: z_max, total: [0, 0, 1]}
path:
  stop: {load_factor: 1}
)");
}

}  // namespace
}  // namespace atrapos::test
