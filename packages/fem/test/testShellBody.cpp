// Shells as solids: the same bodies, the same sides, the same motions.
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "atrapos/fem/PointSet.hpp"
#include "atrapos/fem/ReferenceCell.hpp"
#include "atrapos/fem/ShellBody.hpp"
#include "atrapos/fem/ShellFaces.hpp"
#include "atrapos/fem/StructuredShell.hpp"
#include "support/Meshes.hpp"

using namespace atrapos::fem;
using namespace atrapos::fem::test;

namespace {

constexpr double degree = 3.14159265358979323846 / 180.0;

Mesh roof(Topology cell) {
  ShellCylinderOptions o;
  o.radius = 2;
  o.thetaMin = -40;
  o.thetaMax = 40;
  o.length = 3;
  o.divisions = {8, 2};
  o.topology = cell;
  return shellCylinderMesh(o);
}

double sum(const std::vector<PointSet>& sets) {
  double total = 0;
  for (const PointSet& p : sets)
    for (double w : p.weights) total += w;
  return total;
}

}  // namespace

TEST(ShellBody, HasTheShellsFacesAndVolume) {
  for (Topology cell :
       {Topology::Shell3, Topology::Shell4, Topology::Shell6, Topology::Shell8, Topology::Shell9}) {
    SCOPED_TRACE(topologyName(cell));
    const Mesh mesh = roof(cell);
    const ShellGeometry shells = shellGeometry(mesh, {{0, 0.2}});
    const ShellBody body = shellBody(mesh, shells);
    EXPECT_EQ(body.mesh.numNodes(), mesh.numNodes() + 2 * shells.numDirectors());
    // The faces are those of the offset surfaces to rounding: top, bottom and their normals.
    for (const char* set : {"outer", "inner"}) {
      const double zeta = set[0] == 'o' ? 1 : -1;
      const PointSet a = facePoints(body.mesh, sideSet(body.mesh, set), 4).at(0),
                     b = shellFacePoints(mesh, shells, sideSet(mesh, set), zeta, 4).at(0);
      // Faces of solids may start at another corner: compare areas and moments, which the points do not
      // change.
      double areaA = 0, areaB = 0, fluxA = 0, fluxB = 0;
      for (int q = 0; q < a.numPoints(); ++q) {
        areaA += a.weights[q];
        areaB += b.weights[q];
        for (int i = 0; i < 3; ++i) {
          fluxA += a.weights[q] * a.normals[3 * q + i] * a.positions[3 * q + i];
          fluxB += b.weights[q] * b.normals[3 * q + i] * b.positions[3 * q + i];
        }
      }
      EXPECT_NEAR(areaA, areaB, 1e-12);
      EXPECT_NEAR(fluxA, fluxB, 1e-12);
      EXPECT_GT(zeta * fluxA, 0);
    }
    // Volume by the divergence theorem over all faces: they are closed and point outwards.
    double flux = 0;
    for (const char* set : {"outer", "inner", "theta_min", "theta_max", "y_min", "y_max"})
      for (const PointSet& p : facePoints(body.mesh, sideSet(body.mesh, set), 6))
        for (int q = 0; q < p.numPoints(); ++q)
          for (int i = 0; i < 3; ++i) flux += p.weights[q] * p.normals[3 * q + i] * p.positions[3 * q + i];
    double volume = 0;
    const Block& block = body.mesh.blocks[0];
    for (double w : volumePoints(body.mesh, block, tabulate(block.topology, 6)).weights) volume += w;
    EXPECT_NEAR(flux / 3, volume, 1e-12);
    // The true one: 80 degrees of a ring; chords of 10 degrees miss 0.1 % of it, parabolas 1e-6.
    EXPECT_NEAR(volume, 80 * degree * 2 * 0.2 * 3,
                cell == Topology::Shell4 || cell == Topology::Shell3 ? 5e-3 : 1e-5);
    EXPECT_NEAR(sum(facePoints(body.mesh, sideSet(body.mesh, "theta_min"), 4)), 3 * 0.2, 1e-3);
  }
}

TEST(ShellBody, MovesWithTheShell) {
  const Mesh mesh = roof(Topology::Shell8);
  const ShellGeometry shells = shellGeometry(mesh, {{0, 0.2}});
  const ShellBody body = shellBody(mesh, shells);
  // The affine field u = A X: v = A R, w = A D.
  const double A[3][3] = {{0.1, -0.2, 0.3}, {0.5, 0.4, -0.1}, {0.2, 0.7, -0.3}};
  std::vector<double> u;
  const auto append = [&](const std::vector<double>& x) {
    for (std::size_t n = 0; n < x.size(); n += 3)
      for (const auto& row : A) u.push_back(row[0] * x[n] + row[1] * x[n + 1] + row[2] * x[n + 2]);
  };
  append(mesh.coordinates);
  append(shells.directors);
  const auto moved = body.displacements(shells, u);
  ASSERT_EQ(moved.size(), body.mesh.coordinates.size());
  for (int n = 0; n < body.mesh.numNodes(); ++n)
    for (int i = 0; i < 3; ++i) {
      const double* X = &body.mesh.coordinates[3 * n];
      EXPECT_NEAR(moved[3 * n + i], A[i][0] * X[0] + A[i][1] * X[1] + A[i][2] * X[2], 1e-14);
    }
}

TEST(ShellBody, KeepsSolidsAndIds) {
  Mesh mesh = glued({box(Topology::Hex8, {1, 1, 1}, {1, 1, 1}, {9, 9, 9}), roof(Topology::Shell4)});
  mesh.sideSets.push_back({"mixed", 9, {{0, 2}, {1, 0}, {1, 3}}});
  for (int n = 0; n < mesh.numNodes(); ++n) mesh.nodeIds.push_back(1000 - n);
  const ShellGeometry shells = shellGeometry(mesh, {{1, 0.2}});
  const ShellBody body = shellBody(mesh, shells);
  EXPECT_EQ(body.mesh.blocks[0].nodes, mesh.blocks[0].nodes);
  EXPECT_EQ(body.mesh.blocks[1].topology, Topology::Hex8);
  EXPECT_EQ(body.mesh.numElements(), mesh.numElements());
  const auto& sides = body.mesh.sideSets.back().sides;
  EXPECT_EQ(sides[0].side, 2);
  EXPECT_EQ(sides[1].side, 5);
  EXPECT_EQ(sides[2].side, 1);
  EXPECT_EQ(body.mesh.nodeIds[mesh.numNodes()], 1001);
  EXPECT_EQ(static_cast<int>(body.mesh.nodeIds.size()), body.mesh.numNodes());
  EXPECT_THROW(shellBody(roof(Topology::Shell4), shells), std::invalid_argument);
}

// f . u on v and w is F . U on the nodes of the body.
TEST(ShellBody, ForcesDoTheSameWork) {
  const Mesh mesh = roof(Topology::Shell8);
  const ShellGeometry shells = shellGeometry(mesh, {{0, 0.2}});
  const ShellBody body = shellBody(mesh, shells);
  std::vector<double> u, f;
  for (int i = 0; i < 3 * shells.numNodes(); ++i) {
    u.push_back(std::sin(1.3 * i));
    f.push_back(std::cos(0.7 * i * i));
  }
  const auto U = body.displacements(shells, u), F = body.forces(shells, f);
  ASSERT_EQ(U.size(), F.size());
  double ofShell = 0, ofBody = 0, resultant = 0;
  for (std::size_t i = 0; i < u.size(); ++i) ofShell += f[i] * u[i];
  for (std::size_t i = 0; i < U.size(); ++i) ofBody += F[i] * U[i];
  for (std::size_t i = 3 * static_cast<std::size_t>(mesh.numNodes()); i < F.size(); ++i) resultant += F[i];
  EXPECT_NEAR(ofBody, ofShell, 1e-12);  // rounding of a sum of some hundred numbers of size one
  EXPECT_NEAR(resultant, 0, 1e-12);     // couples
}
