// Meshes to files and back, and files that hold something else than a mesh for us.
#include <exodusII.h>
#include <gtest/gtest.h>

#include <array>
#include <fstream>

#include "SampleMesh.hpp"
#include "TempFile.hpp"
#include "atrapos/exodus/MeshFile.hpp"
#include "atrapos/fem/ReferenceCell.hpp"
#include "atrapos/fem/ShellThickness.hpp"
#include "atrapos/fem/StructuredShell.hpp"

using namespace atrapos;
using fem::Mesh;
using fem::Topology;

namespace {

const std::vector<Topology> topologies = {Topology::Hex8,  Topology::Hex20,  Topology::Hex27,  Topology::Tet4,
                                          Topology::Tet10, Topology::Wedge6, Topology::Wedge15};

template <class F>
std::string messageOf(const F& f) {
  try {
    f();
  } catch (const exodus::Error& e) {
    return e.what();
  }
  return "no error";
}

void expectMessage(const std::string& message, const std::string& part) {
  EXPECT_NE(message.find(part), std::string::npos) << message;
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
}

// A file of one element with the library itself; the mesh is as wrong as the arguments make it.
struct Raw {
  std::string type = "HEX8";
  int nodesPerElement = 8;
  int dimensions = 3;
  std::vector<int> nodes = {1, 2, 3, 4, 5, 6, 7, 8};
  std::array<int, 2> side = {1, 6};
  int setNode = 8;
  bool emptyBlock = false;
  int numNodes = 8;
  int mode = EX_LARGE_MODEL;

  void write(const std::string& file) const {
    ex_opts(0);
    int words = 8, fileWords = 8;
    const int id = ex_create(file.c_str(), EX_CLOBBER | mode, &words, &fileWords);
    ASSERT_GE(id, 0);
    if (numNodes == 0) {  // the library takes no elements without nodes
      ASSERT_EQ(ex_put_init(id, "raw", dimensions, 0, 0, 0, 0, 0), 0);
      ASSERT_EQ(ex_close(id), 0);
      return;
    }
    ASSERT_EQ(ex_put_init(id, "raw", dimensions, numNodes, 1, emptyBlock ? 2 : 1, 1, 1), 0);
    const double x[27] = {0, 1, 1, 0, 0, 1, 1, 0}, y[27] = {0, 0, 1, 1, 0, 0, 1, 1},
                 z[27] = {0, 0, 0, 0, 1, 1, 1, 1};
    ASSERT_EQ(ex_put_coord(id, x, y, dimensions == 3 ? z : nullptr), 0);
    if (emptyBlock) {
      ASSERT_EQ(ex_put_block(id, EX_ELEM_BLOCK, 5, "SHELL4", 0, 4, 0, 0, 0), 0);
    }
    ASSERT_EQ(ex_put_block(id, EX_ELEM_BLOCK, 10, type.c_str(), 1, nodesPerElement, 0, 0, 0), 0);
    ASSERT_EQ(ex_put_conn(id, EX_ELEM_BLOCK, 10, nodes.data(), nullptr, nullptr), 0);
    ASSERT_EQ(ex_put_set_param(id, EX_NODE_SET, 20, 1, 0), 0);
    ASSERT_EQ(ex_put_set(id, EX_NODE_SET, 20, &setNode, nullptr), 0);
    ASSERT_EQ(ex_put_set_param(id, EX_SIDE_SET, 30, 1, 0), 0);
    ASSERT_EQ(ex_put_set(id, EX_SIDE_SET, 30, &side[0], &side[1]), 0);
    ASSERT_EQ(ex_close(id), 0);
  }
};

}  // namespace

TEST(ExodusMesh, roundTripOfEveryTopology) {
  for (Topology topology : topologies) {
    SCOPED_TRACE(fem::topologyName(topology));
    const TempFile file;
    const Mesh mesh = sampleMesh(topology);
    exodus::writeMesh(mesh, file());
    expectEqual(mesh, exodus::readMesh(file()));
    exodus::writeMesh(exodus::readMesh(file()), file());  // over itself
    expectEqual(mesh, exodus::readMesh(file()));
  }
}

TEST(ExodusMesh, trivialIdsStayEmpty) {
  const TempFile file;
  const Mesh mesh = fem::boxMesh({});
  exodus::writeMesh(mesh, file());
  expectEqual(mesh, exodus::readMesh(file()));
}

TEST(ExodusMesh, fileHasOneBasedNumbersAndLargeModel) {
  const TempFile file;
  exodus::writeMesh(fem::boxMesh({}), file());
  int words = 8, fileWords = 0;
  float version = 0.0F;
  const int id = ex_open(file().c_str(), EX_READ, &words, &fileWords, &version);
  ASSERT_GE(id, 0);
  EXPECT_EQ(fileWords, 8);
  EXPECT_EQ(ex_large_model(id), 1);
  std::array<int, 8> nodes{};
  ASSERT_EQ(ex_get_conn(id, EX_ELEM_BLOCK, 1, nodes.data(), nullptr, nullptr), 0);
  // One cell, lattice directions equally divided: x outermost, z innermost.
  EXPECT_EQ(nodes, (std::array<int, 8>{1, 5, 7, 3, 2, 6, 8, 4}));
  int element = 0, side = 0;
  ASSERT_EQ(ex_get_set(id, EX_SIDE_SET, 6, &element, &side), 0);
  EXPECT_EQ(element, 1);
  EXPECT_EQ(side, 6);  // z_max: the last side, by Exodus' count from 1
  char type[MAX_STR_LENGTH + 1] = "";
  int count = 0, perElement = 0, edges = 0, faces = 0, attributes = 0;
  ASSERT_EQ(ex_get_block(id, EX_ELEM_BLOCK, 1, type, &count, &perElement, &edges, &faces, &attributes), 0);
  EXPECT_STREQ(type, "HEX8");
  ex_close(id);
}

TEST(ExodusMesh, elementTypesByPrefixAndNodeCount) {
  const TempFile file;
  const std::vector<std::pair<std::string, Topology>> types = {
      {"HEX", Topology::Hex8},        {"hex8", Topology::Hex8},     {"HEXAHEDRON", Topology::Hex20},
      {"HEX27", Topology::Hex27},     {"TETRA", Topology::Tet4},    {"TETRA10", Topology::Tet10},
      {"tetra", Topology::Tet10},     {"WEDGE", Topology::Wedge15}, {"PENTA6", Topology::Wedge6},
      {"PENTA15", Topology::Wedge15}, {"SHELL", Topology::Shell8},  {"shell8", Topology::Shell8},
      {"QUAD8", Topology::Shell8},    {"QUAD", Topology::Shell8},   {"SHELL9", Topology::Shell9},
      {"Quad", Topology::Shell9},     {"SHELL4", Topology::Shell4}, {"QUAD", Topology::Shell4},
      {"TRI3", Topology::Shell3},     {"shell", Topology::Shell3},  {"TRISHELL3", Topology::Shell3},
      {"TRI6", Topology::Shell6},     {"SHELL6", Topology::Shell6}, {"TRISHELL6", Topology::Shell6}};
  for (const auto& [type, topology] : types) {
    SCOPED_TRACE(type);
    Raw raw;
    raw.type = type;
    raw.nodesPerElement = raw.numNodes = fem::nodesPerElement(topology);
    raw.nodes.clear();
    for (int i = 1; i <= raw.numNodes; ++i) raw.nodes.push_back(i);
    raw.setNode = 1;
    raw.side[1] = 4;
    raw.write(file());
    const Mesh mesh = exodus::readMesh(file());
    EXPECT_EQ(mesh.blocks[0].topology, topology);
    EXPECT_EQ(mesh.sideSets[0].sides[0].side, std::toupper(type[0]) == 'Q' ? 5 : 3);
  }
}

TEST(ExodusMesh, planeMeshesHaveTwoDimensions) {
  const TempFile file, again;
  const std::vector<std::pair<std::string, Topology>> types = {{"QUAD", Topology::Quad4},
                                                               {"quad8", Topology::Quad8},
                                                               {"QUAD9", Topology::Quad9},
                                                               {"TRI3", Topology::Tri3},
                                                               {"TRIANGLE", Topology::Tri6}};
  for (const auto& [type, topology] : types) {
    SCOPED_TRACE(type);
    Raw raw;
    raw.dimensions = 2;
    raw.type = type;
    raw.nodesPerElement = raw.numNodes = fem::nodesPerElement(topology);
    raw.nodes.clear();
    for (int i = 1; i <= raw.numNodes; ++i) raw.nodes.push_back(i);
    raw.setNode = 1;
    raw.side = {1, 3};
    raw.write(file());
    const Mesh mesh = exodus::readMesh(file());
    EXPECT_EQ(mesh.dimension, 2);
    EXPECT_EQ(mesh.blocks[0].topology, topology);
    EXPECT_EQ(mesh.sideSets[0].sides[0].side, 2);  // the edges are the sides
    for (int n = 0; n < mesh.numNodes(); ++n) EXPECT_EQ(mesh.coordinates[3 * n + 2], 0.0);
    exodus::writeMesh(mesh, again());
    const Mesh back = exodus::readMesh(again());
    EXPECT_EQ(back.dimension, 2);
    EXPECT_EQ(back.coordinates, mesh.coordinates);
    EXPECT_EQ(back.blocks[0].nodes, mesh.blocks[0].nodes);
  }
  Mesh mixed = exodus::readMesh(again());
  mixed.dimension = 3;
  EXPECT_THROW(exodus::writeMesh(mixed, again()), exodus::Error);
}

TEST(ExodusMesh, otherFileFormatsAreRead) {
  for (int mode : {EX_NORMAL_MODEL, EX_LARGE_MODEL, EX_NETCDF4, EX_NETCDF4 | EX_ALL_INT64_DB}) {
    SCOPED_TRACE(mode);
    const TempFile file;
    Raw raw;
    raw.mode = mode;
    raw.emptyBlock = true;
    raw.write(file());
    const Mesh mesh = exodus::readMesh(file());
    ASSERT_EQ(mesh.blocks.size(), 1u);  // the one without elements is left out, whatever its type
    EXPECT_EQ(mesh.blocks[0].id, 10);
    EXPECT_EQ(mesh.blocks[0].nodes, (std::vector<int>{0, 1, 2, 3, 4, 5, 6, 7}));
    EXPECT_EQ(mesh.nodeSets[0].nodes, std::vector<int>{7});
  }
}

// As meshio writes them.
TEST(ExodusMesh, idsFromZero) {
  const TempFile file;
  Mesh mesh = sampleMesh(Topology::Hex8);
  for (std::size_t i = 0; i < mesh.blocks.size(); ++i) mesh.blocks[i].id = static_cast<long long>(i);
  for (std::size_t i = 0; i < mesh.nodeSets.size(); ++i) mesh.nodeSets[i].id = static_cast<long long>(i);
  for (std::size_t i = 0; i < mesh.sideSets.size(); ++i) mesh.sideSets[i].id = static_cast<long long>(i);
  exodus::writeMesh(mesh, file());
  expectEqual(exodus::readMesh(file()), mesh);
  EXPECT_EQ(fem::findBlock(mesh, "0"), 0);
}

// Lines before the cells and points behind them, as meshio writes what Gmsh had.
TEST(ExodusMesh, linesAndPointsBecomeNodeSets) {
  const TempFile file;
  ex_opts(0);
  int words = 8, fileWords = 8;
  const int id = ex_create(file().c_str(), EX_CLOBBER | EX_LARGE_MODEL, &words, &fileWords);
  ASSERT_GE(id, 0);
  ASSERT_EQ(ex_put_init(id, "lines", 3, 8, 4, 3, 1, 1), 0);
  const double x[8] = {0, 1, 1, 0, 0, 1, 1, 0}, y[8] = {0, 0, 1, 1, 0, 0, 1, 1},
               z[8] = {0, 0, 0, 0, 1, 1, 1, 1};
  ASSERT_EQ(ex_put_coord(id, x, y, z), 0);
  const int lines[4] = {1, 2, 2, 3}, cell[8] = {1, 2, 3, 4, 5, 6, 7, 8}, point = 5, elements[3] = {1, 3, 3},
            sides[3] = {1, 6, 2};
  ASSERT_EQ(ex_put_block(id, EX_ELEM_BLOCK, 3, "BAR2", 2, 2, 0, 0, 0), 0);
  ASSERT_EQ(ex_put_block(id, EX_ELEM_BLOCK, 5, "HEX8", 1, 8, 0, 0, 0), 0);
  ASSERT_EQ(ex_put_block(id, EX_ELEM_BLOCK, 7, "SPHERE", 1, 1, 0, 0, 0), 0);
  ASSERT_EQ(ex_put_conn(id, EX_ELEM_BLOCK, 3, lines, nullptr, nullptr), 0);
  ASSERT_EQ(ex_put_conn(id, EX_ELEM_BLOCK, 5, cell, nullptr, nullptr), 0);
  ASSERT_EQ(ex_put_conn(id, EX_ELEM_BLOCK, 7, &point, nullptr, nullptr), 0);
  ASSERT_EQ(ex_put_name(id, EX_ELEM_BLOCK, 3, "edge"), 0);
  ASSERT_EQ(ex_put_set_param(id, EX_NODE_SET, 1, 1, 0), 0);
  ASSERT_EQ(ex_put_set(id, EX_NODE_SET, 1, &point, nullptr), 0);
  ASSERT_EQ(ex_put_set_param(id, EX_SIDE_SET, 30, 3, 0), 0);
  ASSERT_EQ(ex_put_set(id, EX_SIDE_SET, 30, elements, sides), 0);
  ASSERT_EQ(ex_close(id), 0);

  expectMessage(messageOf([&] { exodus::readMesh(file()); }),
                "block '' (id 7): element type 'SPHERE' with 1 nodes");
  const exodus::ForeignMesh read = exodus::readForeignMesh(file());
  ASSERT_EQ(read.mesh.blocks.size(), 1u);
  EXPECT_EQ(read.mesh.blocks[0].id, 5);
  EXPECT_EQ(read.mesh.elementIds, std::vector<long long>{3});
  ASSERT_EQ(read.mesh.nodeSets.size(), 3u);
  EXPECT_EQ(read.mesh.nodeSets[1].name, "edge");
  EXPECT_EQ(read.mesh.nodeSets[1].id, 2);
  EXPECT_EQ(read.mesh.nodeSets[1].nodes, (std::vector<int>{0, 1, 2}));
  EXPECT_EQ(read.mesh.nodeSets[2].name, "block_7");
  EXPECT_EQ(read.mesh.nodeSets[2].nodes, std::vector<int>{4});
  ASSERT_EQ(read.mesh.sideSets.at(0).sides.size(), 2u);  // of three one is a line's
  EXPECT_EQ(read.mesh.sideSets[0].sides[0].element, 0);
  EXPECT_EQ(read.mesh.sideSets[0].sides[0].side, 5);
  EXPECT_EQ(read.remarks.size(), 3u);
}

TEST(ExodusMesh, whatIsNotSupportedIsNamed) {
  const TempFile file;
  const auto read = [&] { return messageOf([&] { exodus::readMesh(file()); }); };
  expectMessage(read(), file() + ": no such file");
  expectMessage(messageOf([&] { exodus::readMesh(file.directory().string()); }), "not a regular file");

  Raw raw;
  for (const char* type : {"SHELL7", "TRISHELL7", "TRI7"}) {
    raw.type = type;
    raw.nodesPerElement = 7;
    raw.write(file());
    expectMessage(read(), "block '' (id 10): element type '" + std::string(type) +
                              "' with 7 nodes is not supported; accepted are HEX");
  }
  raw = {};
  raw.type = "SHELL8";
  raw.side = {1, 7};
  raw.write(file());
  expectMessage(read(), "side set '' (id 30) has side 7");
  raw.type = "QUAD8";
  raw.side = {1, 5};
  raw.write(file());
  expectMessage(read(), "side set '' (id 30) has side 5 of element 1, which has 4 sides");

  raw = {};
  raw.dimensions = 2;
  raw.type = "HEX8";
  raw.write(file());
  expectMessage(read(),
                "block '' (id 10): element type 'HEX8' in a mesh of 2 dimensions; accepted are QUAD with "
                "4, 8 or 9 nodes, TRI with 3 or 6");

  raw = {};
  raw.numNodes = 0;
  raw.write(file());
  expectMessage(read(), "the mesh has no nodes");

  raw = {};
  raw.nodes[3] = 9;
  raw.write(file());
  expectMessage(read(), "block '' (id 10) has node 9, the mesh has 8");

  raw = {};
  raw.setNode = 0;
  raw.write(file());
  expectMessage(read(), "node set '' (id 20) has node 0, the mesh has 8");

  raw = {};
  raw.side = {2, 1};
  raw.write(file());
  expectMessage(read(), "side set '' (id 30) has element 2, the mesh has 1");

  raw = {};
  raw.type = "TETRA";
  raw.nodesPerElement = 4;
  raw.side = {1, 5};
  raw.write(file());
  expectMessage(read(), "side set '' (id 30) has side 5 of element 1, which has 4 sides");
}

TEST(ExodusMesh, writesWholeOrNotAtAll) {
  const TempFile file;
  const Mesh good = fem::boxMesh({});
  exodus::writeMesh(good, file());
  const auto write = [&](const Mesh& mesh) { return messageOf([&] { exodus::writeMesh(mesh, file()); }); };

  Mesh bad = good;
  bad.sideSets[1].id = bad.sideSets[0].id;
  expectMessage(write(bad), "side set 'x_max' (id 1) has the id of another side set");
  bad = good;
  bad.blocks[0].id = -1;
  expectMessage(write(bad), "block 'body' (id -1) has an id that is not within 0 and 2147483647");
  bad = good;
  bad.nodeIds.assign(8, 5000000000LL);
  expectMessage(write(bad), "node id 5000000000");
  bad = good;
  bad.blocks[0].nodes[0] = 8;
  expectMessage(write(bad), "has node 9, the mesh has 8");
  bad = good;
  bad.coordinates[5] = 1.0 / 0.0;
  expectMessage(write(bad), "not a finite number");
  bad = good;
  bad.title.assign(81, 'x');
  expectMessage(write(bad), "title");
  bad = good;
  bad.nodeSets[0].name.assign(256, 'x');
  expectMessage(write(bad), "255");
  expectEqual(good, exodus::readMesh(file()));  // still the first one

  expectMessage(messageOf([&] { exodus::writeMesh(good, file("no/such/directory.exo")); }),
                "cannot be created");
  std::filesystem::create_directories(file("directory/inside"));
  expectMessage(messageOf([&] { exodus::writeMesh(good, file("directory")); }),
                "is no regular file, and is not replaced");

  std::size_t entries = 0;
  for (const auto& entry : std::filesystem::directory_iterator(file.directory())) {
    (void)entry;
    ++entries;
  }
  EXPECT_EQ(entries, 2u);  // the file and the directory; no drafts left behind
}

// A plate in two blocks with all that shells carry: thickness, faces and edges in one side set.
TEST(ExodusMesh, roundTripOfShells) {
  for (Topology topology : {Topology::Shell4, Topology::Shell8, Topology::Shell9}) {
    SCOPED_TRACE(fem::topologyName(topology));
    fem::ShellPlateOptions options;
    options.divisions = {3, 2};
    options.thickness = 0.25;
    options.topology = topology;
    Mesh mesh = fem::shellPlateMesh(options);
    const std::size_t N = fem::nodesPerElement(topology);
    fem::Block& first = mesh.blocks[0];
    fem::Block nodal = first;  // thickness node by node
    nodal.name = "nodal";
    nodal.id = 5;
    first.nodes.resize(2 * N);
    first.attributes.resize(2);
    nodal.nodes.erase(nodal.nodes.begin(), nodal.nodes.begin() + static_cast<long>(2 * N));
    nodal.attributeNames.clear();
    nodal.attributes.clear();
    for (std::size_t n = 0; n < N; ++n) nodal.attributeNames.push_back("thickness_" + std::to_string(n + 1));
    for (std::size_t i = 0; i < 4 * N; ++i) nodal.attributes.push_back(0.1 + 0.01 * static_cast<double>(i));
    mesh.blocks.push_back(nodal);
    mesh.sideSets.push_back({"all sides", 77, {}});
    for (int e = 0; e < 6; ++e)
      for (int side = 0; side < 6; ++side) mesh.sideSets.back().sides.push_back({e, side});
    const TempFile file;
    exodus::writeMesh(mesh, file());
    const Mesh back = exodus::readMesh(file());
    expectEqual(mesh, back);
    EXPECT_EQ(fem::shellThickness(back, {0, {}}), std::vector<double>(2 * N, 0.25));
    EXPECT_EQ(fem::shellThickness(back, {1, {}}), nodal.attributes);
  }
}

// What the library itself says are the nodes of a shell's sides, for every name that we read as a shell.
TEST(ExodusMesh, sidesOfShellsAreTheLibrarys) {
  const std::vector<std::pair<std::string, Topology>> types = {
      {"SHELL4", Topology::Shell4},    {"SHELL8", Topology::Shell8},    {"SHELL9", Topology::Shell9},
      {"SHELL", Topology::Shell8},     {"QUAD8", Topology::Shell8},     {"QUAD4", Topology::Shell4},
      {"QUAD9", Topology::Shell9},     {"TRISHELL3", Topology::Shell3}, {"TRI3", Topology::Shell3},
      {"TRISHELL6", Topology::Shell6}, {"TRI6", Topology::Shell6}};
  for (const auto& [type, topology] : types) {
    const bool quad = type[0] == 'Q';  // four edges only
    for (int side = 0; side < (quad ? 4 : fem::shellCorners(topology) == 3 ? 5 : 6); ++side) {
      SCOPED_TRACE(type + " side " + std::to_string(side + 1));
      const TempFile file;
      Raw raw;
      raw.type = type;
      raw.nodesPerElement = raw.numNodes = fem::nodesPerElement(topology);
      raw.nodes.clear();
      for (int i = 1; i <= raw.numNodes; ++i) raw.nodes.push_back(i);
      raw.setNode = 1;
      raw.side = {1, side + 1};
      raw.write(file());
      int words = 8, fileWords = 0;
      float version = 0.0F;
      const int id = ex_open(file().c_str(), EX_READ, &words, &fileWords, &version);
      ASSERT_GE(id, 0);
      int count = 0;
      std::array<int, 9> nodes{};
      ASSERT_EQ(ex_get_side_set_node_list(id, 30, &count, nodes.data()), 0);
      ex_close(id);
      const int ours = exodus::readMesh(file()).sideSets[0].sides[0].side;
      EXPECT_EQ(ours, quad ? side + 2 : side);
      const auto expected = fem::sideNodes(topology, ours);
      // Libraries before 7 know the corners only of the faces of nine nodes.
      const bool old = type == "SHELL9" && count < static_cast<int>(expected.size());
      ASSERT_EQ(count, old ? (side < 2 ? 4 : 2) : static_cast<int>(expected.size()));
      // Of triangles the library has the corners of the bottom from its third one on, in the same sense, and
      // the middles as we have them.
      const int corners = std::min(count, 3), turn = fem::shellCorners(topology) == 3 && side == 1 ? 2 : 0;
      for (int n = 0; n < count; ++n)
        EXPECT_EQ(nodes[n < corners ? (n + turn) % corners : n] - 1, expected[n]);
    }
  }
}

TEST(ExodusMesh, shellBlocksAreWrittenAsShells) {
  fem::ShellPlateOptions options;
  options.thickness = 0.5;
  const TempFile file;
  exodus::writeMesh(fem::shellPlateMesh(options), file());
  int words = 8, fileWords = 0;
  float version = 0.0F;
  const int id = ex_open(file().c_str(), EX_READ, &words, &fileWords, &version);
  ASSERT_GE(id, 0);
  char type[MAX_STR_LENGTH + 1] = "";
  int count = 0, perElement = 0, edges = 0, faces = 0, attributes = 0;
  ASSERT_EQ(ex_get_block(id, EX_ELEM_BLOCK, 1, type, &count, &perElement, &edges, &faces, &attributes), 0);
  EXPECT_STREQ(type, "SHELL8");
  EXPECT_EQ(perElement, 8);
  EXPECT_EQ(attributes, 1);
  int element = 0, side = 0;
  ASSERT_EQ(ex_get_set(id, EX_SIDE_SET, 2, &element, &side), 0);
  EXPECT_EQ(side, 4);  // x_max: the edge from corner 2 to 3
  ASSERT_EQ(ex_get_set(id, EX_SIDE_SET, 6, &element, &side), 0);
  EXPECT_EQ(side, 2);  // bottom
  ex_close(id);
}
