// Points on faces, nodes and edges of shells: positions, areas, normals, and that they move as x = X + v +
// zeta w.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>

#include "atrapos/fem/Loads.hpp"
#include "atrapos/fem/ShellFaces.hpp"
#include "atrapos/fem/StructuredShell.hpp"
#include "support/Meshes.hpp"

using namespace atrapos::fem;
using namespace atrapos::fem::test;

namespace {

constexpr double degree = 3.14159265358979323846 / 180.0;

ShellCylinderOptions roof(int n = 4) {
  ShellCylinderOptions o;
  o.radius = 2;
  o.thetaMin = -40;
  o.thetaMax = 40;
  o.length = 3;
  o.divisions = {n, 2};
  return o;
}

/// The field u of a motion x -> Q x + c: v = (Q - 1) R + c, w = (Q - 1) D.
std::vector<double> rigid(const Mesh& mesh, const ShellGeometry& shells, double angle) {
  std::vector<double> u;
  const double c = std::cos(angle), s = std::sin(angle);
  const auto append = [&](const double* x, double shift) {
    u.insert(u.end(),
             {c * x[0] - s * x[1] - x[0] + shift, s * x[0] + c * x[1] - x[1] - 2 * shift, 3 * shift});
  };
  for (int n = 0; n < mesh.numNodes(); ++n) append(&mesh.coordinates[3 * n], 0.7);
  for (int d = 0; d < shells.numDirectors(); ++d) append(&shells.directors[3 * d], 0);
  return u;
}

/// Largest distance between the points carried along by their nodes and by the rigid motion.
double motionError(const PointSet& p, const std::vector<double>& u, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  double error = 0;
  for (int q = 0; q < p.numPoints(); ++q) {
    const double* X = &p.positions[3 * q];
    double x[3] = {X[0], X[1], X[2]};
    for (int n = 0; n < p.nodesPerEntity; ++n)
      for (int i = 0; i < 3; ++i)
        x[i] += p.shape[q * p.nodesPerEntity + n] *
                u[3 * p.nodes[q / p.pointsPerEntity * p.nodesPerEntity + n] + i];
    error = std::max({error, std::abs(x[0] - (c * X[0] - s * X[1] + 0.7)),
                      std::abs(x[1] - (s * X[0] + c * X[1] - 1.4)), std::abs(x[2] - (X[2] + 2.1))});
  }
  return error;
}

double sum(const std::vector<PointSet>& sets) {
  double total = 0;
  for (const PointSet& p : sets)
    for (double w : p.weights) total += w;
  return total;
}

std::string messageOf(const std::function<void()>& f) {
  try {
    f();
  } catch (const std::runtime_error& e) {
    return e.what();
  }
  return "no error";
}

}  // namespace

TEST(ShellFaces, FollowRigidMotionsAlsoAcrossStepsInThickness) {
  Mesh mesh = shellCylinderMesh(roof());
  mesh.blocks[0].attributeNames = {"thickness"};
  for (int e = 0; e < mesh.numElements(); ++e) mesh.blocks[0].attributes.push_back(0.1 + 0.05 * (e % 3));
  const ShellGeometry shells = shellGeometry(mesh, {{0, {}}});
  const auto u = rigid(mesh, shells, 0.8);
  // Sums of sixteen products of numbers of size one to three.
  constexpr double rounding = 1e-14 * 10;
  for (double zeta : {-1.0, 0.0, 0.3, 1.0})
    for (const char* set : {"outer", "inner"})
      for (const PointSet& p : shellFacePoints(mesh, shells, sideSet(mesh, set), zeta, 4)) {
        EXPECT_EQ(p.nodesPerEntity, zeta == 0 ? 8 : 16);
        EXPECT_LT(motionError(p, u, 0.8), rounding);
      }
  for (double zeta : {-1.0, 1.0})
    EXPECT_LT(motionError(shellNodePoints(mesh, shells, nodesOfSet(mesh, "y_min"), zeta), u, 0.8), rounding);
  for (const PointSet& p : shellEdgePoints(mesh, sideSet(mesh, "y_max"), 4))
    EXPECT_LT(motionError(p, u, 0.8), rounding);
}

TEST(ShellFaces, AreasAndNormalsAreThoseOfTheOffsetSurface) {
  const auto errors = [](int n) {
    const Mesh mesh = shellCylinderMesh(roof(n));
    const ShellGeometry shells = shellGeometry(mesh, {{0, 0.4}});
    std::vector<double> result;
    for (double zeta : {-1.0, 0.0, 1.0})
      result.push_back(std::abs(sum(shellFacePoints(mesh, shells, sideSet(mesh, "outer"), zeta, 6)) -
                                (2 + 0.2 * zeta) * 80 * degree * 3));
    return result;
  };
  const auto coarse = errors(8), fine = errors(16);
  // The middle surface converges with h^4; the directors at the two ends are h^3 off and move the ends of the
  // faces by as much.
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(std::log2(coarse[i] / fine[i]), i == 1 ? 4 : 3, 0.1) << i;

  const Mesh mesh = shellCylinderMesh(roof(8));
  const ShellGeometry shells = shellGeometry(mesh, {{0, 0.4}});
  for (const char* set : {"outer", "inner"})
    for (double zeta : {-1.0, 0.0, 1.0})
      for (const PointSet& p : shellFacePoints(mesh, shells, sideSet(mesh, set), zeta, 4))
        for (int q = 0; q < p.numPoints(); ++q) {
          const double* x = &p.positions[3 * q];
          const double* n = &p.normals[3 * q];
          // Parabolas of 10 degrees are within 1e-4 of the circle; the sign is that of the set's side.
          EXPECT_NEAR(std::hypot(x[0], x[2]), 2 + 0.2 * zeta, 1e-4);
          EXPECT_NEAR((n[0] * x[0] + n[2] * x[2]) / std::hypot(x[0], x[2]), set[0] == 'o' ? 1 : -1, 1e-4);
        }
}

// The middle is the face that side sets of solids would give.
TEST(ShellFaces, TheMiddleIsThatOfPlainFaces) {
  const Mesh mesh = shellCylinderMesh(roof());
  const ShellGeometry shells = shellGeometry(mesh, {{0, 0.1}});
  const PointSet a = shellFacePoints(mesh, shells, sideSet(mesh, "inner"), 0, 4).at(0),
                 b = facePoints(mesh, sideSet(mesh, "inner"), 4).at(0);
  EXPECT_EQ(a.nodes, b.nodes);
  EXPECT_EQ(a.shape, b.shape);
  EXPECT_EQ(a.weights, b.weights);
  EXPECT_EQ(a.normals, b.normals);
}

TEST(ShellFaces, EdgesHaveTheirLengthAndPointOutwards) {
  const Mesh mesh = shellCylinderMesh(roof(16));
  // A parabola of 5 degrees is shorter than its arc by 1e-8 or so of it.
  EXPECT_NEAR(edgeLength(mesh, sideSet(mesh, "y_min")), 2 * 80 * degree, 1e-6);
  EXPECT_NEAR(edgeLength(mesh, sideSet(mesh, "theta_max")), 3, 1e-14);
  for (const PointSet& p : shellEdgePoints(mesh, sideSet(mesh, "y_min"), 3))
    for (int q = 0; q < p.numPoints(); ++q) EXPECT_NEAR(p.normals[3 * q + 1], -1, 1e-14);
  for (const PointSet& p : shellEdgePoints(mesh, sideSet(mesh, "theta_max"), 3))
    for (int q = 0; q < p.numPoints(); ++q) {
      EXPECT_NEAR(p.normals[3 * q], std::cos(40 * degree), 1e-4);  // along theta, h^3 off at an end
      EXPECT_NEAR(p.normals[3 * q + 2], -std::sin(40 * degree), 1e-4);
    }
  for (Topology cell :
       {Topology::Shell3, Topology::Shell4, Topology::Shell6, Topology::Shell8, Topology::Shell9}) {
    auto o = roof();
    o.topology = cell;
    const Mesh any = shellCylinderMesh(o);
    const SideSet& set = sideSet(any, "theta_min");
    std::vector<double> force(3 * any.numNodes(), 0.0);
    addEdgeForce(any, set, {0, 5, -2}, force);
    double total[3] = {0, 0, 0}, moment = 0;
    for (int n = 0; n < any.numNodes(); ++n) {
      for (int i = 0; i < 3; ++i) total[i] += force[3 * n + i];
      moment += any.coordinates[3 * n + 1] * force[3 * n + 2];
    }
    EXPECT_NEAR(total[0], 0, 1e-13);
    EXPECT_NEAR(total[1], 15, 1e-13);
    EXPECT_NEAR(total[2], -6, 1e-13);
    EXPECT_NEAR(moment, -6 * 1.5, 1e-13);  // uniform along y from 0 to 3
  }
}

// The work of a traction on the outer face in a small rotation about y: t . (omega x integral of x dA), with
// the offset cylinder's area and centroid.
TEST(ShellFaces, TractionsOnOffsetSurfacesDoTheirWorkInARotation) {
  const double t = 0.3, r = 2 + t / 2, half = 40 * 3.14159265358979323846 / 180;
  const auto error = [&](int n) {
    const Mesh mesh = shellCylinderMesh(roof(n));
    const ShellGeometry shells = shellGeometry(mesh, {{0, t}});
    std::vector<double> force(3 * static_cast<std::size_t>(shells.numNodes()), 0.0);
    const auto faces = shellFacePoints(mesh, shells, sideSet(mesh, "outer"), 1, loadDegree);
    addTraction(faces, {5, 0, 0}, force);
    // omega x X = (z, 0, -x)
    double work = 0;
    for (int k = 0; k < mesh.numNodes(); ++k) work += force[3 * k] * mesh.coordinates[3 * k + 2];
    for (int d = 0; d < shells.numDirectors(); ++d)
      work += force[3 * (mesh.numNodes() + d)] * shells.directors[3 * d + 2];
    const double area = 2 * half * r * 3;
    EXPECT_NEAR(areaOf(faces), area, 0.01 * area);
    return std::abs(work / (5 * area * r * std::sin(half) / half) - 1);
  };
  EXPECT_LT(error(4), 2e-3);
  EXPECT_GT(error(4) / error(8), 7);  // third order or better
}

TEST(ShellFaces, OtherSidesAndNodesAreNamed) {
  const Mesh mesh = glued({box(Topology::Hex8, {1, 1, 1}, {1, 1, 1}, {9, 9, 9}), shellCylinderMesh(roof())});
  const ShellGeometry shells = shellGeometry(mesh, {{1, 0.1}});
  const SideSet solid{"solid", 1, {{0, 0}}}, edge{"edge", 2, {{1, 3}}}, face{"face", 3, {{1, 0}}};
  const auto faces = [&](const SideSet& set) {
    return messageOf([&] { shellFacePoints(mesh, shells, set, 1, 2); });
  };
  EXPECT_EQ(faces(solid), "side set 'solid': side 1 of element 1 (block 'HEX8') is no face of a shell");
  EXPECT_EQ(faces(edge), "side set 'edge': side 4 of element 2 (block 'shell') is no face of a shell");
  EXPECT_EQ(faces(face), "no error");
  EXPECT_EQ(messageOf([&] { shellEdgePoints(mesh, face, 2); }),
            "side set 'face': side 1 of element 2 (block 'shell') is no edge of a shell");
  EXPECT_EQ(messageOf([&] { shellEdgePoints(mesh, solid, 2); }),
            "side set 'solid': side 1 of element 1 (block 'HEX8') is no edge of a shell");
  EXPECT_EQ(messageOf([&] { shellNodePoints(mesh, shells, {2}, 1); }),
            "node 3: no shell is there, so it has no point at zeta = 1");
}
