// Structured shells: areas, normals, conformity, edges, sets.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>

#include "atrapos/fem/PointSet.hpp"
#include "atrapos/fem/StructuredShell.hpp"
#include "support/Meshes.hpp"

using namespace atrapos::fem;
using namespace atrapos::fem::test;

namespace {

const std::vector<Topology> shells{Topology::Shell4, Topology::Shell8, Topology::Shell9};
constexpr double pi = 3.14159265358979323846;

ShellPlateOptions plate(Topology cell = Topology::Shell8) {
  ShellPlateOptions o;
  o.length = 3;
  o.width = 2;
  o.angle = 60;
  o.origin = {1, -2, 0.5};
  o.thickness = 0.1;
  o.divisions = {4, 2};
  o.topology = cell;
  return o;
}

ShellCylinderOptions cylinder(Topology cell = Topology::Shell8) {
  ShellCylinderOptions o;
  o.radius = 10;
  o.thetaMin = -40;
  o.thetaMax = 40;
  o.length = 7;
  o.yMin = -1;
  o.divisions = {4, 6};
  o.topology = cell;
  return o;
}

ShellAnnulusOptions annulus(Topology cell = Topology::Shell8) {
  ShellAnnulusOptions o;
  o.innerRadius = 6;
  o.outerRadius = 10;
  o.divisions = {2, 8};
  o.topology = cell;
  return o;
}

ShellSphereOptions sphere(Topology cell = Topology::Shell8) {
  ShellSphereOptions o;
  o.radius = 10;
  o.divisions = {4, 4};
  o.topology = cell;
  return o;
}

std::vector<Mesh> allMeshes(Topology cell) {
  ShellCylinderOptions ring = cylinder(cell);
  ring.thetaMin = 0;
  ring.thetaMax = 360;
  ring.divisions = {6, 2};
  ShellAnnulusOptions closed = annulus(cell);
  closed.slit = false;
  return {shellPlateMesh(plate(cell)),   shellCylinderMesh(cylinder(cell)), shellAnnulusMesh(annulus(cell)),
          shellSphereMesh(sphere(cell)), shellCylinderMesh(ring),           shellAnnulusMesh(closed)};
}

/// Area of one of the mesh's faces, with a cubature that is exact for plane cells with straight edges.
double area(const Mesh& mesh, const std::string& set) {
  double sum = 0;
  for (const PointSet& p : facePoints(mesh, sideSet(mesh, set), 7))
    for (double w : p.weights) sum += w;
  return sum;
}

/// Corners of each element's four edges, in their direction.
std::vector<std::array<int, 2>> edgesOf(const Mesh& mesh, int element) {
  const int N = nodesPerElement(mesh.blocks[0].topology);
  const int* nodes = &mesh.blocks[0].nodes[static_cast<std::size_t>(element) * N];
  return {{nodes[0], nodes[1]}, {nodes[1], nodes[2]}, {nodes[2], nodes[3]}, {nodes[3], nodes[0]}};
}

}  // namespace

TEST(StructuredShell, NodesLieOnTheSurface) {
  for (Topology cell : shells) {
    const Mesh meshes[3] = {shellCylinderMesh(cylinder(cell)), shellAnnulusMesh(annulus(cell)),
                            shellSphereMesh(sphere(cell))};
    for (int n = 0; n < meshes[0].numNodes(); ++n)
      EXPECT_NEAR(std::hypot(meshes[0].coordinates[3 * n], meshes[0].coordinates[3 * n + 2]), 10, 1e-14 * 10);
    for (int n = 0; n < meshes[1].numNodes(); ++n) EXPECT_EQ(meshes[1].coordinates[3 * n + 2], 0);
    for (int n = 0; n < meshes[2].numNodes(); ++n) {
      const double* x = &meshes[2].coordinates[3 * n];
      EXPECT_NEAR(std::hypot(x[0], x[1], x[2]), 10, 1e-14 * 10);  // rounding of three squares
    }
  }
}

TEST(StructuredShell, AreasConvergeWithTheOrderOfTheCells) {
  for (Topology cell : shells) {
    SCOPED_TRACE(topologyName(cell));
    EXPECT_NEAR(area(shellPlateMesh(plate(cell)), "top"), 3 * 2 * std::sin(pi / 3), 1e-13);
    const auto errors = [&](int factor) {
      auto c = cylinder(cell);
      auto a = annulus(cell);
      auto s = sphere(cell);
      for (int d = 0; d < 2; ++d) {
        c.divisions[d] *= factor;
        a.divisions[d] *= factor;
        s.divisions[d] *= factor;
      }
      return std::array<double, 3>{
          std::abs(area(shellCylinderMesh(c), "outer") - 10 * 80 * pi / 180 * 7),
          std::abs(area(shellAnnulusMesh(a), "top") - pi * (100 - 36)),
          std::abs(area(shellSphereMesh(s), "inner") - 100 * pi / 2 * std::sin(72 * pi / 180))};
    };
    const auto coarse = errors(2), fine = errors(4);
    // Chords miss an arc's length by h^2, parabolas by h^4; the next term changes the rate by a few
    // hundredths on these meshes.
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR(std::log2(coarse[i] / fine[i]), cell == Topology::Shell4 ? 2 : 4, 0.15) << i;
  }
}

TEST(StructuredShell, NormalsPointToTheTopFace) {
  for (Topology cell : shells) {
    SCOPED_TRACE(topologyName(cell));
    const auto check = [](const Mesh& mesh, const std::string& set, auto normal) {
      for (const PointSet& p : facePoints(mesh, sideSet(mesh, set), 3))
        for (int q = 0; q < p.numPoints(); ++q) {
          const auto n = normal(&p.positions[3 * q]);
          double cosine = 0;
          for (int i = 0; i < 3; ++i) cosine += n[i] * p.normals[3 * q + i];
          EXPECT_GT(cosine, 0.95);  // facets of 22 degrees: half of that in two directions, and the sagitta
        }
    };
    using V = std::array<double, 3>;
    check(shellPlateMesh(plate(cell)), "top", [](const double*) { return V{0, 0, 1}; });
    check(shellPlateMesh(plate(cell)), "bottom", [](const double*) { return V{0, 0, -1}; });
    check(shellAnnulusMesh(annulus(cell)), "top", [](const double*) { return V{0, 0, 1}; });
    check(shellCylinderMesh(cylinder(cell)), "outer", [](const double* x) {
      return V{x[0] / 10, 0, x[2] / 10};
    });
    check(shellCylinderMesh(cylinder(cell)), "inner", [](const double* x) {
      return V{-x[0] / 10, 0, -x[2] / 10};
    });
    check(shellSphereMesh(sphere(cell)), "outer", [](const double* x) {
      return V{x[0] / 10, x[1] / 10, x[2] / 10};
    });
  }
}

// Every inner edge belongs to two elements that run through it in opposite directions; the others are, once
// each, the sides of the side sets of edges, whose nodes are those of the node sets with their names.
TEST(StructuredShell, CellsConformAndEdgesAreTheBoundary) {
  for (Topology cell : shells)
    for (const Mesh& mesh : allMeshes(cell)) {
      SCOPED_TRACE(std::string(topologyName(cell)) + " " + mesh.title);
      std::map<std::array<int, 2>, int> uses;
      for (int e = 0; e < mesh.numElements(); ++e)
        for (const auto& edge : edgesOf(mesh, e)) ++uses[edge];
      std::set<std::array<int, 2>> boundary, inSets;
      for (const auto& [edge, count] : uses) {
        EXPECT_EQ(count, 1);
        if (uses.count({edge[1], edge[0]}) == 0) boundary.insert(edge);
      }
      for (const SideSet& set : mesh.sideSets) {
        if (set.sides.at(0).side < 2) continue;
        for (const Side& side : set.sides) {
          ASSERT_GE(side.side, 2);
          EXPECT_TRUE(inSets.insert(edgesOf(mesh, side.element)[side.side - 2]).second);
        }
        EXPECT_EQ(nodesOf(mesh, set), nodesOfSet(mesh, set.name)) << set.name;
      }
      EXPECT_EQ(inSets, boundary);
      // Vertices - edges + faces: 1 of a disc, 0 of a ring.
      std::set<int> corners;
      int edges = static_cast<int>(boundary.size());
      for (const auto& entry : uses) corners.insert(entry.first[0]);
      edges += static_cast<int>(uses.size() - boundary.size()) / 2;
      const bool ring = findSideSet(mesh, "theta_max") < 0 && findSideSet(mesh, "angle_max") < 0 &&
                        findSideSet(mesh, "x_max") < 0 && findSideSet(mesh, "longitude_max") < 0;
      EXPECT_EQ(static_cast<int>(corners.size()) - edges + mesh.numElements(), ring ? 0 : 1);
      std::set<int> used(mesh.blocks[0].nodes.begin(), mesh.blocks[0].nodes.end());
      EXPECT_EQ(static_cast<int>(used.size()), mesh.numNodes());
    }
}

TEST(StructuredShell, MidEdgeNodesOfEightInExodusOrder) {
  ShellPlateOptions o;
  o.length = o.width = 2;
  o.topology = Topology::Shell9;
  const Mesh mesh = shellPlateMesh(o);
  const double expected[9][2] = {{0, 0}, {2, 0}, {2, 2}, {0, 2}, {1, 0}, {2, 1}, {1, 2}, {0, 1}, {1, 1}};
  for (int n = 0; n < 9; ++n)
    for (int i = 0; i < 2; ++i)
      EXPECT_EQ(mesh.coordinates[3 * mesh.blocks[0].nodes[n] + i], expected[n][i]) << n;
}

TEST(StructuredShell, SetsLieWhereTheirNamesSay) {
  ShellPlateOptions o;
  o.length = 4;
  o.width = 2;
  o.divisions = {4, 2};
  const Mesh mesh = shellPlateMesh(o);
  const auto at = [&](const std::string& name) {
    const auto nodes = nodesOfSet(mesh, name);
    EXPECT_EQ(nodes.size(), 1u) << name;
    return std::array<double, 2>{mesh.coordinates[3 * nodes[0]], mesh.coordinates[3 * nodes[0] + 1]};
  };
  EXPECT_EQ(at("x_min_y_min"), (std::array<double, 2>{0, 0}));
  EXPECT_EQ(at("x_max_y_min"), (std::array<double, 2>{4, 0}));
  EXPECT_EQ(at("x_max_y_max"), (std::array<double, 2>{4, 2}));
  EXPECT_EQ(at("x_max_y_mid"), (std::array<double, 2>{4, 1}));
  EXPECT_EQ(at("x_mid_y_mid"), (std::array<double, 2>{2, 1}));
  EXPECT_EQ(nodesOfSet(mesh, "x_max").size(), 5u);
  EXPECT_EQ(nodesOfSet(mesh, "y_min").size(), 9u);
  EXPECT_EQ(nodesOfSet(mesh, "y_mid").size(), 9u);
  EXPECT_EQ(mesh.nodeSets.size(), 19u);
  EXPECT_EQ(mesh.sideSets.size(), 6u);
  for (int d = 0; d < 4; ++d) EXPECT_EQ(mesh.sideSets[d].id, mesh.nodeSets[d].id);
  std::set<std::string> names;
  std::set<long long> ids;
  for (const NodeSet& set : mesh.nodeSets) {
    names.insert(set.name);
    ids.insert(set.id);
  }
  EXPECT_EQ(names.size(), 19u);
  EXPECT_EQ(ids.size(), 19u);

  o.divisions = {3, 1};  // SHELL8 has mid-edge nodes halfway, but none in the middle of a cell
  const Mesh odd = shellPlateMesh(o);
  EXPECT_EQ(findNodeSet(odd, "x_mid_y_mid"), -1);
  EXPECT_EQ(nodesOfSet(odd, "y_mid").size(), 4u);
}

// A force on each node by its factor has the resultant and the moment of a uniform one along the lines, also
// where elements differ in length; and does the work of one on the nodes' quadratics where there are middle
// nodes, on the linear functions where there are none.
TEST(StructuredShell, LinesHaveTheirNodesShares) {
  for (const Topology cell : shells) {
    SCOPED_TRACE(topologyName(cell));
    ShellPlateOptions o;
    o.width = 2;
    o.grading = 2;
    o.divisions = {3, 4};
    o.topology = cell;
    const Mesh mesh = shellPlateMesh(o);
    for (const char* name : {"y_lines", "y_edges"}) {
      const NodeSet& set = mesh.nodeSets.at(findNodeSet(mesh, name));
      ASSERT_EQ(set.factors.size(), set.nodes.size());
      std::map<double, std::array<double, 4>> lines;  // by x: count, integrals of 1, y, y^2
      for (std::size_t i = 0; i < set.nodes.size(); ++i) {
        const double* x = &mesh.coordinates[3 * set.nodes[i]];
        auto& line = lines[std::round(1e9 * x[0])];
        line[0] += 1;
        for (int power = 0; power < 3; ++power) line[1 + power] += set.factors[i] * std::pow(x[1], power);
      }
      const bool all = std::string(name) == "y_lines";
      EXPECT_EQ(lines.size(), all && cell != Topology::Shell4 ? 7u : 4u) << name;
      for (const auto& [x, line] : lines) {
        // Rounding of sums of a few numbers of size 1.
        EXPECT_NEAR(line[1], 1, 1e-14);
        EXPECT_NEAR(line[2], 1, 1e-14);
        if (line[0] == 9)
          EXPECT_NEAR(line[3], 4.0 / 3, 1e-14);
        else
          EXPECT_EQ(line[0], 5);
      }
    }
  }
  // Around a closed cylinder every node has the same neighbours.
  ShellCylinderOptions o = cylinder();
  o.thetaMin = 0;
  o.thetaMax = 360;
  o.divisions = {8, 1};
  const Mesh tube = shellCylinderMesh(o);
  const NodeSet& rings = tube.nodeSets.at(findNodeSet(tube, "theta_edges"));
  ASSERT_EQ(rings.nodes.size(), 32u);
  for (double factor : rings.factors)
    EXPECT_NEAR(std::min(std::abs(factor - 1.0 / 24), std::abs(factor - 1.0 / 12)), 0, 1e-15);
}

TEST(StructuredShell, SlitsStayOpenAndRingsClose) {
  ShellAnnulusOptions o = annulus();
  const Mesh slit = shellAnnulusMesh(o);
  o.slit = false;
  const Mesh ring = shellAnnulusMesh(o);
  const auto line = nodesOfSet(slit, "angle_min");
  EXPECT_EQ(slit.numNodes() - ring.numNodes(), static_cast<int>(line.size()));
  const auto other = nodesOfSet(slit, "angle_max");
  for (std::size_t i = 0; i < line.size(); ++i) {
    EXPECT_NE(line[i], other[i]);
    for (int d = 0; d < 3; ++d)
      // cos and sin of 2 pi differ from those of 0 by the rounding of pi
      EXPECT_NEAR(slit.coordinates[3 * line[i] + d], slit.coordinates[3 * other[i] + d], 1e-14);
  }
  EXPECT_EQ(findSideSet(ring, "angle_min"), -1);
  EXPECT_EQ(findNodeSet(ring, "angle_max"), -1);
  EXPECT_EQ(nodesOfSet(ring, "angle_min").size(), line.size());
  EXPECT_GE(findSideSet(ring, "outer"), 0);
}

TEST(StructuredShell, ThicknessBecomesTheBlocksAttribute) {
  const Mesh with = shellPlateMesh(plate());
  EXPECT_EQ(with.blocks[0].attributeNames, std::vector<std::string>{"thickness"});
  EXPECT_EQ(with.blocks[0].attributes, std::vector<double>(8, 0.1));
  EXPECT_TRUE(shellSphereMesh(sphere()).blocks[0].attributeNames.empty());
}

TEST(StructuredShell, BandwidthIsThatOfTheLessDividedDirection) {
  for (std::array<int, 2> divisions : {std::array<int, 2>{20, 2}, std::array<int, 2>{2, 20}}) {
    ShellPlateOptions o;
    o.divisions = divisions;
    const Mesh mesh = shellPlateMesh(o);
    int bandwidth = 0;
    const auto& nodes = mesh.blocks[0].nodes;
    for (std::size_t e = 0; e < nodes.size(); e += 8) {
      const auto [low, high] = std::minmax_element(nodes.begin() + e, nodes.begin() + e + 8);
      bandwidth = std::max(bandwidth, *high - *low);
    }
    EXPECT_EQ(bandwidth, 5 + 3 + 2);  // a row of 5 nodes, a row of 3, two nodes of the next
  }
}

// Corners at 2 (i/n)^2 of half an edge, from both ends; nodes between corners halfway.
TEST(StructuredShell, GradedPlate) {
  ShellPlateOptions options;
  options.length = 8;
  options.grading = 2;
  options.divisions = {4, 1};
  const Mesh mesh = shellPlateMesh(options);
  const int edge = findNodeSet(mesh, "y_min");
  ASSERT_GE(edge, 0);
  std::vector<double> x;
  for (int n : mesh.nodeSets[edge].nodes) x.push_back(mesh.coordinates[3 * n]);
  std::sort(x.begin(), x.end());
  const std::vector<double> expected{0, 0.5, 1, 2.5, 4, 5.5, 7, 7.5, 8};
  ASSERT_EQ(x.size(), expected.size());
  for (std::size_t i = 0; i < x.size(); ++i) EXPECT_NEAR(x[i], expected[i], 1e-14) << i;  // rounding
  options.grading = 0.5;
  EXPECT_THROW(shellPlateMesh(options), std::invalid_argument);
}

TEST(StructuredShell, TangentPlaneContinuesACylinder) {
  for (Topology cell : shells) {
    auto o = cylinder(cell);
    o.tangent = 5;
    o.tangentDivisions = 3;
    const Mesh mesh = shellCylinderMesh(o);
    EXPECT_EQ(mesh.numElements(), (4 + 3) * 6);
    const double c = std::cos(40 * pi / 180), s = std::sin(40 * pi / 180);
    double last = 0;
    for (int n = 0; n < mesh.numNodes(); ++n) {
      const double x = mesh.coordinates[3 * n], z = mesh.coordinates[3 * n + 2];
      const double along = x * c - z * s, across = x * s + z * c;  // of the plane, from its foot on the axis
      last = std::max(last, along);
      EXPECT_NEAR(along > 0 ? across : std::hypot(x, z), 10, 1e-13);  // rounding
    }
    EXPECT_NEAR(last, 5, 1e-13);
    // The plane's elements are exact; the arc's are those without it.
    EXPECT_NEAR(area(mesh, "outer"), area(shellCylinderMesh(cylinder(cell)), "outer") + 5 * 7, 1e-11);
    for (const NodeSet& set : mesh.nodeSets)
      if (set.name == "theta_max") {
        for (int n : set.nodes)
          EXPECT_NEAR(mesh.coordinates[3 * n] * c - mesh.coordinates[3 * n + 2] * s, 5, 1e-13);
      }
  }
}

TEST(StructuredShell, BadNumbersThrow) {
  const auto throws = [](auto mesher, auto options) { EXPECT_THROW(mesher(options), std::invalid_argument); };
  auto p = plate();
  p.divisions = {0, 1};
  throws(shellPlateMesh, p);
  p = plate();
  p.angle = 180;
  throws(shellPlateMesh, p);
  p = plate();
  p.thickness = -1;
  throws(shellPlateMesh, p);
  p = plate();
  p.topology = Topology::Hex8;
  throws(shellPlateMesh, p);
  p = plate();
  p.length = 0;
  throws(shellPlateMesh, p);
  auto c = cylinder();
  c.thetaMax = c.thetaMin;
  throws(shellCylinderMesh, c);
  c.thetaMax = c.thetaMin + 361;
  throws(shellCylinderMesh, c);
  c = cylinder();
  c.tangent = 1;
  throws(shellCylinderMesh, c);  // without divisions
  c.tangent = -1;
  c.tangentDivisions = 1;
  throws(shellCylinderMesh, c);
  c.tangent = 1;
  c.thetaMax = c.thetaMin + 360;
  throws(shellCylinderMesh, c);  // closed
  c = cylinder();
  c.thetaMax = c.thetaMin + 91;
  c.divisions = {1, 1};
  throws(shellCylinderMesh, c);
  auto a = annulus();
  a.outerRadius = a.innerRadius;
  throws(shellAnnulusMesh, a);
  auto s = sphere();
  s.latitudeMax = 90;
  throws(shellSphereMesh, s);
  try {
    p = plate();
    p.topology = Topology::Wedge6;
    shellPlateMesh(p);
    FAIL();
  } catch (const std::invalid_argument& e) {
    EXPECT_STREQ(e.what(), "shell plate: cells must be SHELL3, SHELL4, SHELL6, SHELL8 or SHELL9, got WEDGE6");
  }
}
