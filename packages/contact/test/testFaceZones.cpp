// Contact integrated over zones of lines across the faces of solids: closed forms, tangents, series of all
// orders.
#include <gtest/gtest.h>

#include <Sacado.hpp>
#include <algorithm>
#include <cmath>

#include "atrapos/contact/Cylinder.hpp"
#include "atrapos/contact/MovingTool.hpp"
#include "atrapos/contact/Sphere.hpp"
#include "support/ContactModel.hpp"
#include "support/Derivatives.hpp"
#include "support/LineOnCircle.hpp"

using namespace atrapos;
using namespace atrapos::contact;
using namespace atrapos::contact::test;

namespace {

constexpr double ballRadius = 2;

const std::vector<fem::Topology>& allCells() {
  using fem::Topology;
  static const std::vector<Topology> cells{Topology::Hex8, Topology::Hex20, Topology::Hex27, Topology::Tet4,
                                           Topology::Tet10};
  return cells;
}
bool hasTriangles(fem::Topology cell) { return cell == fem::Topology::Tet4 || cell == fem::Topology::Tet10; }

/// Adds contact of the lower faces with a tool.
fem::LineSet addFaceZones(fem::FeModel& model, const fem::Mesh& mesh, const RigidTool& tool,
                          const Overclosure& law, int degree = 4) {
  auto faces = fem::faceLines(mesh, {}, fem::test::sideSet(mesh, "z_min"), 0, degree, [&](const double* x) {
    const double place[4] = {x[0], x[1], x[2], 0};
    return tool.project(place).gap;
  });
  model.terms.push_back(tool.zones(law, faces.at(0).lines));
  return faces[0].lines;
}

}  // namespace

// A roll below a plate, along either side of its faces: each line across it is the line on a circle.
TEST(FaceZones, ForceOfAPlateOnARoll) {
  for (const auto cell : allCells())
    for (const bool turned : {false, true})
      for (const int m : {1, 2})
        for (const double depth : {1e-3, 0.05, 0.2}) {
          SCOPED_TRACE(fem::topologyName(cell));
          const auto mesh = turned ? fem::test::box(cell, {2, 4, 1}, {3, 4, 1})
                                   : fem::test::box(cell, {4, 2, 1}, {4, 3, 1});
          const double z = depth - ballRadius;
          const auto roll = turned ? rigidTool(Cylinder{{0, 1.4, z}, {1, 0, 0}, ballRadius})
                                   : rigidTool(Cylinder{{1.4, 0, z}, {0, 1, 0}, ballRadius});
          fem::FeModel model = solidModel(mesh, 10, 0.3);
          const auto lines = addFaceZones(model, mesh, *roll, {7, m});
          // Six lines across, which go on from face to face.
          const int pieces = hasTriangles(cell) ? 8 : 4;
          EXPECT_EQ(lines.numLines(), 6 * pieces);
          EXPECT_EQ(lines.numEnds(), 6 * (pieces + 1));
          fem::FeProblem problem(std::move(model));
          const Numbers none(3 * static_cast<std::size_t>(mesh.numNodes()), 0.0);
          const auto sum =
              resultant(problem.forces(problem.term(1), {fem::test::vectorOf(problem, none), 0}));
          const double exact = 3 * lineOnCircle(depth, ballRadius, 7, m);
          EXPECT_NEAR(-sum[2], exact, 1e-11 * exact) << depth << ' ' << m;
        }
}

// A disc of contact: lines at the distance s leave of (a^2 - y^2)^(3/2) at its rim what goes like
// (s/a)^(5/2), to and fro. The pressure alpha (R - rho) over the disc, rho^2 = r^2 + d^2, has a closed form.
TEST(FaceZones, ForceOfAPlateOnABall) {
  const double depth = 0.05, d = ballRadius - depth, alpha = 7, rim = std::sqrt(ballRadius * ballRadius - d * d);
  // Integral of (R - rho) d/rho 2 pi r dr, rho from d to R.
  const double exact = alpha * std::acos(-1.0) * d * depth * depth;
  for (const auto cell : {fem::Topology::Hex8, fem::Topology::Tet4})
    for (const int divisions : {4, 8, 16, 32}) {
      const auto mesh = fem::test::box(cell, {divisions, divisions, 1}, {2, 2, 1});
      fem::FeModel model = solidModel(mesh, 10, 0.3);
      addFaceZones(model, mesh, *rigidTool(Sphere{{1.03, 0.97, -d}, ballRadius}), {alpha, 1});
      fem::FeProblem problem(std::move(model));
      const Numbers none(3 * static_cast<std::size_t>(mesh.numNodes()), 0.0);
      const auto sum = resultant(problem.forces(problem.term(1), {fem::test::vectorOf(problem, none), 0}));
      EXPECT_NEAR(-sum[2] / exact, 1, 0.3 * std::pow(2.0 / (3 * divisions) / rim, 2.5)) << divisions;
    }
}

TEST(FaceZones, TangentIsTheSymmetricDerivativeOfTheForce) {
  for (const auto cell : allCells()) {
    SCOPED_TRACE(fem::topologyName(cell));
    Motion motion;
    motion.shift[1][2] = 0.3;
    motion.shift[1][0] = 0.2;
    const auto mesh = fem::test::box(cell, {2, 2, 1}, {2, 2, 1});
    fem::FeModel model = solidModel(mesh, 10, 0.3);
    addFaceZones(model, mesh, *rigidTool(Sphere{{0.9, 1.2, -ballRadius + 0.1}, ballRadius}, motion), {5, 1});
    fem::FeProblem problem(std::move(model));
    const Numbers u = fem::test::randomNumbers(3 * mesh.numNodes(), 0.02, 5);
    const double lambda = 0.1;
    ASSERT_GT(fem::test::largest(problem.forces(problem.term(1), {fem::test::vectorOf(problem, u), lambda})),
              1e-3);
    const auto K = fem::test::tangent(problem, u, lambda);
    expectSymmetric(K);
    for (const double rate : {0.0, 1.0})
      expectDerivative(problem, K, u, lambda, fem::test::randomNumbers(u.size(), 1, 6), rate, 1e-3);
  }
}

namespace {

/// N_a of the eight-node quadrilateral, corners counter-clockwise, then the middles of the sides.
template <class T>
void shape(const T& xi, double eta, T* N) {
  constexpr double corner[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  for (int a = 0; a < 4; ++a) {
    const double s = corner[a][0], t = corner[a][1];
    N[a] = 0.25 * (1.0 + s * xi) * (1.0 + t * eta) * (s * xi + (t * eta - 1.0));
  }
  N[4] = 0.5 * (1.0 - xi * xi) * (1.0 - eta);
  N[5] = 0.5 * (1.0 + xi) * (1.0 - eta * eta);
  N[6] = 0.5 * (1.0 - xi * xi) * (1.0 + eta);
  N[7] = 0.5 * (1.0 - xi) * (1.0 - eta * eta);
}

/// The force of the zones of one square face over a ball, X and u [node][3], written out for any scalar;
/// limits by secants from the ends of a zone that lies inside.
template <class T>
void forceOfFace(const double (*X)[3], double area, const double* center, double alpha, const T* u, T* F) {
  using std::sqrt;
  const auto place = [&](const T& xi, double eta, T* N, T* x) {
    shape(xi, eta, N);
    for (int i = 0; i < 3; ++i) {
      x[i] = T(-center[i]);
      for (int a = 0; a < 8; ++a) x[i] = x[i] + N[a] * (X[a][i] + u[3 * a + i]);
    }
    const T rho = sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
    for (int i = 0; i < 3; ++i) x[i] = x[i] / rho;
    return T(rho - ballRadius);
  };
  const fem::Tabulation across = fem::tabulateFace(fem::Face::Line2, 4),
                        gauss = fem::tabulateFace(fem::Face::Line2, 19);
  for (int i = 0; i < 24; ++i) F[i] = T(0.0);
  T N[8], n[3];
  for (int j = 0; j < across.numPoints; ++j) {
    const double eta = across.points[j];
    T limit[2];
    for (int r = 0; r < 2; ++r) {
      T a = T(r == 0 ? -0.95 : 0.95), b = T(r == 0 ? -0.7 : 0.7);
      T ha = place(a, eta, N, n), hb = place(b, eta, N, n);
      for (int i = 0; i < 12; ++i) {
        const T slope = (hb - ha) / (b - a);
        a = b;
        ha = hb;
        b = b - hb / slope;
        hb = place(b, eta, N, n);
        if (hb == ha) break;
      }
      limit[r] = b;
    }
    for (int q = 0; q < gauss.numPoints; ++q) {
      const T width = limit[1] - limit[0], xi = limit[0] + 0.5 * (1 + gauss.points[q]) * width;
      const T h = place(xi, eta, N, n);
      const T share = alpha * h * 0.5 * gauss.weights[q] * width * (area / 4 * across.weights[j]);
      for (int a = 0; a < 8; ++a)
        for (int i = 0; i < 3; ++i) F[3 * a + i] = F[3 * a + i] + N[a] * share * n[i];
    }
  }
}

}  // namespace

TEST(FaceZones, TangentIsThatOfFadTypesWithLimitsThatMove) {
  using Fad = Sacado::Fad::SFad<double, 24>;
  const fem::Mesh mesh = fem::test::box(fem::Topology::Hex20, {1, 1, 1});
  const double center[3] = {0.52, 0.5, -ballRadius + 0.045};
  fem::FeModel model;
  model.dofs = fem::DofMap::displacements(mesh.numNodes());
  const auto lines =
      addFaceZones(model, mesh, *rigidTool(Sphere{{center[0], center[1], center[2]}, ballRadius}), {7, 1});
  fem::FeProblem problem(std::move(model));
  // Lines along the first side of the face, or along the second: then the face is looked at from there.
  const double* from = &mesh.coordinates[3 * lines.nodes[0]];
  const double* to = &mesh.coordinates[3 * lines.nodes[1]];
  double cosine = 0;
  for (int i = 0; i < 3; ++i) cosine += lines.coefficients[3 + i] * (to[i] - from[i]);
  const bool along = std::abs(cosine) > 0.1;
  int nodes[8];
  for (int a = 0; a < 8; ++a) nodes[a] = lines.nodes[along ? a : a / 4 * 4 + (a + 1) % 4];
  double X[8][3], own[24], F[24];
  Numbers u(3 * static_cast<std::size_t>(mesh.numNodes()), 0.0);
  const Numbers moves = fem::test::randomNumbers(24, 0.004, 3);
  for (int a = 0; a < 8; ++a)
    for (int i = 0; i < 3; ++i) {
      X[a][i] = mesh.coordinates[3 * nodes[a] + i];
      u[3 * nodes[a] + i] = own[3 * a + i] = moves[3 * a + i];
    }
  forceOfFace<double>(X, 1, center, 7, own, F);
  Fad x[24], y[24];
  for (int i = 0; i < 24; ++i) x[i] = Fad(24, i, own[i]);
  forceOfFace<Fad>(X, 1, center, 7, x, y);
  const Numbers f = problem.forces(problem.term(0), {fem::test::vectorOf(problem, u), 0});
  const auto K = fem::test::tangent(problem, u, 0);
  double largest = 0, stiffest = 0;
  for (int i = 0; i < 24; ++i) {
    largest = std::max(largest, std::abs(F[i]));
    for (int j = 0; j < 24; ++j) stiffest = std::max(stiffest, std::abs(y[i].dx(j)));
  }
  ASSERT_GT(largest, 1e-3);
  for (int a = 0; a < 24; ++a) {
    const int row = 3 * nodes[a / 3] + a % 3;
    EXPECT_NEAR(f[row], F[a], 1e-12 * largest);
    // The part of the limits, which the tangent leaves out, is the error of Gauss' rule.
    for (int b = 0; b < 24; ++b)
      EXPECT_NEAR(K.at(row, 3 * nodes[b / 3] + b % 3), y[a].dx(b), 1e-11 * stiffest);
  }
}

// Two cells in a row, pressed onto a ball: zones inside lines and over the border of two.
TEST(FaceZones, SeriesOfAllOrders) {
  for (const auto cell : allCells()) {
    SCOPED_TRACE(fem::topologyName(cell));
    const auto mesh = fem::test::box(cell, {2, 2, 2}, {2, 2, 1});
    fem::FeModel model = solidModel(mesh, 10, 0.3);
    for (const int n : fem::test::nodesOfSet(mesh, "z_max")) {
      model.prescribe(n, 0, 0, 0.1);
      model.prescribe(n, 1, 0, 0);
      model.prescribe(n, 2, 0, -1);
    }
    addFaceZones(model, mesh, *rigidTool(Sphere{{0.9, 1.2, -ballRadius}, ballRadius}), {200, 1});
    fem::FeProblem problem(std::move(model));
    Numbers u;
    const double lambda = 0.04;
    for (int n = 0; n < mesh.numNodes(); ++n) u.insert(u.end(), {0.1 * lambda, 0, -lambda});
    u = fem::test::equilibrium(problem, lambda, u, 1e-13).u;
    const path::State start = problem.settled({fem::test::vectorOf(problem, u), lambda});
    const auto solver = linear::makeTangentSolver();
    path::Calls calls(problem, *solver);
    for (const int order : {2, 5, 8, 11}) {
      if (order == 11 && (cell == fem::Topology::Hex8 || hasTriangles(cell)))
        continue;  // a zone reaches an end before that shows
      path::SeriesRequest request;
      request.order = order;
      const auto series = path::buildSeries(calls, start, request);
      expectOrder(problem, series, order, order < 8 ? 1e-6 : 1e-8);
    }
  }
}
