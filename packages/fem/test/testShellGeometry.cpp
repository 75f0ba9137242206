// Directors, their numbering, folds, thickness and what is refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>

#include "atrapos/fem/PointSet.hpp"
#include "atrapos/fem/ReferenceCell.hpp"
#include "atrapos/fem/ShellGeometry.hpp"
#include "atrapos/fem/StructuredShell.hpp"
#include "support/Meshes.hpp"

using namespace atrapos::fem;
using namespace atrapos::fem::test;

namespace {

using Vec = std::array<double, 3>;
constexpr double degree = 3.14159265358979323846 / 180.0;
// Directors are sums of a few products of numbers of size one.
constexpr double rounding = 1e-14;

double dot(const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
double norm(const Vec& a) { return std::sqrt(dot(a, a)); }

Vec director(const ShellGeometry& shells, int d) {
  return {shells.directors[3 * d], shells.directors[3 * d + 1], shells.directors[3 * d + 2]};
}

Mesh plate(Topology cell = Topology::Shell8, std::array<int, 2> divisions = {2, 2}) {
  ShellPlateOptions o;
  o.divisions = divisions;
  o.topology = cell;
  return shellPlateMesh(o);
}

Mesh turned(Mesh mesh, const std::function<Vec(const Vec&)>& map) {
  for (int n = 0; n < mesh.numNodes(); ++n) {
    const Vec x = map({mesh.coordinates[3 * n], mesh.coordinates[3 * n + 1], mesh.coordinates[3 * n + 2]});
    std::copy(x.begin(), x.end(), mesh.coordinates.begin() + 3 * n);
  }
  return mesh;
}

/// A unit plate from the y axis outwards, at an angle to the x axis.
Mesh wing(double angle, bool away = false) {
  const double c = std::cos(angle * degree), s = std::sin(angle * degree);
  Mesh mesh = turned(plate(), [&](const Vec& x) { return Vec{c * x[0], x[1], s * x[0]}; });
  if (away)  // the other side of the y axis: the same normal needs the nodes in the other order
    for (std::size_t e = 0; e < mesh.blocks[0].nodes.size(); e += 8) {
      int* n = &mesh.blocks[0].nodes[e];
      const int old[8] = {n[0], n[1], n[2], n[3], n[4], n[5], n[6], n[7]};
      const int reversed[8] = {0, 3, 2, 1, 7, 6, 5, 4};
      for (int i = 0; i < 8; ++i) n[i] = old[reversed[i]];
    }
  mesh.blocks[0].name = "wing" + std::to_string(static_cast<int>(angle));
  return mesh;
}

/// Two plates that meet at the y axis; the normals there differ by `fold` degrees.
Mesh folded(double fold) { return glued({wing(180 - fold, true), wing(0)}); }

std::vector<ShellSection> sections(const Mesh& mesh, double thickness) {
  std::vector<ShellSection> result;
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b)
    if (isShell(mesh.blocks[b].topology)) result.push_back({static_cast<int>(b), thickness});
  return result;
}

std::string messageOf(const Mesh& mesh, const std::vector<ShellSection>& s,
                      const ShellGeometryOptions& options = {}) {
  try {
    shellGeometry(mesh, s, options);
  } catch (const std::invalid_argument& e) {
    EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos);
    return e.what();
  }
  return "no error";
}

void expectMessage(const std::string& message, const std::string& part) {
  EXPECT_NE(message.find(part), std::string::npos) << message;
}

int nodeAt(const Mesh& mesh, const Vec& x) {
  for (int n = 0; n < mesh.numNodes(); ++n) {
    double distance = 0;
    for (int i = 0; i < 3; ++i) distance += std::abs(mesh.coordinates[3 * n + i] - x[i]);
    if (distance < 1e-12) return n;
  }
  ADD_FAILURE() << "no node";
  return 0;
}

/// Volume of the bodies X = R + zeta D, 2 x 2 x 2 or 3 x 3 x 2 points.
double volume(const Mesh& mesh, const ShellGeometry& shells) {
  double sum = 0;
  for (const ShellBlock& s : shells.blocks) {
    const Tabulation t = tabulate(mesh.blocks[s.block].topology, 5);
    const int N = s.nodesPerElement;
    for (int e = 0; e < s.numElements(); ++e)
      for (int q = 0; q < t.numPoints; ++q)
        for (double zeta : {-1 / std::sqrt(3.0), 1 / std::sqrt(3.0)}) {
          Vec g[3]{};
          for (int n = 0; n < N; ++n)
            for (int i = 0; i < 3; ++i) {
              const double X = mesh.coordinates[3 * s.nodes[2 * N * e + n] + i],
                           D = s.directors[3 * (N * e + n) + i];
              for (int d = 0; d < 2; ++d) g[d][i] += t.gradients[(q * N + n) * 2 + d] * (X + zeta * D);
              g[2][i] += t.values[q * N + n] * D;
            }
          const Vec c{g[0][1] * g[1][2] - g[0][2] * g[1][1], g[0][2] * g[1][0] - g[0][0] * g[1][2],
                      g[0][0] * g[1][1] - g[0][1] * g[1][0]};
          sum += t.weights[q] * dot(c, g[2]);
        }
  }
  return sum;
}

}  // namespace

TEST(ShellGeometry, FlatPlateHasHalfTheThicknessAlongItsNormal) {
  for (Topology cell : {Topology::Shell4, Topology::Shell8, Topology::Shell9}) {
    SCOPED_TRACE(topologyName(cell));
    const Mesh mesh = plate(cell);
    const ShellGeometry shells = shellGeometry(mesh, {{0, 0.2}});
    ASSERT_EQ(shells.numDirectors(), mesh.numNodes());
    EXPECT_EQ(shells.numNodes(), 2 * mesh.numNodes());
    for (int d = 0; d < shells.numDirectors(); ++d) {
      const Vec D = director(shells, d);
      EXPECT_NEAR(D[0], 0, rounding);
      EXPECT_NEAR(D[1], 0, rounding);
      EXPECT_NEAR(D[2], 0.1, rounding);
    }
    ASSERT_EQ(shells.blocks.size(), 1u);
    const ShellBlock& s = shells.blocks[0];
    const int N = nodesPerElement(cell);
    EXPECT_EQ(s.nodesPerElement, N);
    EXPECT_EQ(s.numElements(), 4);
    for (int e = 0; e < 4; ++e)
      for (int n = 0; n < N; ++n) {
        const int v = s.nodes[2 * N * e + n], w = s.nodes[2 * N * e + N + n];
        EXPECT_EQ(v, mesh.blocks[0].nodes[N * e + n]);
        EXPECT_EQ(shells.directorNodes(v), std::vector<int>{w});
        EXPECT_EQ(shells.meshNode[w - mesh.numNodes()], v);
        EXPECT_EQ(s.directorScale[N * e + n], 1.0);
        for (int i = 0; i < 3; ++i) EXPECT_EQ(s.midsurface[3 * (N * e + n) + i], mesh.coordinates[3 * v + i]);
        for (int i = 0; i < 3; ++i)
          EXPECT_EQ(s.directors[3 * (N * e + n) + i], shells.directors[3 * (w - mesh.numNodes()) + i]);
      }
    EXPECT_NEAR(volume(mesh, shells), 0.2, rounding);
  }
}

// Bodies of curved shells: directors against the true normals, volumes against 2 pi r l t and its like. A
// common thickness gives the exact volume of a cylinder (t r dtheta dy), and t + t^3 / (12 r^2) of a sphere.
TEST(ShellGeometry, DirectorsAndVolumesOfCurvedShellsConverge) {
  struct Errors {
    double direction = 0, length = 0, volume = 0;
  };
  const auto onCylinder = [](Topology cell, int n) {
    ShellCylinderOptions o;
    o.thetaMax = 80;
    o.divisions = {n, 2};
    o.topology = cell;
    const Mesh mesh = shellCylinderMesh(o);
    const ShellGeometry shells = shellGeometry(mesh, {{0, 0.2}});
    EXPECT_EQ(shells.numDirectors(), mesh.numNodes());
    Errors e;
    e.volume = std::abs(volume(mesh, shells) - 0.2 * 80 * degree);
    for (int d = 0; d < shells.numDirectors(); ++d) {
      const double* x = &mesh.coordinates[3 * shells.meshNode[d]];
      const Vec D = director(shells, d), n{x[0], 0, x[2]};
      e.direction = std::max(e.direction, std::acos(std::min(1.0, dot(D, n) / norm(D))));
      e.length = std::max(e.length, std::abs(norm(D) - 0.1));
    }
    return e;
  };
  const auto onSphere = [](Topology cell, int n) {
    ShellSphereOptions o;
    o.divisions = {n, n};
    o.topology = cell;
    const Mesh mesh = shellSphereMesh(o);
    const ShellGeometry shells = shellGeometry(mesh, {{0, 0.2}});
    EXPECT_EQ(shells.numDirectors(), mesh.numNodes());
    Errors e;
    e.volume = std::abs(volume(mesh, shells) -
                        90 * degree * std::sin(72 * degree) * (std::pow(1.1, 3) - std::pow(0.9, 3)) / 3);
    for (int d = 0; d < shells.numDirectors(); ++d) {
      const double* x = &mesh.coordinates[3 * shells.meshNode[d]];
      const Vec D = director(shells, d), n{x[0], x[1], x[2]};
      e.direction = std::max(e.direction, std::acos(std::min(1.0, dot(D, n) / norm(D))));
      e.length = std::max(e.length, std::abs(norm(D) - 0.1));
    }
    return e;
  };
  for (const auto& run : {std::function<Errors(Topology, int)>(onCylinder), {onSphere}}) {
    for (Topology cell : {Topology::Shell8, Topology::Shell9}) {
      SCOPED_TRACE(topologyName(cell));
      const Errors coarse = run(cell, 8), fine = run(cell, 16);
      // A parabola through three points of an arc misses the direction at its ends by h^3; inside, the errors
      // of two neighbours cancel to the next order, at the edges of the mesh there is no second one. The
      // mitre is of the square of the difference between neighbours. Next terms change the rates by
      // hundredths.
      EXPECT_NEAR(std::log2(coarse.direction / fine.direction), 3, 0.1);
      EXPECT_NEAR(std::log2(coarse.length / fine.length), 6, 0.1);
      EXPECT_LT(fine.length, 1e-9);
      // h^4 as the area; on the sphere the edges' directors, h^3 off, slow it down on meshes as coarse as
      // these.
      EXPECT_GT(std::log2(coarse.volume / fine.volume), 3.6);
    }
    // Facets: at an edge the normal is that of the chord, h/2 off; inside, neighbours cancel.
    const Errors coarse = run(Topology::Shell4, 8), fine = run(Topology::Shell4, 16);
    EXPECT_NEAR(std::log2(coarse.direction / fine.direction), 1, 0.1);
  }
}

TEST(ShellGeometry, DirectorsTurnWithTheMesh) {
  const Mesh mesh = distorted(plate(Topology::Shell8, {3, 3}), 0.02);
  const double c = std::cos(1.0), s = std::sin(1.0);
  const auto rotation = [&](const Vec& x) { return Vec{c * x[0] - s * x[2], x[1], s * x[0] + c * x[2]}; };
  ShellGeometryOptions wide;
  wide.foldAngle = 90;  // the distortion bends the plate by tens of degrees
  const ShellGeometry a = shellGeometry(mesh, {{0, 0.01}}, wide),
                      b = shellGeometry(turned(mesh, rotation), {{0, 0.01}}, wide);
  ASSERT_EQ(a.numDirectors(), b.numDirectors());
  for (int d = 0; d < a.numDirectors(); ++d) {
    const Vec expected = rotation(director(a, d)), D = director(b, d);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(D[i], expected[i], rounding);
  }
}

TEST(ShellGeometry, FoldsBeyondTheAngleHaveTwoDirectors) {
  for (double fold : {19.0, 21.0, 90.0}) {
    SCOPED_TRACE(fold);
    const Mesh mesh = folded(fold);
    const ShellGeometry shells = shellGeometry(mesh, sections(mesh, 0.2));
    const int onFold = nodeAt(mesh, {0, 0.5, 0});
    const auto nodes = shells.directorNodes(onFold);
    const Vec left{std::sin(fold * degree), 0, std::cos(fold * degree)}, right{0, 0, 1};
    if (fold < 20) {
      // The mitre: both plates keep their thickness along their own normals up to the fold.
      ASSERT_EQ(nodes.size(), 1u);
      const Vec D = director(shells, nodes[0] - mesh.numNodes());
      EXPECT_NEAR(norm(D), 0.1 / std::cos(fold / 2 * degree), rounding);
      EXPECT_NEAR(std::abs(dot(D, left)), 0.1, rounding);
      EXPECT_NEAR(dot(D, right), 0.1, rounding);
      EXPECT_EQ(shells.numDirectors(), mesh.numNodes());
    } else {
      ASSERT_EQ(nodes.size(), 2u);
      EXPECT_EQ(nodes[1], nodes[0] + 1);
      for (int i = 0; i < 2; ++i) {
        const Vec D = director(shells, nodes[i] - mesh.numNodes());
        EXPECT_NEAR(norm(D), 0.1, rounding);
        EXPECT_NEAR(std::abs(dot(D, i == 0 ? left : right)), 0.1, rounding);
      }
      EXPECT_EQ(shells.numDirectors(), mesh.numNodes() + 5);  // five nodes along the fold
    }
    // Each element is tied to the director of its own side.
    for (const ShellBlock& s : shells.blocks)
      for (int e = 0; e < s.numElements(); ++e)
        for (int n = 0; n < 8; ++n)
          if (s.nodes[16 * e + n] == onFold) {
            EXPECT_EQ(s.nodes[16 * e + 8 + n], nodes[fold < 20 ? 0 : s.block]);
          }
    // The same fold, kept stiff on demand.
    ShellGeometryOptions wide;
    wide.foldAngle = 100;
    const ShellGeometry stiff = shellGeometry(mesh, sections(mesh, 0.2), wide);
    ASSERT_EQ(stiff.directorNodes(onFold).size(), 1u);
    EXPECT_NEAR(norm(director(stiff, stiff.directorNodes(onFold)[0] - mesh.numNodes())),
                0.1 / std::cos(fold / 2 * degree), rounding);
  }
}

TEST(ShellGeometry, BranchesJoinWhatContinues) {
  const Mesh mesh = glued({wing(180, true), wing(0), wing(90)});
  const ShellGeometry shells = shellGeometry(mesh, sections(mesh, 0.2));
  EXPECT_EQ(shells.directorNodes(nodeAt(mesh, {0, 0.5, 0})).size(), 2u);
  EXPECT_EQ(shells.numDirectors(), mesh.numNodes() + 5);
  EXPECT_EQ(shells.blocks[0].nodesPerElement, 8);
  // The web is no part of a smooth surface, however wide the fold angle is, at the nodes between corners too.
  ShellGeometryOptions wide;
  wide.foldAngle = 100;
  EXPECT_EQ(shellGeometry(mesh, sections(mesh, 0.2), wide).numDirectors(), mesh.numNodes() + 5);
}

// A ridge with one quadrilateral on its right and two triangles, or one, for the same square on its left: the
// director halves the fold wherever the same angle lies on either side of the node.
TEST(ShellGeometry, TrianglesCountWithTheAngleOfTheirCorner) {
  const double s = std::sin(5 * degree), c = std::cos(5 * degree);
  Mesh mesh;
  for (double x : {-c, 0.0, c})
    for (double y : {0.0, 1.0}) mesh.coordinates.insert(mesh.coordinates.end(), {x, y, -s * std::abs(x) / c});
  Block left, right;
  left.name = "left";
  left.topology = Topology::Shell3;
  left.nodes = {2, 1, 0, 2, 3, 1};  // the diagonal from node 2 on the ridge
  right.name = "right";
  right.id = 1;
  right.topology = Topology::Shell4;
  right.nodes = {2, 4, 5, 3};
  mesh.blocks = {left, right};
  const ShellGeometry shells = shellGeometry(mesh, sections(mesh, 0.2));
  for (const int node : {2, 3}) {
    const Vec shared = director(shells, shells.firstDirector[node]);
    EXPECT_NEAR(shared[0], 0, rounding);
    EXPECT_NEAR(shared[2], 0.1 / c, rounding);  // the mitre
  }
}

TEST(ShellGeometry, ChainsOfSmallAnglesShareADirector) {
  // Facets of a cone of 15 degrees each: at the corners of a ring, neighbours differ by less than 20 degrees.
  ShellCylinderOptions o;
  o.thetaMax = 90;
  o.divisions = {6, 2};
  o.topology = Topology::Shell4;
  const Mesh mesh = shellCylinderMesh(o);
  const ShellGeometry smooth = shellGeometry(mesh, {{0, 0.01}});
  EXPECT_EQ(smooth.numDirectors(), mesh.numNodes());
  ShellGeometryOptions narrow;
  narrow.foldAngle = 14;
  EXPECT_EQ(shellGeometry(mesh, {{0, 0.01}}, narrow).numDirectors(), mesh.numNodes() + 5 * 3);
}

TEST(ShellGeometry, SolidsHaveNoDirectors) {
  Mesh mesh = glued({box(Topology::Hex20, {2, 2, 2}), turned(plate(), [](const Vec& x) {
                       return Vec{1 + x[0], x[1], 0.5};
                     })});
  const int shellNodes = 21;
  EXPECT_EQ(shellGeometry(mesh, {{1, 0.1}}).numDirectors(), shellNodes);
  const ShellGeometry shells = shellGeometry(mesh, {{1, 0.1}});
  EXPECT_EQ(shells.find(0), nullptr);
  ASSERT_NE(shells.find(1), nullptr);
  EXPECT_EQ(shells.find(1)->block, 1);
  for (int n = 0; n < mesh.numNodes(); ++n) {
    const auto& of = mesh.blocks[1].nodes;
    EXPECT_EQ(shells.directorNodes(n).size(), std::count(of.begin(), of.end(), n) > 0 ? 1u : 0u);
  }
  // The nodes on the solid's face are common: v is coupled there, w belongs to the shell alone.
  const int onBoth = nodeAt(mesh, {1, 0.5, 0.5});
  EXPECT_GT(std::count(mesh.blocks[0].nodes.begin(), mesh.blocks[0].nodes.end(), onBoth), 0);
  EXPECT_EQ(shells.directorNodes(onBoth).size(), 1u);
}

TEST(ShellGeometry, StepsInThicknessScaleACommonDirector) {
  Mesh mesh = plate(Topology::Shell8, {2, 1});
  mesh.blocks[0].attributeNames = {"thickness"};
  mesh.blocks[0].attributes = {0.1, 0.3};
  const ShellGeometry shells = shellGeometry(mesh, {{0, {}}});
  const int between = nodeAt(mesh, {0.5, 0.5, 0});
  ASSERT_EQ(shells.directorNodes(between).size(), 1u);
  const int d = shells.directorNodes(between)[0] - mesh.numNodes();
  EXPECT_NEAR(norm(director(shells, d)), 0.1, rounding);  // half of the mean
  const ShellBlock& s = shells.blocks[0];
  for (int e = 0; e < 2; ++e)
    for (int n = 0; n < 8; ++n) {
      EXPECT_NEAR(s.directors[3 * (8 * e + n) + 2], e == 0 ? 0.05 : 0.15, rounding);
      EXPECT_NEAR(
          s.directorScale[8 * e + n] * shells.directors[3 * (s.nodes[16 * e + 8 + n] - mesh.numNodes()) + 2],
          e == 0 ? 0.05 : 0.15, rounding);
    }
  EXPECT_NEAR(volume(mesh, shells), 0.2, rounding);  // half of the unit plate each
}

TEST(ShellGeometry, PrescribedDirectorsGiveTheDirection) {
  ShellSphereOptions o;
  o.divisions = {2, 2};
  const Mesh mesh = shellSphereMesh(o);
  ShellGeometryOptions exact;
  for (int n = 0; n < mesh.numNodes(); ++n)
    exact.directors.push_back(
        {n, {7 * mesh.coordinates[3 * n], 7 * mesh.coordinates[3 * n + 1], 7 * mesh.coordinates[3 * n + 2]}});
  const ShellGeometry shells = shellGeometry(mesh, {{0, 0.2}}, exact);
  for (int d = 0; d < shells.numDirectors(); ++d)
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR(shells.directors[3 * d + i], 0.1 * mesh.coordinates[3 * shells.meshNode[d] + i], rounding);

  exact.directors[4].direction = {-1, -1, -1};
  expectMessage(messageOf(mesh, {{0, 0.2}}, exact),
                "node 5: the prescribed director points to the bottom face of");
  exact.directors[4].direction = {0, 0, 0};
  expectMessage(messageOf(mesh, {{0, 0.2}}, exact), "node 5: the prescribed director has no direction");
  exact.directors[4] = {mesh.numNodes(), {0, 0, 1}};
  expectMessage(messageOf(mesh, {{0, 0.2}}, exact), "no shell has node");
}

TEST(ShellGeometry, OppositeNodeOrdersNameBothElements) {
  Mesh mesh = plate();
  mesh.elementIds = {10, 20, 30, 40};
  int* n = &mesh.blocks[0].nodes[8];
  for (auto [i, j] : {std::pair{1, 3}, {4, 7}, {5, 6}}) std::swap(n[i], n[j]);
  const std::string message = messageOf(mesh, {{0, 0.1}});
  expectMessage(message, "element 10 (block 'shell')");
  expectMessage(message, "element 20 (block 'shell') have opposite normals: both run from node ");
  // Across blocks, and at a fold of any angle.
  mesh = glued({wing(135), wing(0)});
  expectMessage(messageOf(mesh, sections(mesh, 0.1)), "(block 'wing135') and element ");
  // At a branch two of three edges run the same way whatever one does; only those that continue each other
  // count.
  mesh = glued({wing(180), wing(0), wing(90)});
  expectMessage(messageOf(mesh, sections(mesh, 0.1)), "(block 'wing180') and element ");
  mesh = glued({wing(180, true), wing(0), wing(90, true)});
  EXPECT_EQ(messageOf(mesh, sections(mesh, 0.1)), "no error");
}

TEST(ShellGeometry, BadJacobiansNameTheElement) {
  // A mid-edge node beyond its corner folds the surface over.
  Mesh mesh = plate(Topology::Shell8, {2, 1});
  mesh.coordinates[3 * mesh.blocks[0].nodes[8 + 4]] += 0.4;
  expectMessage(
      messageOf(mesh, {{0, 0.1}}),
      "element 2 (block 'shell'): the Jacobian of the middle surface is zero or changes sign at node ");
  // A collapsed edge has no normal at its end.
  mesh = plate(Topology::Shell4, {1, 1});
  mesh.blocks[0].nodes[3] = mesh.blocks[0].nodes[2];
  expectMessage(messageOf(mesh, {{0, 0.1}}),
                "element 1 (block 'shell'): the Jacobian of the middle surface is zero");
  // Thicker than twice the radius of curvature, the inner face is turned inside out.
  ShellCylinderOptions o;
  o.thetaMax = 80;
  o.divisions = {8, 1};
  mesh = shellCylinderMesh(o);
  EXPECT_EQ(messageOf(mesh, {{0, 1.98}}), "no error");
  const std::string message = messageOf(mesh, {{0, 2.02}});
  expectMessage(message, "element 1 (block 'shell'): the Jacobian is -");
  expectMessage(message, "on the bottom surface, must be positive; the shell is too thick for its curvature");
  // Seen from inside it is the top face.
  for (std::size_t e = 0; e < mesh.blocks[0].nodes.size(); e += 8) {
    int* n = &mesh.blocks[0].nodes[e];
    for (auto [i, j] : {std::pair{1, 3}, {4, 7}, {5, 6}}) std::swap(n[i], n[j]);
  }
  expectMessage(messageOf(mesh, {{0, 2.02}}), "on the top surface");
}

TEST(ShellGeometry, SectionsMatchTheBlocks) {
  const Mesh mesh = glued({box(Topology::Hex8, {1, 1, 1}), turned(plate(), [](const Vec& x) {
                             return Vec{5 + x[0], x[1], 0.5};
                           })});
  expectMessage(messageOf(mesh, {}), "block 'shell': its SHELL8 need a shell section with a thickness");
  expectMessage(messageOf(mesh, {{0, 0.1}}), "block 'HEX8': has HEX8, no shells");
  expectMessage(messageOf(mesh, {{1, 0.1}, {1, 0.1}}), "block 'shell': has two shell sections");
  expectMessage(messageOf(mesh, {{1, 0.0}}),
                "block 'shell': the thickness of shells must be positive, got 0");
  expectMessage(messageOf(mesh, {{1, {}}}), "block 'shell': the shells have no thickness");
  ShellGeometryOptions options;
  options.foldAngle = 180;
  expectMessage(messageOf(mesh, {{1, 0.1}}, options),
                "the fold angle must be above 0 and below 180 degrees, got 180");
}

TEST(ShellGeometry, FacesWithoutACommonDirectorNameTheNode) {
  const Mesh mesh = folded(172);
  ShellGeometryOptions options;
  options.foldAngle = 175;
  expectMessage(messageOf(mesh, sections(mesh, 0.01), options),
                "the faces there have no common director; a smaller fold angle separates them");
  EXPECT_EQ(messageOf(mesh, sections(mesh, 0.01)), "no error");
}

TEST(ShellGeometry, SurfacesHaveNoVolumePoints) {
  const Mesh mesh = plate();
  try {
    volumePoints(mesh, mesh.blocks[0], tabulate(Topology::Shell8));
    FAIL();
  } catch (const std::runtime_error& e) {
    EXPECT_STREQ(e.what(), "block 'shell': SHELL8 is no solid and has no volume points");
  }
  try {
    facePoints(mesh, sideSet(mesh, "x_max"), 2);
    FAIL();
  } catch (const std::runtime_error& e) {
    EXPECT_STREQ(e.what(), "side set 'x_max': side 4 of element 3 is an edge, where a face is needed");
  }
}
