// Tools as surfaces for viewers: their points lie on them, and move as they do.
#include <gtest/gtest.h>

#include <Kokkos_Core.hpp>

#include <cmath>
#include <filesystem>

#include "atrapos/exodus/MeshFile.hpp"
#include "atrapos/exodus/ResultReader.hpp"
#include "output/ToolShapes.hpp"
#include "scene/DeckTool.hpp"
#include "support/Command.hpp"
#include "support/Folder.hpp"

namespace atrapos::test {
namespace {

using deck::Vector3;

const Box kBox{{-10, -5, -1}, {30, 5, 2}};

std::vector<deck::Tool> tools() {
  deck::SplineSurface saddle;
  saddle.name = "saddle";
  saddle.degree = {2, 1};
  saddle.points = {{0, -9, 0}, {0, 9, 0}, {5, -9, 2}, {5, 9, 2}, {10, -9, 0}, {10, 9, 0}};
  saddle.weights = {1, 1, 0.7, 0.7, 1, 1};
  deck::PatchesTool patches;
  patches.surfaces = {saddle};
  deck::CrownedRollTool table{{1, 2, -9}, {1, 1, 0}, {}, {-40, -10, 0, 15, 40}, {7, 6, 6.5, 6, 8}};
  deck::ToolMotion motion;
  motion.shift = {{1, 0, 0}, {0, 0, -2}};
  motion.angle = {30, -5};
  motion.axis = {0, 2, 1};
  motion.pivot = {3, 1, 0};
  std::vector<deck::Tool> all{
      {"plane", deck::PlaneTool{{1, 2, -3}, {0.2, 0.1, 1}}, motion},
      {"cylinder", deck::CylinderTool{{1, 2, -9}, {0, 1, 0.3}, 6}, motion},
      {"sphere", deck::SphereTool{{1, 2, -9}, 6}, motion},
      {"cone", deck::ConeTool{{-30, 0, -9}, {1, 0, 0.1}, 20}, motion},
      {"torus", deck::TorusTool{{1, 2, -9}, {0, 1, 1}, 8, 3}, motion},
      {"taper", deck::TaperedRollTool{{1, 2, -9}, {0, 1, 0}, 6, 2, 5, 0.4}, motion},
      {"crown", deck::CrownedRollTool{{1, 2, -9}, {0, 1, 0}, {6, 0.1, -0.02}, {}, {}}, motion},
      {"table", table, motion},
      {"patches", patches, motion}};
  return all;
}

TEST(ToolShapes, PointsLieOnTheToolWhereverItIs) {
  const Kokkos::ScopeGuard kokkos;  // patches are held in its arrays
  for (const deck::Tool& tool : tools()) {
    SCOPED_TRACE(tool.name);
    fem::Mesh mesh;
    appendToolShape(tool, kBox, mesh);
    ASSERT_GE(mesh.numNodes(), 4);
    EXPECT_EQ(mesh.blocks.at(0).name, tool.name);
    const auto rigid = makeTool(tool);
    for (const double lambda : {0.0, 0.7, -1.3}) {
      double worst = 0;
      int compared = 0;
      for (int a = 0; a < mesh.numNodes(); ++a) {
        const double* x = &mesh.coordinates[3 * a];
        const Vector3 at = moved(tool.motion, lambda, {x[0], x[1], x[2]});
        const double place[4] = {at[0], at[1], at[2], lambda};
        const double gap = rigid->project(place).gap;
        if (!std::isfinite(gap)) continue;  // the rim of a patch
        worst = std::max(worst, std::abs(gap));
        ++compared;
      }
      EXPECT_LT(worst, 1e-7) << lambda;  // what rays to rolls stop at, 1e-9 of the radius, and projections
      EXPECT_GT(compared, mesh.numNodes() / 2);
    }
  }
}

TEST(ToolShapes, RunsWriteThemBesideTheirResults) {
  TemporaryFolder folder;
  const std::string deck =
      "mesh: {file: m.exo, generate: {shape: box, lengths: [4, 1, 1], divisions: [4, 2, 1], cell: HEX20, "
      "block: b}}\n"
      "materials:\n  m: {law: saint_venant_kirchhoff, youngs_modulus: 1000, poissons_ratio: 0.3, blocks: "
      "[b]}\n"
      "supports:\n  clamp: {set: x_min, x: 0, y: 0, z: 0}\n"
      "tools:\n  punch: {type: sphere, center: [4, 0.5, 4], radius: 3, motion: {shift: [0, 0, -0.2]}}\n"
      "contact:\n  top: {tool: punch, set: z_max}\n"
      "path:\n  stages:\n    press: {drives: [punch], stop: {load_factor: 1}}\n"
      "    away: {drives: [punch], stop: {load_factor: 0.5}}\n";
  writeFile(folder / "d.yaml", deck);
  ASSERT_EQ(runAtrapos({"mesh", "-q", "d.yaml"}, folder.path()).exitCode, 0);
  const CommandResult run = runAtrapos({"run", "-q", "d.yaml", "-o", "out"}, folder.path());
  ASSERT_EQ(run.exitCode, 0) << run.err;
  const double ends[2][2] = {{0, 1}, {1, 0.5}};
  for (int stage = 0; stage < 2; ++stage) {
    const std::string suffix = stage == 0 ? ".exo" : "_branch1.exo";
    const exodus::ResultReader tools((folder / "out" / ("tools" + suffix)).string()),
        results((folder / "out" / ("results" + suffix)).string());
    ASSERT_EQ(tools.times(), results.times());
    const int last = tools.numSteps() - 1;
    for (const double z : tools.nodal(0, "displ_z")) EXPECT_NEAR(z, -0.2 * ends[stage][0], 1e-9);
    for (const double z : tools.nodal(last, "displ_z")) EXPECT_NEAR(z, -0.2 * ends[stage][1], 1e-9);
  }
  // Another run in the folder, of one stage, leaves none of the earlier one's; a tools.exo of somebody else
  // stays.
  writeFile(folder / "d.yaml", deck.substr(0, deck.find("  stages")) + "  stop: {load_factor: 0.5}\n");
  ASSERT_EQ(runAtrapos({"run", "-q", "d.yaml", "-o", "out"}, folder.path()).exitCode, 0);
  EXPECT_FALSE(std::filesystem::exists(folder / "out" / "tools_branch1.exo"));
  writeFile(folder / "out" / "tools.exo", "mine");
  EXPECT_EQ(runAtrapos({"run", "-q", "d.yaml", "-o", "out"}, folder.path()).exitCode, 2);
  EXPECT_EQ(readFile(folder / "out" / "tools.exo"), "mine");
}

}  // namespace
}  // namespace atrapos::test
