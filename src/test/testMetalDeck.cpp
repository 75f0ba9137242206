// Decks with metal in thin bodies: ranks, restart, results, what is refused.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "atrapos/exodus/MeshFile.hpp"
#include "atrapos/fem/StructuredMesh.hpp"
#include "output/TableFile.hpp"
#include "support/Command.hpp"
#include "support/Folder.hpp"
#include "support/HalvedMesh.hpp"

namespace atrapos::test {
namespace {

// A plate held at one edge and bent by the other beyond first yield.
const std::string kPlate = R"(mesh:
  file: plate.exo
  generate: {shape: shell_plate, length: 40, width: 10, divisions: [8, 2], thickness: 1}
shells: {thickness_points: 4}
materials:
  metal: {law: von_mises, youngs_modulus: 70000, poissons_ratio: 0.3, yield_stress: 100, kinematic_modulus: 2000, blocks: [shell]}
supports:
  root: {set: x_min, condition: clamped}
loads:
  tip: {type: edge, set: x_max, total: [0, 0, 6.5]}
path:
  stop: {load_factor: 1}
output:
  points_per_step: 1
  monitors:
    tip: {type: displacement, set: x_max_y_min, component: z}
)";

class MetalDeck : public testing::Test {
 protected:
  void write(const std::string& deck) {
    writeFile(folder_ / "plate.yaml", deck);
    ASSERT_EQ(runAtrapos({"mesh", "-q", "plate.yaml"}, folder_.path()).exitCode, 0);
  }
  std::vector<double> tips(const std::string& results) const {
    return TableFile((folder_ / results / "path.csv").string()).numbers("tip");
  }
  void run(const std::string& results, const std::vector<std::string>& more = {}, int ranks = 0) {
    std::vector<std::string> words{"run", "-q", "plate.yaml", "-o", results};
    words.insert(words.end(), more.begin(), more.end());
    const CommandResult r =
        ranks > 0 ? runAtraposOnRanks(ranks, words, folder_.path()) : runAtrapos(words, folder_.path());
    ASSERT_EQ(r.exitCode, 0) << r.err;
  }
  void refuses(const std::string& deck, const std::string& expected) {
    write(kPlate);
    writeFile(folder_ / "plate.yaml", deck);
    const CommandResult r = runAtrapos({"check", "plate.yaml"}, folder_.path());
    EXPECT_EQ(r.exitCode, 2);
    ASSERT_EQ(r.errorLines().size(), 1u) << r.err;
    EXPECT_NE(r.err.find(expected), std::string::npos) << r.err;
  }
  TemporaryFolder folder_;
};

}  // namespace

TEST_F(MetalDeck, ShellsYieldOnRanksAsAlone) {
  write(kPlate);
  run("alone");
  run("ranks", {}, 3);
  const auto a = tips("alone"), b = tips("ranks");
  ASSERT_EQ(a.size(), b.size());
  EXPECT_GT(a.size(), 10u);  // points yield one after the other
  // Sums in another order; a residual of 1e-6.
  EXPECT_NEAR(b.back(), a.back(), 1e-7 * a.back());
}

/// Laws have no value next to the start on one rank, whichever that is.
TEST_F(MetalDeck, AStartWithoutAValueOnOneRankIsBadInput) {
  fem::BoxOptions bar;
  bar.lengths = {8, 1, 1};
  bar.divisions = {8, 1, 1};
  bar.blockName = "block";
  exodus::writeMesh(halved(fem::boxMesh(bar)), (folder_ / "bar.exo").string());
  for (const bool first : {true, false}) {
    const std::string bad = first ? "block" : "other", good = first ? "other" : "block";
    writeFile(folder_ / "bar.yaml",
              "mesh: {file: bar.exo}\nmaterials:\n"
              "  steel: {law: saint_venant_kirchhoff, youngs_modulus: 1000, poissons_ratio: 0.3, blocks: [" +
                  good +
                  "]}\n"
                  "  hard: {law: von_mises, strains: finite, yield_stress: 1, youngs_modulus: 1.0e300, "
                  "poissons_ratio: 0.3, blocks: [" +
                  bad +
                  "]}\n"
                  "supports:\n  clamp: {set: " +
                  (first ? "x_max" : "x_min") +
                  ", x: 0, y: 0, z: 0}\n"
                  "  pull: {set: " +
                  (first ? "x_min" : "x_max") +
                  ", x: {per_load_factor: 1}}\npath: {stop: {load_factor: 1}}\n");
    const CommandResult r = runAtraposOnRanks(2, {"run", "-q", "bar.yaml"}, folder_.path());
    EXPECT_EQ(r.exitCode, 2) << r.err;
    EXPECT_EQ(r.err.rfind("bar.yaml: the start cannot be evaluated: entity ", 0), 0u) << r.err;
  }
}

TEST_F(MetalDeck, RestartRemembersShells) {
  write(kPlate);
  run("whole");
  write(edited(kPlate, "load_factor: 1}", "load_factor: 1, steps: 8}"));
  run("parts");
  write(kPlate);
  run("parts", {"--restart", "parts"});
  EXPECT_EQ(tips("parts"), tips("whole"));
}

TEST_F(MetalDeck, AssumedShearYieldsAlike) {
  write(kPlate);
  run("compatible");
  write(edited(kPlate, "thickness_points: 4", "thickness_points: 4, shear: assumed"));
  run("assumed");
  // Two elements of one theory at a clamped edge: the one of the displacements is the stiffer.
  const double assumed = tips("assumed").back(), compatible = tips("compatible").back();
  EXPECT_NEAR(assumed, compatible, 0.05 * compatible);
  EXPECT_GT(assumed, compatible);
}

TEST_F(MetalDeck, Refusals) {
  refuses(edited(kPlate, "kinematic_modulus: 2000", "strains: finite"),
          "materials/metal/strains: finite strains are for solids, plane strain and axisymmetry");
  refuses(edited(kPlate, "thickness_points: 4", "thickness_points: 1"), "from 2 to 10");
  refuses(edited(kPlate, "  stop:", "  method: newton\n  stop:"), "von_mises needs path/method: series");
}

}  // namespace atrapos::test
