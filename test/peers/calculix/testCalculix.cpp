// Thin-walled columns with rigid joints against CalculiX: the first buckling loads and a cantilever's
// deflection (columns.py makes the same meshes and writes columns.csv).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "atrapos/exodus/MeshFile.hpp"
#include "atrapos/fem/StructuredShell.hpp"
#include "support/Command.hpp"
#include "support/Folder.hpp"
#include "support/Profile.hpp"
#include "support/Table.hpp"

namespace atrapos::test {
namespace {

using fem::test::Wall;

constexpr double kLength = 300, kE = 210000;
constexpr int kAlong = 18;

struct Section {
  const char* name;
  std::vector<Wall> walls;
};

const std::vector<Section>& sections() {
  static const std::vector<Section> all{
      {"box",
       {{{0, 0}, {100, 0}, 6}, {{100, 0}, {100, 50}, 6}, {{100, 50}, {0, 50}, 6}, {{0, 50}, {0, 0}, 6}}},
      {"square",
       {{{0, 0}, {100, 0}, 6}, {{100, 0}, {100, 100}, 6}, {{100, 100}, {0, 100}, 6}, {{0, 100}, {0, 0}, 6}}},
      {"angle", {{{60, 0}, {0, 0}, 4}, {{0, 0}, {0, 60}, 4}}},
      {"tee", {{{-50, 0}, {0, 0}, 4}, {{0, 0}, {50, 0}, 4}, {{0, 0}, {0, 60}, 4}}},
      {"i",
       {{{-30, 0}, {0, 0}, 3},
        {{0, 0}, {30, 0}, 3},
        {{0, 0}, {0, 100}, 6},
        {{-30, 100}, {0, 100}, 3},
        {{0, 100}, {30, 100}, 3}}},
      {"panel",
       {{{0, 0}, {60, 0}, 4},
        {{60, 0}, {120, 0}, 4},
        {{120, 0}, {180, 0}, 4},
        {{60, 0}, {60, 20}, 2},
        {{120, 0}, {120, 20}, 2}}},
      {"y",
       {{{0, 0}, {50, 0}, 4},
        {{0, 0}, {-25, 43.30127018922193}, 4},
        {{0, 0}, {-25, -43.30127018922193}, 4}}}};
  return all;
}

/// Numbers of a row of columns.csv: three buckling loads, three displacements.
std::vector<double> reference(const std::string& section) {
  std::ifstream file(ATRAPOS_PEER_DATA "/columns.csv");
  for (std::string line; std::getline(file, line);) {
    std::istringstream cells(line);
    std::string cell;
    std::getline(cells, cell, ',');
    if (cell != section) continue;
    std::vector<double> numbers;
    while (std::getline(cells, cell, ',')) numbers.push_back(std::stod(cell));
    return numbers;
  }
  throw std::runtime_error("columns.csv has no section " + section);
}

std::string deckOf(const Section& section, double nu, const std::string& rest) {
  std::string blocks;
  for (std::size_t w = 0; w < section.walls.size(); ++w)
    blocks += fmt::format("{}wall{}", w ? ", " : "", w + 1);
  return fmt::format(R"(mesh: {{file: mesh.exo}}
materials:
  steel: {{law: saint_venant_kirchhoff, youngs_modulus: {}, poissons_ratio: {}, blocks: [{}]}}
shells:
  sections:
    walls: {{blocks: [{}], thickness: 1}}
)",
                     kE, nu, blocks, blocks) +
         rest;
}

/// Of cells without middle nodes twice as many along each side: as many nodes as there are along the sides of
/// SHELL8.
fem::Mesh columnMesh(const Section& section, fem::Topology cell) {
  const int finer = cell == fem::Topology::Shell4 || cell == fem::Topology::Shell3 ? 2 : 1;
  std::vector<Wall> walls = section.walls;
  for (Wall& wall : walls) wall.divisions *= finer;
  fem::Mesh mesh = fem::test::profileMesh(walls, kLength, finer * kAlong, cell);
  mesh.nodeSets.push_back({"tip", 3, {fem::test::nodesAbove(mesh, section.walls[0].to).back()}});
  return mesh;
}

struct ColumnRun {
  TemporaryFolder folder;
  std::string out;

  ColumnRun(const Section& section, double nu, const std::string& deck,
            fem::Topology cell = fem::Topology::Shell8)
      : ColumnRun(columnMesh(section, cell), deckOf(section, nu, deck)) {}
  /// ranks > 0: by mpirun on so many.
  ColumnRun(const fem::Mesh& mesh, const std::string& deck, int ranks = 0) {
    exodus::writeMesh(mesh, (folder / "mesh.exo").string());
    writeFile(folder / "deck.yaml", deck);
    const std::vector<std::string> words{"run", "deck.yaml", "-o", "results"};
    const CommandResult r =
        ranks > 0 ? runAtraposOnRanks(ranks, words, folder.path()) : runAtrapos(words, folder.path());
    if (r.exitCode != 0) throw std::runtime_error(r.err);
    out = r.out;
  }
  Table table(const std::string& name) const { return Table(folder.path() / "results" / name); }
};

/// Monitors of a path at the load factors of a peer's table.
void expectAlong(const Table& path, const Table& peer, const std::vector<std::string>& monitors,
                 double tolerance) {
  const auto load = path.column("load_factor"), at = peer.column("load_factor");
  EXPECT_NEAR(load.back(), at.back(), 1e-12);  // a stop of the deck
  for (const std::string& u : monitors)
    for (std::size_t i = 0; i < at.size(); ++i)
      EXPECT_NEAR(interpolate(load, path.column(u), std::min(at[i], load.back())), peer.column(u)[i],
                  tolerance)
          << u << " at " << at[i];
}

class Columns : public ::testing::TestWithParam<Section> {};

/// The first buckling loads, N.
std::vector<double> bucklingLoads(const Section& section, double last, fem::Topology cell) {
  double area = 0;
  for (const Wall& w : section.walls) area += std::hypot(w.to[0] - w.from[0], w.to[1] - w.from[1]);
  const ColumnRun run(section, 0,
                      fmt::format(R"(supports:
  foot: {{set: foot, condition: hinged}}
  head: {{set: head, x: 0, y: 0, z: {{per_load_factor: -1}}}}
path:
  stop: {{load_factor: {}}}
output:
  monitors:
    force: {{type: reaction, support: head, component: z}}
)",
                                  1.02 * last * kLength / (kE * area)),
                      cell);
  return run.table("points.csv").column("force");
}

}  // namespace

TEST_P(Columns, BucklingLoads) {
  const auto expected = reference(GetParam().name);
  const auto found = bucklingLoads(GetParam(), expected[2], fem::Topology::Shell8);
  ASSERT_GE(found.size(), 3u);
  // Both have reduced integration of eight nodes. What differs is at the joints, where CalculiX has rigid
  // bodies of the corners' size (0.05 % in open sections, up to 0.6 % in the box), and prebuckling, 4e-4 of
  // strain.
  for (int m = 0; m < 3; ++m) EXPECT_NEAR(-found[m] / expected[m], 1, 0.008) << m;
}

// Half waves of the walls on four to six elements of order 2: 0.7 to 2.2 % above.
class FourNodeColumns : public ::testing::TestWithParam<Section> {};

TEST_P(FourNodeColumns, BucklingLoads) {
  const auto expected = reference(GetParam().name);
  const auto found = bucklingLoads(GetParam(), 1.02 * expected[2], fem::Topology::Shell4);
  ASSERT_GE(found.size(), 3u);
  for (int m = 0; m < 3; ++m) {
    EXPECT_GT(-found[m] / expected[m], 1) << m;
    EXPECT_LT(-found[m] / expected[m], 1.025) << m;
  }
}

// Triangles with rigid joints, the first load of a branch of three shells. (All sections: six nodes, which
// are soft, -3 to +0.1 %, three nodes -0.9 to +3.6 %.)
TEST(TriangleColumns, FirstBucklingLoad) {
  const Section& tee = sections()[3];
  const double expected = reference(tee.name)[0];
  for (const auto cell : {fem::Topology::Shell6, fem::Topology::Shell3}) {
    const auto found = bucklingLoads(tee, 1.02 * expected, cell);
    ASSERT_GE(found.size(), 1u) << fem::topologyName(cell);
    EXPECT_NEAR(-found[0] / expected, 1, 0.01) << fem::topologyName(cell);
  }
}

TEST_P(Columns, Deflection) {
  const auto expected = reference(GetParam().name);
  const ColumnRun run(GetParam(), 0.3, R"(supports:
  foot: {set: foot, condition: clamped}
loads:
  tip: {type: nodal, set: tip, per_node: [1, 2, 0]}
path:
  stop: {load_factor: 1.0e-3}
output:
  monitors:
    ux: {type: displacement, set: tip, component: x}
    uy: {type: displacement, set: tip, component: y}
    uz: {type: displacement, set: tip, component: z}
)");
  const Table path = run.table("path.csv");
  double size = 0;
  for (int i = 0; i < 3; ++i) size = std::hypot(size, expected[3 + i]);
  // 0.05 % where the force is at a joint of an open section, 0.1 to 0.7 % where it bends a corner of a box or
  // the free edge of an arm.
  for (int i = 0; i < 3; ++i)
    EXPECT_NEAR(1e3 * path.column(std::string("u") + "xyz"[i]).back() / size, expected[3 + i] / size, 0.01)
        << i;
}

// A right-angled frame of a strip 10 x 1, legs of 100, held at one end and pushed out of its plane at the
// other: the first leg bends and twists, the second bends, both far. Against solids with the corner as a
// block (frame.py).
TEST(Frame, LargeRotationsInSpace) {
  const Section frame{"frame", {{{100, 0}, {0, 0}, 10}, {{0, 0}, {0, 100}, 10}}};
  fem::Mesh mesh = fem::test::profileMesh(frame.walls, 10, 2);
  const auto root = fem::test::nodesAbove(mesh, {100, 0}), tip = fem::test::nodesAbove(mesh, {0, 100});
  ASSERT_EQ(tip.size(), 5u);
  mesh.nodeSets.push_back({"root", 3, root});
  mesh.nodeSets.push_back({"middle", 4, {tip[2]}});
  mesh.nodeSets.push_back({"corners", 5, {tip[0], tip[4]}});
  const std::string deck = deckOf(frame, 0.3, R"(supports:
  root: {set: root, condition: clamped}
loads:
  middle: {type: nodal, set: middle, total: [0, 0, 20]}
  corners: {type: nodal, set: corners, total: [0, 0, 20]}
path:
  stop: {load_factor: 1}
output:
  points_per_step: 20
  monitors:
    ux: {type: displacement, set: middle, component: x}
    uy: {type: displacement, set: middle, component: y}
    uz: {type: displacement, set: middle, component: z}
)");
  const ColumnRun run(mesh, deck), onRanks(mesh, deck, 2);
  const Table path = run.table("path.csv"), again = onRanks.table("path.csv"),
              solids(ATRAPOS_PEER_DATA "/frame.csv");
  // Joints whose directors are shared by ranks: the same end to the path's residual bound.
  for (const std::string u : {"ux", "uy", "uz"})
    EXPECT_NEAR(again.column(u).back(), path.column(u).back(), 1e-6 * 100) << u;
  ASSERT_GE(solids.column("load_factor").size(), 2u);
  // The block makes half a thickness of each leg stiff, 0.5 % of it, which the tip sees in part.
  expectAlong(path, solids, {"ux", "uy", "uz"}, 0.0025 * 100);
}

// A plate of SHELL4 bent and twisted far, against as many S4 (plate.py).
TEST(Plate, FourNodes) {
  fem::ShellPlateOptions options;
  options.length = 100;
  options.width = 20;
  options.divisions = {40, 8};
  options.topology = fem::Topology::Shell4;
  options.blockName = "plate";
  const ColumnRun run(fem::shellPlateMesh(options), R"(mesh: {file: mesh.exo}
materials:
  steel: {law: saint_venant_kirchhoff, youngs_modulus: 210000, poissons_ratio: 0.3, blocks: [plate]}
shells:
  sections:
    plate: {blocks: [plate], thickness: 1}
supports:
  root: {set: x_min, condition: clamped}
loads:
  near: {type: nodal, set: x_max_y_min, total: [0, 0, 20]}
  far: {type: nodal, set: x_max_y_max, total: [0, 0, 40]}
path:
  stop: {load_factor: 1}
output:
  points_per_step: 20
  monitors:
    near_uz: {type: displacement, set: x_max_y_min, component: z}
    far_uz: {type: displacement, set: x_max_y_max, component: z}
)");
  const Table path = run.table("path.csv"), peer(ATRAPOS_PEER_DATA "/plate.csv");
  ASSERT_EQ(peer.column("load_factor").size(), 4u);
  // Two elements of order 2 of the same size; CalculiX itself moves by 0.01 with its increments.
  expectAlong(path, peer, {"near_uz", "far_uz"}, 0.03);
}

INSTANTIATE_TEST_SUITE_P(CalculiX, Columns, ::testing::ValuesIn(sections()),
                         [](const auto& info) { return std::string(info.param.name); });
INSTANTIATE_TEST_SUITE_P(CalculiX, FourNodeColumns,  // a box, a branch, one of each kind of wall
                         ::testing::Values(sections()[0], sections()[3], sections()[5]),
                         [](const auto& info) { return std::string(info.param.name); });

}  // namespace atrapos::test
