// Normals of shells that do not agree are made to.
#include <gtest/gtest.h>

#include <algorithm>

#include "atrapos/fem/PointSet.hpp"
#include "atrapos/fem/ShellGeometry.hpp"
#include "atrapos/fem/ShellOrientation.hpp"
#include "atrapos/fem/StructuredShell.hpp"
#include "support/Meshes.hpp"
#include "support/Profile.hpp"

using namespace atrapos::fem;
using namespace atrapos::fem::test;

namespace {

constexpr double foldAngle = 20;

Mesh plate(std::array<int, 2> divisions = {3, 2}, Topology cell = Topology::Shell8) {
  ShellPlateOptions o;
  o.divisions = divisions;
  o.topology = cell;
  return shellPlateMesh(o);
}

/// The element's nodes in the order of its other side.
void reverse(Mesh& mesh, int block, int element) {
  const int N = nodesPerElement(mesh.blocks[block].topology);
  int* n = &mesh.blocks[block].nodes[static_cast<std::size_t>(element) * N];
  std::swap(n[1], n[3]);
  if (N > 4) {
    std::swap(n[4], n[7]);
    std::swap(n[5], n[6]);
  }
}

ShellGeometry geometryOf(const Mesh& mesh) {
  std::vector<ShellSection> sections;
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) sections.push_back({static_cast<int>(b), 0.01});
  return shellGeometry(mesh, sections);
}

std::vector<int> allNodes(const Mesh& mesh) {
  std::vector<int> nodes;
  for (const Block& b : mesh.blocks) nodes.insert(nodes.end(), b.nodes.begin(), b.nodes.end());
  return nodes;
}

}  // namespace

TEST(ShellOrientation, MostElementsStay) {
  for (Topology cell : {Topology::Shell4, Topology::Shell8, Topology::Shell9}) {
    const Mesh right = plate({3, 2}, cell);
    Mesh mesh = right;
    auto parts = orientShells(mesh, foldAngle);
    ASSERT_EQ(parts.size(), 1u);
    EXPECT_EQ(parts[0].turned, 0);
    EXPECT_EQ(allNodes(mesh), allNodes(right));
    for (int e : {0, 4}) reverse(mesh, 0, e);
    parts = orientShells(mesh, foldAngle);
    ASSERT_EQ(parts.size(), 1u);
    EXPECT_EQ(parts[0].elements, 6);
    EXPECT_EQ(parts[0].turned, 2);
    EXPECT_EQ(allNodes(mesh), allNodes(right));  // a second reversal gives the first order
  }
  Mesh half = plate({2, 1});
  reverse(half, 0, 0);
  const Mesh before = half;
  EXPECT_EQ(orientShells(half, foldAngle)[0].turned, 1);
  for (int i = 0; i < 8; ++i)
    EXPECT_EQ(half.blocks[0].nodes[i], before.blocks[0].nodes[i]);  // the first stays
}

// What belongs to an element stays where it is in space.
TEST(ShellOrientation, SidesAndThicknessesStayInPlace) {
  Mesh mesh = plate();
  mesh.blocks[0].attributeNames.clear();
  for (int n = 0; n < 8; ++n) mesh.blocks[0].attributeNames.push_back("t" + std::to_string(n));
  for (int n : mesh.blocks[0].nodes)
    mesh.blocks[0].attributes.push_back(0.1 + 0.01 * mesh.coordinates[3 * n] +
                                        0.02 * mesh.coordinates[3 * n + 1]);
  const Mesh right = mesh;
  for (int e : {1, 5}) {
    reverse(mesh, 0, e);
    const std::vector<double> old(&mesh.blocks[0].attributes[8 * e], &mesh.blocks[0].attributes[8 * e] + 8);
    const int order[8] = {0, 3, 2, 1, 7, 6, 5, 4};
    for (int i = 0; i < 8; ++i) mesh.blocks[0].attributes[8 * e + i] = old[order[i]];
    for (SideSet& set : mesh.sideSets)
      for (Side& s : set.sides)
        if (s.element == e) s.side = s.side < 2 ? 1 - s.side : 7 - s.side;
  }
  const auto parts = orientShells(mesh, foldAngle);
  EXPECT_FALSE(parts[0].sidesMixed);
  EXPECT_EQ(mesh.blocks[0].nodes, right.blocks[0].nodes);
  EXPECT_EQ(mesh.blocks[0].attributes, right.blocks[0].attributes);
  for (std::size_t s = 0; s < right.sideSets.size(); ++s)
    for (std::size_t i = 0; i < right.sideSets[s].sides.size(); ++i)
      EXPECT_EQ(mesh.sideSets[s].sides[i].side, right.sideSets[s].sides[i].side) << right.sideSets[s].name;
  // A set that had the tops of elements which do not agree has both sides now.
  Mesh mixed = plate();
  reverse(mixed, 0, 1);
  EXPECT_TRUE(orientShells(mixed, foldAngle)[0].sidesMixed);
}

// A triangle of six nodes that is turned over: its middles and edges go with it.
TEST(ShellOrientation, TrianglesOfSixNodes) {
  const Mesh right = plate({4, 2}, Topology::Shell6);
  Mesh mesh = right;
  int* nodes = &mesh.blocks[0].nodes[6 * 5];
  std::swap(nodes[1], nodes[2]);
  std::swap(nodes[3], nodes[5]);
  mesh.sideSets = {{"sides", 1, {{5, 1}, {5, 4}, {5, 3}, {5, 2}}}};
  const auto parts = orientShells(mesh, foldAngle);
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_EQ(parts[0].turned, 1);
  EXPECT_EQ(allNodes(mesh), allNodes(right));
  const int sides[] = {0, 2, 3, 4};
  for (int s = 0; s < 4; ++s) EXPECT_EQ(mesh.sideSets[0].sides[s].side, sides[s]);
}

// Triangles, alone and with quadrilaterals: their own number of edges.
TEST(ShellOrientation, Triangles) {
  Mesh mesh = plate({4, 2}, Topology::Shell3);
  // The first square becomes one quadrilateral of a block of its own.
  Block quad = mesh.blocks[0];
  quad.name = "quad";
  quad.id = 2;
  quad.topology = Topology::Shell4;
  quad.nodes = {quad.nodes[0], quad.nodes[1], quad.nodes[2], quad.nodes[5]};
  quad.attributes.clear();
  quad.attributeNames.clear();
  mesh.blocks[0].nodes.erase(mesh.blocks[0].nodes.begin(), mesh.blocks[0].nodes.begin() + 6);
  mesh.blocks[0].attributes.clear();
  mesh.blocks[0].attributeNames.clear();
  mesh.blocks.push_back(quad);
  mesh.sideSets = {{"sides", 1, {{3, 0}, {3, 2}, {3, 3}, {3, 4}}}};
  const Mesh right = mesh;
  int* nodes =
      &mesh.blocks[0].nodes[9];  // of element 3: turned over, its edges counted from the first corner
  std::swap(nodes[1], nodes[2]);
  mesh.sideSets[0].sides = {{3, 1}, {3, 4}, {3, 3}, {3, 2}};
  const auto parts = orientShells(mesh, foldAngle);
  ASSERT_EQ(parts.size(), 1u);  // the quadrilateral hangs together with the triangles
  EXPECT_EQ(parts[0].turned, 1);
  EXPECT_EQ(allNodes(mesh), allNodes(right));
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_EQ(mesh.sideSets[0].sides[i].side, right.sideSets[0].sides[i].side);
}

// Folds of any angle go on; at a branch what continues each other; the web is a part of its own.
TEST(ShellOrientation, PartsGoOnAtFoldsAndThroughBranches) {
  Mesh box =
      profileMesh({{{0, 0}, {2, 0}, 2}, {{2, 1}, {2, 0}, 1}, {{2, 1}, {0, 1}, 2}, {{0, 1}, {0, 0}, 1}}, 1, 1);
  auto parts = orientShells(box, foldAngle);
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_EQ(parts[0].turned, 1);
  EXPECT_NO_THROW(geometryOf(box));
  Mesh tee = profileMesh({{{-1, 0}, {0, 0}, 2}, {{1, 0}, {0, 0}, 1}, {{0, 0}, {0, 1}, 2}}, 1, 1);
  parts = orientShells(tee, foldAngle);
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_EQ(parts[0].elements, 3);
  EXPECT_EQ(parts[0].turned, 1);
  EXPECT_EQ(parts[1].block, "wall3");
  EXPECT_EQ(parts[1].turned, 0);
  EXPECT_EQ(geometryOf(tee).directorNodes(nodesAbove(tee, {0, 0})[0]).size(), 2u);
}

TEST(ShellOrientation, OneSidedSurfacesAreRefused) {
  const double pi = 3.14159265358979323846;
  Mesh strip = plate({24, 2});
  for (int n = 0; n < strip.numNodes(); ++n) {
    double* x = &strip.coordinates[3 * n];
    const double angle = 2 * pi * x[0], s = 0.4 * (x[1] - 0.5), r = 1 + s * std::cos(angle / 2);
    x[0] = r * std::cos(angle);
    x[1] = r * std::sin(angle);
    x[2] = s * std::sin(angle / 2);
  }
  Mesh moebius = glued({Mesh{}, strip});
  orientShells(moebius, foldAngle);
  try {
    geometryOf(moebius);
    FAIL();
  } catch (const std::invalid_argument& e) {
    EXPECT_NE(std::string(e.what()).find("a surface with one side only"), std::string::npos) << e.what();
  }
}
