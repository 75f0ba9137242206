// What check and run say of cells that lock in bending, against a cantilever's deflection.
#include <gtest/gtest.h>

#include <sstream>

#include "support/CheckedDeck.hpp"

namespace atrapos::test {
namespace {

// 10 x 1 x 1, E = 1000, I = 1/12: by beam theory the tip sinks by F L^3/(3 E I) = 4 F and, with the shear
// that cells have (G = E/2, all of the section), F L/(G A) = 0.02 F.
constexpr double kForce = 1e-3, kBeam = 4.02 * kForce;

std::string cantilever(const std::string& mesh) {
  return "mesh:\n  file: m.exo\n  generate: {" + mesh +
         "}\nmaterials:\n  m: {law: saint_venant_kirchhoff, youngs_modulus: 1000, poissons_ratio: 0, blocks: "
         "[body]}\n"
         "supports:\n  clamp: {set: x_min, x: 0, y: 0, z: 0}\nloads:\n  tip: {type: surface, set: x_max, "
         "total: [0, 0, -0.001]}\n"
         "path:\n  stop: {load_factor: 1}\noutput:\n  monitors:\n    tip: {type: displacement, set: x_max, "
         "component: z}\n";
}

class Locking : public ::testing::Test {
 protected:
  /// What check says, and the deflection of the tip.
  std::pair<std::string, double> of(const std::string& mesh) {
    const std::string check = checkedDeck(folder_, cantilever(mesh));
    const CommandResult run = runAtrapos({"run", "m.yaml"}, folder_.path());
    EXPECT_EQ(run.exitCode, 0) << run.err;
    EXPECT_EQ(run.out.find("locks in bending") != std::string::npos,
              check.find("locks in bending") != std::string::npos);
    std::istringstream lines(readFile(folder_ / "m_results/path.csv"));
    std::string line, last;
    while (std::getline(lines, line)) last = line;
    std::istringstream cells(last);
    for (int c = 0; c < 4; ++c) std::getline(cells, line, ',');
    return {check, -std::stod(line)};
  }
  TemporaryFolder folder_;
};

TEST_F(Locking, IsToldByHowMuch) {
  const auto [text, tip] = of("shape: box, lengths: [10, 1, 1], divisions: [5, 1, 1], cell: HEX8");
  EXPECT_NE(text.find("# warning   block 'body': HEX8 locks in bending: cells 2 long in a body 1 thick make "
                      "it some 200 % "
                      "too stiff; HEX27 does not"),
            std::string::npos)
      << text;
  EXPECT_NEAR(kBeam / tip, 1 + 2.0, 0.1);  // 200 %
  // As stiff with more cells through the thickness, which is what the number says.
  EXPECT_NEAR(of("shape: box, lengths: [10, 1, 1], divisions: [5, 1, 4], cell: HEX8").second / tip, 1, 0.05);
}

TEST_F(Locking, NotOfFineMeshesAndNotOfTheDefault) {
  const auto [fine, fineTip] = of("shape: box, lengths: [10, 1, 1], divisions: [32, 1, 1], cell: HEX8");
  EXPECT_EQ(fine.find("locks in bending"), std::string::npos) << fine;
  EXPECT_NEAR(kBeam / fineTip, 1, 0.06);
  const auto [text, tip] = of("shape: box, lengths: [10, 1, 1], divisions: [5, 1, 1]");
  EXPECT_NE(text.find("HEX27 in block 'body'"), std::string::npos) << text;
  EXPECT_EQ(text.find("locks in bending"), std::string::npos) << text;
  EXPECT_NEAR(kBeam / tip, 1, 0.01);
}

// What is as long as it is thick shears more than it bends.
TEST_F(Locking, NotOfThickBodies) {
  EXPECT_EQ(
      of("shape: box, lengths: [4, 1, 1], divisions: [1, 1, 1], cell: HEX8").first.find("locks in bending"),
      std::string::npos);
}

/// A row of HEX20 is singular, two rows are not.
TEST_F(Locking, RowsOfReducedCellsHaveNoStiffnessInTwist) {
  writeFile(folder_ / "m.yaml",
            cantilever("shape: box, lengths: [10, 1, 1], divisions: [5, 1, 1], cell: HEX20"));
  ASSERT_EQ(runAtrapos({"mesh", "-q", "m.yaml"}, folder_.path()).exitCode, 0);
  const std::string line = "block 'body': a row of HEX20, one cell wide and thick";
  EXPECT_NE(runAtrapos({"check", "m.yaml"}, folder_.path()).out.find(line), std::string::npos);
  const CommandResult run = runAtrapos({"run", "m.yaml"}, folder_.path());
  EXPECT_NE(run.out.find(line), std::string::npos) << run.out;
  EXPECT_NE(run.err.find("numerically singular"), std::string::npos) << run.err;
  const auto [two, tip] = of("shape: box, lengths: [10, 1, 1], divisions: [5, 2, 1], cell: HEX20");
  EXPECT_EQ(two.find("a row of HEX20"), std::string::npos) << two;
  EXPECT_NEAR(kBeam / tip, 1, 0.01);
}

}  // namespace
}  // namespace atrapos::test
