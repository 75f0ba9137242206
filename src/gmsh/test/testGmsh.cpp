// Meshes that libgmsh makes and writes, in all formats that are read: cells of order 1 and 2 have the volume
// of their body, groups are where they were drawn, and scripts are not run.
#include <gmsh.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>

#include "atrapos/fem/PointSet.hpp"
#include "atrapos/fem/ReferenceCell.hpp"
#include "gmsh/ReadGmsh.hpp"

namespace atrapos::importer {
namespace {

class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "atrapos-gmsh-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no folder for a test");
    path_ = name;
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

struct Kind {
  std::string name;
  double version;
  int order;
  bool binary, recombined, incomplete;
  fem::Topology cell;
};

/// A block of 2 x 1 x 3 (or its base) of transfinite cells; groups "body", "foot" (z = 0 or y = 0), "edge"
/// and "corner".
void draw(const Kind& kind, int dimension, const std::string& file) {
  gmsh::initialize(0, nullptr, false);
  gmsh::option::setNumber("General.Terminal", 0);
  gmsh::option::setNumber("Mesh.MshFileVersion", kind.version);
  gmsh::option::setNumber("Mesh.Binary", kind.binary ? 1 : 0);
  gmsh::option::setNumber("Mesh.SecondOrderIncomplete", kind.incomplete ? 1 : 0);
  namespace geo = gmsh::model::geo;
  const int p[4] = {geo::addPoint(0, 0, 0), geo::addPoint(2, 0, 0), geo::addPoint(2, 1, 0),
                    geo::addPoint(0, 1, 0)};
  int l[4];
  for (int i = 0; i < 4; ++i) l[i] = geo::addLine(p[i], p[(i + 1) % 4]);
  for (const int line : l) geo::mesh::setTransfiniteCurve(line, 3);
  const int face = geo::addPlaneSurface({geo::addCurveLoop({l[0], l[1], l[2], l[3]})});
  geo::mesh::setTransfiniteSurface(face);
  if (kind.recombined) geo::mesh::setRecombine(2, face);
  gmsh::vectorpair made;
  if (dimension == 3) geo::extrude({{2, face}}, 0, 0, 3, made, {2}, {}, kind.recombined);
  geo::synchronize();
  const auto group = [](int d, int entity, const char* name) {
    gmsh::model::setPhysicalName(d, gmsh::model::addPhysicalGroup(d, {entity}), name);
  };
  group(dimension, dimension == 3 ? made[1].second : face, "the body");
  group(dimension - 1, dimension == 3 ? face : l[0], "foot");
  if (dimension == 3) group(1, l[0], "edge");
  group(0, p[0], "corner");
  gmsh::model::mesh::generate(dimension);
  gmsh::model::mesh::setOrder(kind.order);
  gmsh::write(file);
  gmsh::finalize();
}

double volume(const fem::Mesh& mesh) {
  double sum = 0;
  for (const fem::Block& block : mesh.blocks) {
    const auto points = fem::volumePoints(mesh, block, fem::tabulate(block.topology));
    for (const double w : points.weights) sum += w;
  }
  return sum;
}

class Solids : public ::testing::TestWithParam<Kind> {};

TEST_P(Solids, GroupsAndVolume) {
  const Folder folder;
  const std::string file = folder / "block.msh";
  draw(GetParam(), 3, file);
  const Model model = readGmsh(file, Surfaces::plane);
  EXPECT_TRUE(model.remarks.empty()) << model.remarks.front();
  const fem::Mesh& mesh = model.mesh;
  ASSERT_EQ(mesh.blocks.size(), 1u);
  EXPECT_EQ(mesh.dimension, 3);
  EXPECT_EQ(mesh.blocks[0].name, "the body");
  ASSERT_EQ(mesh.blocks[0].topology, GetParam().cell);
  EXPECT_NEAR(volume(mesh), 6, 1e-12);  // each point's weight is positive: nodes are in order
  ASSERT_EQ(mesh.sideSets.size(), 1u);
  EXPECT_EQ(mesh.sideSets[0].name, "foot");
  const auto perElement = static_cast<std::size_t>(fem::nodesPerElement(GetParam().cell));
  for (const fem::Side& side : mesh.sideSets[0].sides)
    for (const int local : fem::sideNodes(GetParam().cell, side.side)) {
      const int node =
          mesh.blocks[0]
              .nodes[static_cast<std::size_t>(side.element) * perElement + static_cast<std::size_t>(local)];
      EXPECT_EQ(mesh.coordinates[3 * static_cast<std::size_t>(node) + 2], 0);
    }
  std::vector<std::string> names;
  for (const fem::NodeSet& set : mesh.nodeSets) names.push_back(set.name);
  EXPECT_EQ(names, (std::vector<std::string>{"corner", "edge", "foot"}));
  EXPECT_EQ(mesh.nodeSets[0].nodes.size(), 1u);
  EXPECT_EQ(mesh.nodeSets[1].nodes.size(), GetParam().order == 1 ? 3u : 5u);
}

INSTANTIATE_TEST_SUITE_P(Gmsh, Solids,
                         ::testing::Values(Kind{"Hex8", 4.1, 1, false, true, false, fem::Topology::Hex8},
                                           Kind{"Hex20", 4.1, 2, false, true, true, fem::Topology::Hex20},
                                           Kind{"Hex20of22", 2.2, 2, false, true, true, fem::Topology::Hex20},
                                           Kind{"Hex27", 4.1, 2, true, true, false, fem::Topology::Hex27},
                                           Kind{"Tet4", 2.2, 1, true, false, false, fem::Topology::Tet4},
                                           Kind{"Tet10", 4.1, 2, false, false, false, fem::Topology::Tet10}),
                         [](const auto& info) { return info.param.name; });

TEST(Gmsh, SurfacesArePlaneBodiesOrShells) {
  const Folder folder;
  const std::string file = folder / "plate.msh";
  draw({"Quad8", 2.2, 2, false, true, true, fem::Topology::Quad8}, 2, file);
  const fem::Mesh plane = readGmsh(file, Surfaces::plane).mesh, shell = readGmsh(file, Surfaces::shells).mesh;
  EXPECT_EQ(plane.dimension, 2);
  EXPECT_EQ(plane.blocks.at(0).topology, fem::Topology::Quad8);
  EXPECT_EQ(shell.dimension, 3);
  EXPECT_EQ(shell.blocks.at(0).topology, fem::Topology::Shell8);
  ASSERT_EQ(plane.sideSets.size(), 1u);
  EXPECT_EQ(plane.sideSets[0].sides.size(), 2u);
  ASSERT_EQ(shell.sideSets.size(), 2u);
  EXPECT_EQ(shell.sideSets[1].name, shell.blocks[0].name);
  EXPECT_EQ(shell.sideSets[1].sides.size(), shell.blocks[0].nodes.size() / 8);
  for (const fem::Side& side : shell.sideSets[1].sides) EXPECT_EQ(side.side, 0);
  for (std::size_t i = 0; i < 2; ++i)  // two faces come before the edges of shells
    EXPECT_EQ(shell.sideSets[0].sides[i].side, plane.sideSets[0].sides[i].side + 2);
  double area = 0;  // of the corners' quadrilaterals, by their diagonals
  const auto x = [&](std::size_t cell, std::size_t corner, std::size_t d) {
    return plane.coordinates[3 * static_cast<std::size_t>(plane.blocks[0].nodes[8 * cell + corner]) + d];
  };
  for (std::size_t e = 0; e < plane.blocks[0].nodes.size() / 8; ++e)
    area += ((x(e, 2, 0) - x(e, 0, 0)) * (x(e, 3, 1) - x(e, 1, 1)) -
             (x(e, 2, 1) - x(e, 0, 1)) * (x(e, 3, 0) - x(e, 1, 0))) /
            2;
  EXPECT_NEAR(area, 2, 1e-12);
}

TEST(Gmsh, TrianglesAreShellsOfThreeOrSixNodes) {
  for (const fem::Topology cell : {fem::Topology::Shell3, fem::Topology::Shell6}) {
    const std::size_t N = static_cast<std::size_t>(fem::nodesPerElement(cell));
    const Folder folder;
    const std::string file = folder / "plate.msh";
    draw({"Tri", 4.1, N == 3 ? 1 : 2, false, false, false, cell}, 2, file);
    const fem::Mesh mesh = readGmsh(file, Surfaces::shells).mesh;
    ASSERT_EQ(mesh.blocks.size(), 1u);
    EXPECT_EQ(mesh.blocks[0].topology, cell);
    EXPECT_EQ(mesh.blocks[0].nodes.size(), N * 8);
    ASSERT_EQ(mesh.sideSets.size(), 2u);
    ASSERT_EQ(mesh.sideSets[0].sides.size(), 2u);
    for (const fem::Side& side : mesh.sideSets[0].sides) {
      const auto local = fem::sideNodes(cell, side.side);
      ASSERT_EQ(local.size(), N == 3 ? 2u : 3u);
      for (const int n : local) {  // the foot is y = 0
        const int node =
            mesh.blocks[0].nodes[N * static_cast<std::size_t>(side.element) + static_cast<std::size_t>(n)];
        EXPECT_EQ(mesh.coordinates[3 * static_cast<std::size_t>(node) + 1], 0);
      }
    }
  }
}

TEST(Gmsh, WedgesOfOrderTwo) {
  const Folder folder;
  const std::string file = folder / "wedges.msh";
  // Triangles drawn out with recombined layers: prisms.
  gmsh::initialize(0, nullptr, false);
  gmsh::option::setNumber("General.Terminal", 0);
  gmsh::option::setNumber("Mesh.SecondOrderIncomplete", 1);
  const int face = gmsh::model::occ::addRectangle(0, 0, 0, 2, 1);
  gmsh::vectorpair made;
  gmsh::model::occ::extrude({{2, face}}, 0, 0, 3, made, {2}, {}, true);
  gmsh::model::occ::synchronize();
  gmsh::model::mesh::generate(3);
  gmsh::model::mesh::setOrder(2);
  gmsh::write(file);
  gmsh::finalize();
  const fem::Mesh mesh = readGmsh(file, Surfaces::plane).mesh;
  ASSERT_EQ(mesh.blocks.size(), 1u);
  EXPECT_EQ(mesh.blocks[0].topology, fem::Topology::Wedge15);
  EXPECT_EQ(mesh.blocks[0].name, "body");
  EXPECT_NEAR(volume(mesh), 6, 1e-12);
}

void expectRefused(const std::string& file, const std::string& words) {
  try {
    readGmsh(file, Surfaces::plane);
    ADD_FAILURE() << "not refused";
  } catch (const Error& e) {
    EXPECT_EQ(std::string(e.what()).rfind(file, 0), 0u) << e.what();
    EXPECT_NE(std::string(e.what()).find(words), std::string::npos) << e.what();
  }
}

TEST(Gmsh, ScriptsAreNotRun) {
  const Folder folder;
  const std::string script = "SystemCall \"touch " + (folder / "ran") + "\";\n";
  std::ofstream(folder / "script.msh") << script;
  expectRefused(folder / "script.msh", "is no mesh of Gmsh");
  // Options beside a mesh are scripts too.
  draw({"Hex8", 4.1, 1, false, true, false, fem::Topology::Hex8}, 3, folder / "block.msh");
  std::ofstream(folder / "block.msh.opt") << script;
  EXPECT_EQ(readGmsh(folder / "block.msh", Surfaces::plane).mesh.numElements(), 8);
  std::ofstream(folder / "old.msh") << "$MeshFormat\n1 0 8\n$EndMeshFormat\n";
  expectRefused(folder / "old.msh", "format '1'; expected 2.2 or 4.1");
  expectRefused(folder / "none.msh", "cannot be read");
  EXPECT_FALSE(std::filesystem::exists(folder / "ran"));
}

}  // namespace
}  // namespace atrapos::importer
