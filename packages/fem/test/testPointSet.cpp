#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "atrapos/fem/PointSet.hpp"
#include "support/Meshes.hpp"

using namespace atrapos::fem;
using namespace atrapos::fem::test;

namespace {

// Sums of up to a hundred terms of size one to ten (gradients on cells of width 1/3).
constexpr double rounding = 1e-12;

double linear(const double* x) { return 0.3 + 1.1 * x[0] - 0.7 * x[1] + 0.4 * x[2]; }

std::string messageOf(const Mesh& mesh) {
  try {
    volumePoints(mesh, mesh.blocks[0], tabulate(mesh.blocks[0].topology));
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST(PointSet, LinearFieldsAndTheirGradientsAreExactOnDistortedCells) {
  for (Topology cell : allCells()) {
    SCOPED_TRACE(topologyName(cell));
    const Mesh mesh = distorted(box(cell), 0.03);
    const PointSet g = volumePoints(mesh, mesh.blocks[0], tabulate(cell));
    const PointSet v = volumeValuePoints(mesh, mesh.blocks[0], tabulate(cell));
    ASSERT_EQ(g.shapeComponents, 3);
    ASSERT_EQ(v.shapeComponents, 1);
    ASSERT_EQ(g.numPoints(), v.numPoints());
    const double expected[3] = {1.1, -0.7, 0.4};
    for (int p = 0; p < g.numPoints(); ++p) {
      double value = 0, gradient[3] = {0, 0, 0};
      for (int n = 0; n < g.nodesPerEntity; ++n) {
        const double f = linear(&mesh.coordinates[3 * g.nodes[p / g.pointsPerEntity * g.nodesPerEntity + n]]);
        value += f * v.shape[p * g.nodesPerEntity + n];
        for (int i = 0; i < 3; ++i) gradient[i] += f * g.shapeAt(p, n, i);
      }
      EXPECT_NEAR(value, linear(&v.positions[3 * p]), rounding);
      for (int i = 0; i < 3; ++i) EXPECT_NEAR(gradient[i], expected[i], rounding);
      EXPECT_EQ(g.weights[p], v.weights[p]);
    }
  }
}

// Moving inner nodes only, so that the body stays the unit cube; cubature of degree 6 integrates the Jacobian
// of every cell exactly (5 per direction for HEX27, 3 in all for TET10).
TEST(PointSet, WeightsSumToTheVolume) {
  for (Topology cell : allCells()) {
    SCOPED_TRACE(topologyName(cell));
    Mesh mesh = box(cell);
    const auto moves = randomNumbers(mesh.coordinates.size(), 0.03, 5);
    for (int n = 0; n < mesh.numNodes(); ++n) {
      double* x = &mesh.coordinates[3 * n];
      bool inside = true;
      for (int i = 0; i < 3; ++i) inside = inside && x[i] > 1e-9 && x[i] < 1 - 1e-9;
      for (int i = 0; inside && i < 3; ++i) x[i] += moves[3 * n + i];
    }
    double volume = 0;
    for (double w : volumePoints(mesh, mesh.blocks[0], tabulate(cell, 6)).weights) volume += w;
    EXPECT_NEAR(volume, 1.0, rounding);
  }
}

TEST(PointSet, TurnedInsideOutIsAnErrorThatNamesTheElement) {
  Mesh mesh = box(Topology::Hex8, {3, 1, 1});
  EXPECT_EQ(messageOf(mesh), "");
  int* nodes = &mesh.blocks[0].nodes[8];  // of the second element
  for (int i = 0; i < 4; ++i) std::swap(nodes[i], nodes[4 + i]);
  EXPECT_NE(messageOf(mesh).find("block 'HEX8', element 2 "), std::string::npos) << messageOf(mesh);
}

TEST(PointSet, FacesHaveOutwardUnitNormals) {
  for (Topology cell : allCells()) {
    SCOPED_TRACE(topologyName(cell));
    const Mesh mesh = box(cell);
    const char* names[6] = {"x_min", "x_max", "y_min", "y_max", "z_min", "z_max"};
    for (int s = 0; s < 6; ++s)
      for (const PointSet& p : facePoints(mesh, sideSet(mesh, names[s]), 3))
        for (int q = 0; q < p.numPoints(); ++q)
          for (int i = 0; i < 3; ++i)
            EXPECT_NEAR(p.normals[3 * q + i], i == s / 2 ? (s % 2 ? 1.0 : -1.0) : 0.0, rounding);
  }
}

TEST(PointSet, FacesOfAllShapesInOneSet) {
  Mesh mesh = mixedMesh();
  SideSet all;
  for (int e = 0, first = 0; e < static_cast<int>(mesh.blocks.size()); ++e) {
    const Block& block = mesh.blocks[e];
    for (int s = 0; s < numSides(block.topology); ++s) all.sides.push_back({first, s});
    first += static_cast<int>(block.nodes.size()) / nodesPerElement(block.topology);
  }
  const auto sets = facePoints(mesh, all, 2);
  ASSERT_EQ(sets.size(), 5u);  // TRI3, TRI6, QUAD4, QUAD8, QUAD9
  std::size_t faces = 0;
  for (const PointSet& p : sets) faces += p.numEntities;
  EXPECT_EQ(faces, all.sides.size());
}

TEST(PointSet, AddressesAndNodes) {
  const Mesh mesh = mixedMesh();
  EXPECT_EQ(addressOf(mesh, 0).block, 0);
  EXPECT_EQ(addressOf(mesh, 17).element, 17);
  EXPECT_EQ(addressOf(mesh, 18).block, 1);
  EXPECT_EQ(addressOf(mesh, 18).element, 0);
  EXPECT_EQ(addressOf(mesh, mesh.numElements() - 1).block, 6);
  EXPECT_THROW(addressOf(mesh, mesh.numElements()), std::out_of_range);

  const Mesh cube = box(Topology::Tet10, {2, 3, 1});
  EXPECT_EQ(nodesOf(cube, sideSet(cube, "y_max")), nodesOfSet(cube, "y_max"));

  const std::vector<int> some{4, 2};
  const PointSet points = nodePoints(cube, some);
  EXPECT_EQ(points.nodes, some);
  EXPECT_EQ(points.positions[4], cube.coordinates[3 * 2 + 1]);
  EXPECT_EQ(points.weights, (std::vector<double>{1.0, 1.0}));
}
