// Lines across faces: that they are the faces' own points, go on from face to face, and turn to where the gap
// changes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "atrapos/fem/LineSet.hpp"
#include "atrapos/fem/ReferenceCell.hpp"
#include "atrapos/fem/ShellFaces.hpp"
#include "atrapos/fem/StructuredShell.hpp"
#include "support/Meshes.hpp"

using namespace atrapos::fem;
using namespace atrapos::fem::test;

namespace {

double alongX(const double* x) { return 3 * x[0] + 0.1 * x[1] * x[1]; }
double alongY(const double* x) { return x[1] * x[1] - 0.2 * x[0]; }

/// The largest difference between what lines say of their shown points and what the points say: places, shape
/// values and areas.
double difference(const FaceLines& faces) {
  const LineSet& lines = faces.lines;
  const PointSet& points = faces.points;
  const int K = lines.degree + 1, N = lines.nodesPerLine, Q = static_cast<int>(lines.shown.size());
  EXPECT_EQ(points.numPoints(), lines.numLines() * Q);
  const Tabulation gauss = tabulateFace(Face::Line2, 2 * Q - 1);
  double worst = 0;
  for (int e = 0; e < lines.numLines(); ++e)
    for (int q = 0; q < Q; ++q) {
      const std::size_t point = static_cast<std::size_t>(e) * Q + q;
      const double xi = lines.shown[q];
      double X[3] = {0, 0, 0}, along[3] = {0, 0, 0}, A[3] = {0, 0, 0};
      for (int k = 0; k < K; ++k)
        for (int i = 0; i < 3; ++i) {
          const double c = lines.coefficients[(e * K + k) * 3 + i];
          X[i] += c * std::pow(xi, k);
          if (k > 0) along[i] += k * c * std::pow(xi, k - 1);
          A[i] += lines.across[(e * K + k) * 3 + i] * std::pow(xi, k);
        }
      for (int i = 0; i < 3; ++i) worst = std::max(worst, std::abs(X[i] - points.positions[3 * point + i]));
      for (int n = 0; n < N; ++n) {
        double value = 0;
        for (int k = 0; k < K; ++k) value += lines.shape[(e * N + n) * K + k] * std::pow(xi, k);
        worst = std::max(worst, std::abs(value - points.shape[point * N + n]));
        EXPECT_EQ(lines.nodes[e * N + n], points.nodes[point / points.pointsPerEntity * N + n]);
      }
      const double area = std::hypot(along[1] * A[2] - along[2] * A[1], along[2] * A[0] - along[0] * A[2],
                                     along[0] * A[1] - along[1] * A[0]);
      worst = std::max(worst, std::abs(gauss.weights[q] * area - lines.weights[point]));
    }
  return worst;
}

/// Whether each line that goes on begins where another ends, or ends there.
void expectEndsToMeet(const LineSet& lines) {
  const int K = lines.degree + 1;
  std::vector<std::vector<double>> places(lines.numEnds());
  for (int e = 0; e < lines.numLines(); ++e)
    for (int end = 0; end < 2; ++end)
      for (int i = 0; i < 3; ++i) {
        double x = 0;
        for (int k = 0; k < K; ++k)
          x += lines.coefficients[(e * K + k) * 3 + i] * (end == 0 && k % 2 == 1 ? -1 : 1);
        places[lines.ends[2 * e + end]].push_back(x);
      }
  for (const auto& own : places)
    for (std::size_t i = 3; i < own.size(); ++i) EXPECT_NEAR(own[i], own[i % 3], 1e-14);
}

/// Lines on the top of a distorted box of 3 x 3 cells along the sides of its quadrilaterals, for gaps that
/// change along either and rules of several degrees: this many faces in a row, `more` degrees across.
void expectLinesOnABox(Topology cell, double amount, int inARow, int more) {
  SCOPED_TRACE(topologyName(cell));
  const Mesh mesh = distorted(box(cell), amount);
  for (const auto& gap : {alongX, alongY})
    for (const int degree : {1, 4, 8}) {
      const auto faces = faceLines(mesh, {}, sideSet(mesh, "z_max"), 0, degree, gap).at(0);
      const int rows = 3 * ((degree + more) / 2 + 1);
      EXPECT_EQ(faces.lines.numLines(), inARow * rows);
      EXPECT_EQ(faces.lines.numEnds(), (inARow + 1) * rows);
      EXPECT_LT(difference(faces), 1e-14);
      expectEndsToMeet(faces.lines);
      // Along where the gap changes: so many in a row of the box's unit length.
      const double* c = &faces.lines.coefficients[3];
      EXPECT_GT(std::abs(c[gap == alongX ? 0 : 1]), 2 * std::abs(c[gap == alongX ? 1 : 0]));
    }
}

}  // namespace

TEST(FaceLines, AreThePointsOfTheirFaces) {
  for (const auto cell : {Topology::Hex8, Topology::Hex20, Topology::Hex27})
    expectLinesOnABox(cell, 0.05, 3, 0);
}

TEST(FaceLines, OfShellsAtTheirFaces) {
  ShellCylinderOptions roof;
  roof.radius = 2;
  roof.thetaMin = -40;
  roof.thetaMax = 40;
  roof.length = 3;
  roof.divisions = {4, 2};
  const Mesh mesh = shellCylinderMesh(roof);
  const ShellGeometry shells = shellGeometry(mesh, {{0, 0.1}});
  SideSet top{"top", 1, {}};
  for (int e = 0; e < mesh.numElements(); ++e) top.sides.push_back({e, 0});
  for (const double zeta : {-1.0, 0.0, 1.0}) {
    const auto faces = faceLines(mesh, shells, top, zeta, 4, alongX).at(0);
    EXPECT_LT(difference(faces), 1e-14);
    expectEndsToMeet(faces.lines);
    EXPECT_EQ(faces.lines.numEnds(), 5 * 2 * 3);
    // In another order the points of shellFacePoints.
    const PointSet points = shellFacePoints(mesh, shells, top, zeta, 4).at(0);
    double sums[2] = {0, 0};
    for (std::size_t p = 0; p < points.weights.size(); ++p) {
      sums[0] += points.weights[p] * points.positions[3 * p];
      sums[1] += faces.points.weights[p] * faces.points.positions[3 * p];
    }
    EXPECT_NEAR(sums[0], sums[1], 1e-13);
  }
}

// Cells of another box, whose local axes lie the other way round, hang together with these.
TEST(FaceLines, GoOnWhereNeighboursAreTurned) {
  const Mesh first = box(Topology::Hex20, {2, 2, 1}, {2, 2, 1});
  Mesh second = box(Topology::Hex20, {2, 3, 1}, {2, 3, 1});
  for (int n = 0; n < second.numNodes(); ++n) {  // a quarter turn about z, then beside the first
    double* x = &second.coordinates[3 * n];
    const double old[2] = {x[0], x[1]};
    x[0] = 5 - old[1];
    x[1] = old[0];
  }
  Mesh both = glued({first, second});
  SideSet tops{"tops", 99, {}};
  int before = 0;
  for (const Mesh* mesh : {&first, static_cast<const Mesh*>(&second)}) {
    for (const Side& side : sideSet(*mesh, "z_max").sides)
      tops.sides.push_back({before + side.element, side.side});
    before += mesh->numElements();
  }
  for (const auto& gap : {alongX, alongY}) {
    const auto lines = faceLines(both, {}, tops, 0, 4, gap).at(0).lines;
    EXPECT_EQ(lines.numLines(), 10 * 3);
    EXPECT_EQ(lines.numEnds(), gap == alongX ? 6 * 2 * 3 : 3 * 5 * 3);
    expectEndsToMeet(lines);
  }
}

// Triangles that halve quadrilaterals: lines along the sides of these, through both halves.
TEST(FaceLines, OfTriangles) {
  for (const auto cell : {Topology::Tet4, Topology::Tet10}) expectLinesOnABox(cell, 0.02, 6, 1);
}

// Over a plane floor nothing chooses but the edges' lengths: the diagonals.
TEST(FaceLines, OfTrianglesOverNothingThatChanges) {
  const Mesh mesh = box(Topology::Tet10);
  const auto lines =
      faceLines(mesh, {}, sideSet(mesh, "z_max"), 0, 4, [](const double* x) { return x[2]; }).at(0).lines;
  const double* c = &lines.coefficients[3];
  EXPECT_NEAR(std::abs(c[0]), std::abs(c[1]), 1e-14);
  expectEndsToMeet(lines);
}

// The rule is exact to the degree that it is asked for.
TEST(FaceLines, IntegratePolynomialsOverTriangles) {
  const Mesh mesh = box(Topology::Tet4, {2, 3, 1}, {1, 1, 1});
  for (const int degree : {1, 2, 3, 4, 6}) {
    const PointSet points = faceLines(mesh, {}, sideSet(mesh, "z_max"), 0, degree, alongX).at(0).points;
    for (int i = 0; i <= degree; ++i) {
      double sum = 0;
      for (std::size_t p = 0; p < points.weights.size(); ++p)
        sum += points.weights[p] * std::pow(points.positions[3 * p], i) *
               std::pow(points.positions[3 * p + 1], degree - i);
      EXPECT_NEAR(sum, 1.0 / ((i + 1) * (degree - i + 1)), 1e-14) << degree << ' ' << i;
    }
  }
}

// Quadrilaterals and triangles beside each other are two sets of lines.
TEST(FaceLines, OfBothShapes) {
  const Mesh first = box(Topology::Hex20, {2, 2, 1}, {2, 2, 1});
  Mesh second = box(Topology::Tet10, {2, 2, 1}, {2, 2, 1});
  for (int n = 0; n < second.numNodes(); ++n) second.coordinates[3 * n] += 2;
  const Mesh both = glued({first, second});
  SideSet tops{"tops", 99, sideSet(first, "z_max").sides};
  for (const Side& side : sideSet(second, "z_max").sides)
    tops.sides.push_back({first.numElements() + side.element, side.side});
  const auto faces = faceLines(both, {}, tops, 0, 4, alongX);
  ASSERT_EQ(faces.size(), 2);
  double area = 0;
  for (const FaceLines& own : faces) {
    EXPECT_LT(difference(own), 1e-14);
    for (const double weight : own.points.weights) area += weight;
  }
  EXPECT_NEAR(area, 8, 1e-13);
}
