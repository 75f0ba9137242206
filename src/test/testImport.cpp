// `atrapos import`: its manners, and the way from the files of others to a path.
#include <gtest/gtest.h>
#ifdef ATRAPOS_GMSH
#include <gmsh.h>
#endif

#include <algorithm>
#include <cmath>
#include <sstream>

#include "atrapos/exodus/MeshFile.hpp"
#include "support/Command.hpp"
#include "support/Folder.hpp"

namespace atrapos::test {
namespace {

/// A bar of one cell that is pulled along x.
const std::string kBar =
    "*NODE, NSET=all\n1\n2, 10.\n3, 10., 1.\n4, 0., 1.\n5, 0, 0, 1\n6, 10, 0, 1\n7, 10, 1, 1\n8, 0, 1, 1\n"
    "*ELEMENT, TYPE=C3D8, ELSET=bar\n1, 1, 2, 3, 4, 5, 6, 7, 8\n*NSET, NSET=tip\n2, 3, 6, 7\n*MATERIAL, "
    "NAME=steel\n*ELASTIC\n210000., 0.\n"
    "*SOLID SECTION, ELSET=bar, MATERIAL=steel\n*BOUNDARY\n1, 1, 3\n4, 1\n4, 3\n5, 1, 2\n8, 1\n*STEP, "
    "NLGEOM\n*STATIC\n*CLOAD\ntip, 1, 25.\n"
    "*EL PRINT, ELSET=bar\nS\n*END STEP\n";

/// A cell of Gmsh, 2.2, with a side.
const std::string kCell =
    "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n2 1 \"foot\"\n3 2 \"the "
    "body\"\n$EndPhysicalNames\n$Nodes\n8\n1 0 0 0\n2 1 0 0\n"
    "3 1 1 0\n4 0 1 0\n5 0 0 1\n6 1 0 1\n7 1 1 1\n8 0 1 1\n$EndNodes\n$Elements\n2\n1 3 2 1 1 1 2 3 4\n2 5 2 "
    "2 1 1 2 3 4 5 6 7 8\n$EndElements\n";

class Import : public ::testing::Test {
 protected:
  CommandResult import(const std::vector<std::string>& words) {
    std::vector<std::string> all{"import"};
    all.insert(all.end(), words.begin(), words.end());
    return runAtrapos(all, folder_.path());
  }
  void expectRefused(const std::vector<std::string>& words, const std::string& line) {
    const auto before = snapshot(folder_.path());
    const CommandResult r = import(words);
    EXPECT_EQ(r.exitCode, 2) << r.err;
    EXPECT_EQ(r.out, "");
    ASSERT_EQ(r.errorLines().size(), 1u) << r.err;
    EXPECT_NE(r.err.find(line), std::string::npos) << r.err;
    EXPECT_TRUE(snapshot(folder_.path()) == before);
  }

  TemporaryFolder folder_;
};

TEST_F(Import, FromAnInputFileToAPath) {
  writeFile(folder_ / "bar.inp", kBar);
  const CommandResult r = import({"bar.inp", "--deck"});
  ASSERT_EQ(r.exitCode, 0) << r.err;
  EXPECT_EQ(r.err, "");
  EXPECT_EQ(
      r.out,
      "bar.exo: 8 nodes, 1 HEX8 in block 'bar', 6 node sets, 0 side sets\nbar.yaml: a deck, for atrapos run\n"
      "bar.inp:10: *ELEMENT, TYPE=C3D8: HEX8 has 2 x 2 x 2 points for all strains; Abaqus' C3D8 treats that "
      "of the "
      "volume apart\nbar.inp:28: *ELPRINT: left out\n");
  const CommandResult run = runAtrapos({"run", "-q", "bar.yaml"}, folder_.path());
  ASSERT_EQ(run.exitCode, 0) << run.err;
  // S = E e with the Green strain e = (g^2 - 1)/2, and the force per undeformed area is g S = 100.
  std::istringstream rows(readFile(folder_ / "bar_results" / "path.csv"));
  std::string line, last, head;
  std::getline(rows, head);
  while (std::getline(rows, line)) last = line;
  EXPECT_EQ(head.rfind("step,path_length,load_factor,tip_ux", 0), 0u) << head;
  std::istringstream cells(last);
  for (int i = 0; i < 4; ++i) std::getline(cells, line, ',');
  const double stretch = 1 + std::stod(line) / 10;
  // path.csv is exact to the residual bound of the path, 1e-6.
  EXPECT_NEAR(210000 * stretch * (stretch * stretch - 1) / 2, 100, 1e-4);
}

TEST_F(Import, WhatIsThereIsNotReplaced) {
  writeFile(folder_ / "bar.inp", kBar);
  ASSERT_EQ(import({"bar.inp", "--deck", "-q"}).exitCode, 0);
  EXPECT_EQ(import({"bar.inp", "-q"}).out, "");  // a mesh of our own is
  expectRefused({"bar.inp", "--deck"}, "bar.yaml is there already");
  writeFile(folder_ / "notes.exo", "notes");
  expectRefused({"bar.inp", "-o", "notes.exo"}, "was not made by atrapos");
  expectRefused({"bar.inp", "-o", "bar.inp"}, "is read too");
  expectRefused({"bar.inp", "--deck", "-o", "new.yaml"}, "is the deck's name");
  EXPECT_EQ(import({"bar.inp", "--deck", "-o", "other.exo"}).exitCode, 0);
  EXPECT_NE(readFile(folder_ / "other.yaml").find("mesh: {file: 'other.exo'}"), std::string::npos);
}

TEST_F(Import, WordsThatDoNotFit) {
  writeFile(folder_ / "bar.inp", edited(kBar, "210000., 0.", "210000., 0.7"));
  writeFile(folder_ / "cell.msh", kCell);
  writeFile(folder_ / "mesh.obj", "solid");
  expectRefused({"mesh.obj"}, "expected .inp (Abaqus, CalculiX), .msh (Gmsh), or .exo");
  expectRefused({"none.inp"}, "none.inp: does not exist");
  expectRefused({"bar.inp", "--deck"}, "poissons_ratio");
  expectRefused({"bar.inp", "--shells"}, "--shells");
  expectRefused({"cell.msh", "--deck"}, "--deck: a mesh has no materials");
  expectRefused({"cell.msh", "--along", "x"}, "--along and --cells are for surfaces of tools");
  expectRefused({"part.vtu"}, "others, as .vtu and .vtk, by python3 -m atrapos.from_meshio");
}

#ifdef ATRAPOS_GMSH
/// A box of 100 x 50 x 300, walls of 6 x 18 quadrilaterals with eight nodes; groups "walls", "foot", "head".
void drawBoxColumn(const std::string& file) {
  gmsh::initialize(0, nullptr, false);
  gmsh::option::setNumber("General.Terminal", 0);
  gmsh::option::setNumber("Mesh.SecondOrderIncomplete", 1);
  namespace geo = gmsh::model::geo;
  const double x[4] = {0, 100, 100, 0}, y[4] = {0, 0, 50, 50};
  int low[4], high[4], foot[4], head[4], up[4];
  for (int i = 0; i < 4; ++i) {
    low[i] = geo::addPoint(x[i], y[i], 0);
    high[i] = geo::addPoint(x[i], y[i], 300);
  }
  for (int i = 0; i < 4; ++i) {
    foot[i] = geo::addLine(low[i], low[(i + 1) % 4]);
    head[i] = geo::addLine(high[i], high[(i + 1) % 4]);
    up[i] = geo::addLine(low[i], high[i]);
    for (const int line : {foot[i], head[i]}) geo::mesh::setTransfiniteCurve(line, 7);
    geo::mesh::setTransfiniteCurve(up[i], 19);
  }
  std::vector<int> walls;
  for (int i = 0; i < 4; ++i) {
    walls.push_back(geo::addPlaneSurface({geo::addCurveLoop({foot[i], up[(i + 1) % 4], -head[i], -up[i]})}));
    geo::mesh::setTransfiniteSurface(walls.back());
    geo::mesh::setRecombine(2, walls.back());
  }
  geo::synchronize();
  const auto group = [](int dimension, const std::vector<int>& entities, const char* name) {
    gmsh::model::setPhysicalName(dimension, gmsh::model::addPhysicalGroup(dimension, entities), name);
  };
  group(2, walls, "walls");
  group(1, {foot, foot + 4}, "foot");
  group(1, {head, head + 4}, "head");
  gmsh::model::mesh::generate(2);
  gmsh::model::mesh::setOrder(2);
  gmsh::write(file);
  gmsh::finalize();
}

// From a mesh of Gmsh to buckling loads: those of CalculiX with the same mesh
// (test/peers/calculix/columns.csv).
TEST_F(Import, BoxColumnOfGmshBuckles) {
  drawBoxColumn((folder_ / "column.msh").string());
  const CommandResult r = import({"column.msh"});
  ASSERT_EQ(r.exitCode, 0) << r.err;
  EXPECT_EQ(r.out, "column.exo: 1344 nodes, 432 SHELL8 in block 'walls', 2 node sets, 3 side sets\n");
  writeFile(folder_ / "column.yaml", R"(mesh: {file: column.exo}
materials:
  steel: {law: saint_venant_kirchhoff, youngs_modulus: 210000, poissons_ratio: 0, blocks: [walls]}
shells:
  sections:
    walls: {blocks: [walls], thickness: 1}
supports:
  foot: {set: foot, condition: hinged}
  head: {set: head, x: 0, y: 0, z: {per_load_factor: -1}}
path:
  stop: {load_factor: 0.143}
output:
  monitors:
    force: {type: reaction, support: head, component: z}
)");
  const CommandResult run = runAtrapos({"run", "-q", "column.yaml"}, folder_.path());
  ASSERT_EQ(run.exitCode, 0) << run.err;
  std::istringstream rows(readFile(folder_ / "column_results" / "points.csv"));
  std::string line;
  std::getline(rows, line);
  const auto force = std::count(line.begin(), line.begin() + static_cast<long>(line.find(",force")) + 1, ',');
  // 0.4 % apart at most: CalculiX has rigid bodies where walls meet (test/peers/README.md).
  for (const double expected : {26953., 27696., 29966.}) {
    ASSERT_TRUE(std::getline(rows, line));
    std::istringstream cells(line);
    std::string cell;
    for (long i = 0; i <= force; ++i) std::getline(cells, cell, ',');
    EXPECT_NEAR(-std::stod(cell) / expected, 1, 0.008);
  }
}
#endif

// Nodes that no element has, and ids from 0.
// A die of four squares of facets becomes a surface that a deck's tool takes.
TEST_F(Import, FromStlToATool) {
  std::string facets = "solid die\n";
  const auto facet = [&](double x0, double y0, double x1, double y1, double x2, double y2) {
    facets += "facet normal 0 0 1\nouter loop\n";
    for (const auto& [x, y] : {std::pair{x0, y0}, {x1, y1}, {x2, y2}})
      facets += "vertex " + std::to_string(x) + " " + std::to_string(y) + " " +
                std::to_string(-1 - 0.05 * x * x) + "\n";
    facets += "endloop\nendfacet\n";
  };
  for (int i = -2; i < 2; ++i)
    for (int j = -2; j < 2; ++j) {
      facet(i, j, i + 1, j, i + 1, j + 1);
      facet(i, j, i + 1, j + 1, i, j + 1);
    }
  writeFile(folder_ / "die.stl", facets + "endsolid die\n");
  const CommandResult r = import({"die.stl", "--cells", "1", "1"});
  ASSERT_EQ(r.exitCode, 0) << r.err;
  EXPECT_NE(r.out.find("die.yaml: a surface of 1 x 1 cells for a tool"), std::string::npos) << r.out;
  expectRefused({"die.stl"}, "die.yaml is there already");
  expectRefused({"die.stl", "-o", "other.yaml", "--along", "up"},
                "--along up: expected x, y, z, -x, -y or -z");
  writeFile(folder_ / "press.yaml",
            "mesh:\n  file: block.exo\n  generate: {shape: box, lengths: [2, 2, 1], origin: [-1, -1, 0], "
            "divisions: [2, 2, 1], "
            "cell: HEX20}\nmaterials:\n  m: {law: saint_venant_kirchhoff, youngs_modulus: 1, poissons_ratio: "
            "0, blocks: [body]}\n"
            "supports:\n  top: {set: z_max, x: 0, y: 0, z: {per_load_factor: -1}}\ntools:\n  die: {type: "
            "patches, file: die.yaml}\n"
            "contact:\n  below: {tool: die, set: z_min}\npath:\n  stop: {load_factor: 1}\n");
  ASSERT_EQ(runAtrapos({"mesh", "press.yaml"}, folder_.path()).exitCode, 0);
  const CommandResult check = runAtrapos({"check", "press.yaml"}, folder_.path());
  ASSERT_EQ(check.exitCode, 0) << check.err;
  // A parabola is a spline: above its top the gap is 1.
  EXPECT_NE(check.out.find("below: "), std::string::npos) << check.out;
  EXPECT_NE(check.out.find("smallest gap 1.0"), std::string::npos) << check.out;
}

TEST_F(Import, FromExodus) {
  fem::Mesh mesh;
  mesh.coordinates = {5, 5, 5, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  mesh.blocks.push_back({"", 0, fem::Topology::Tet4, {1, 2, 3, 4}, {}, {}});
  mesh.nodeSets.push_back({"far", 0, {0}});
  mesh.nodeSets.push_back({"some", 1, {0, 2}, {.25, .75}});
  exodus::writeMesh(mesh, (folder_ / "other.e").string());
  const CommandResult r = import({"other.e", "-o", "mesh.exo"});
  ASSERT_EQ(r.exitCode, 0) << r.err;
  EXPECT_EQ(r.out,
            "mesh.exo: 4 nodes, 1 TET4 in block '', 1 node set, 0 side sets\nother.e: 1 node left out that "
            "no element has\n");
  const fem::Mesh back = exodus::readMesh((folder_ / "mesh.exo").string());
  EXPECT_EQ(back.nodeIds, (std::vector<long long>{2, 3, 4, 5}));
  ASSERT_EQ(back.nodeSets.size(), 1u);
  EXPECT_EQ(back.nodeSets[0].nodes, std::vector<int>{1});
  EXPECT_EQ(back.nodeSets[0].factors, std::vector<double>{.75});
  expectRefused({"other.e", "-o", "other.e"}, "is read too");
}

#ifdef ATRAPOS_GMSH
TEST_F(Import, FromGmsh) {
  writeFile(folder_ / "cell.msh", kCell);
  const CommandResult r = import({"cell.msh", "-o", "mesh.exo"});
  ASSERT_EQ(r.exitCode, 0) << r.err;
  EXPECT_EQ(r.out, "mesh.exo: 8 nodes, 1 HEX8 in block 'the body', 1 node set, 1 side set\n");
  EXPECT_EQ(exodus::readMesh((folder_ / "mesh.exo").string()).sideSets.at(0).name, "foot");
}

TEST_F(Import, DamagedMeshesOfGmsh) {
  const std::vector<std::pair<std::string, std::string>> changes{
      {"$Nodes\n8", "$Nodes\n99999999999"}, {"1 2 3 4 5 6 7 8\n", "1 2 3 4 5 6 7 9\n"},
      {"2 5 2 2 1", "2 999 2 2 1"},         {"8 0 1 1", "8 0 x 1"},
      {"$Elements\n2", "$Elements\n-1"},    {"2.2 0 8", "2.2 1 8"}};
  for (const auto& [from, to] : changes) {
    SCOPED_TRACE(to);
    writeFile(folder_ / "cell.msh", edited(kCell, from, to));
    expectRefused({"cell.msh"}, "cell.msh: ");
  }
  writeFile(folder_ / "cell.msh", "SystemCall \"touch ran\";\n");
  expectRefused({"cell.msh"}, "is no mesh of Gmsh");
}
#endif

}  // namespace
}  // namespace atrapos::test
