// Contact integrated over its zones: closed forms, tangents, series of all orders, next to births and borders
// too.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "atrapos/contact/Cylinder.hpp"
#include "atrapos/contact/MovingTool.hpp"
#include "atrapos/contact/Plane.hpp"
#include "support/ContactModel.hpp"
#include "support/Derivatives.hpp"
#include "support/LineOnCircle.hpp"
#include "support/PlaneContact.hpp"
#include "support/ZoneBodies.hpp"

using namespace atrapos;
using namespace atrapos::contact;
using namespace atrapos::contact::test;

namespace {

constexpr double kRadius = 2;

/// A cylinder below the body whose top is at (x, y).
std::unique_ptr<RigidTool> roll(double x, double y) {
  return rigidTool(Cylinder{{x, y - kRadius, 0}, {0, 0, 1}, kRadius});
}

}  // namespace

// Zones inside an edge, over the border of two, and over three; straight edges, so that the line is one.
TEST(Zones, ForceOfALineOnACircle) {
  for (const auto cell : {fem::Topology::Quad4, fem::Topology::Quad8, fem::Topology::Tri6})
    for (const int m : {1, 2, 3})
      for (const double center : {1.4, 2.0, 2.15})
        for (const double depth : {1e-6, 1e-3, 0.05, 0.2}) {
          if (center == 2.0 && depth < 1e-5) continue;  // so near to its border an end keeps its condition
          solid::PlaneSection section;
          section.thickness = 3;
          Row row(cell, *roll(center, depth), {7, m}, section);
          const double exact = 3 * lineOnCircle(depth, kRadius, 7, m);
          // Ten Gauss points: zones are up to 0.9 wide, the roll's centre is 1.8 away. At the depth of 1e-6
          // the gap is known to 1e-16/1e-6.
          EXPECT_NEAR(row.forceUp(Numbers(row.dofs(), 0.0)), exact, (depth < 1e-5 ? 1e-9 : 1e-11) * exact)
              << center << ' ' << depth << ' ' << m;
        }
}

// The tangent of the points is that of the force: limits have no part in it.
TEST(Zones, TangentIsTheSymmetricDerivativeOfTheForce) {
  for (const auto cell : planeCells())
    for (const auto kind : {solid::PlaneSection::Kind::strain, solid::PlaneSection::Kind::axisymmetric}) {
      SCOPED_TRACE(fem::topologyName(cell));
      MovingTool<Cylinder> tool;
      tool.motion.shift[1][1] = 0.3;
      tool.motion.angle[1] = 0.2;
      tool.motion.pivot[0] = 1;
      solid::PlaneSection section;
      section.kind = kind;
      fem::Mesh mesh = planeMesh(cell, {3, 1}, {3, 1}, {0.5, 0});
      fem::FeModel model = planeModel(mesh, section, 10, 0.3);
      const auto moving = rigidTool(Cylinder{{2.1, -kRadius + 0.1, 0}, {0, 0, 1}, kRadius}, tool.motion);
      addZones(model, mesh, section, *moving, {5, 1});
      fem::FeProblem problem(std::move(model));
      const Numbers u = fem::test::randomNumbers(2 * mesh.numNodes(), 0.02, 5);
      const double lambda = 0.1;
      ASSERT_GT(
          fem::test::largest(problem.forces(problem.term(1), {fem::test::vectorOf(problem, u), lambda})),
          1e-3);
      const auto K = fem::test::tangent(problem, u, lambda);
      expectSymmetric(K);
      for (unsigned seed = 6; seed < 8; ++seed)
        for (const double rate : {0.0, 1.0})
          expectDerivative(problem, K, u, lambda, fem::test::randomNumbers(u.size(), 1, seed), rate, 1e-3);
    }
}

namespace {

/// On a roll, and where its lines are over it.
struct OnRoll : Pressed {
  OnRoll(fem::Topology cell, double center, int exponent = 1, const std::optional<Motion>& motion = {})
      : Pressed(cell, rigidTool(Cylinder{{center, -kRadius, 0}, {0, 0, 1}, kRadius}, motion), exponent) {}

  double gap(const Numbers& u, int line, double xi, double lambda) const {
    double x[4] = {0, 0, 0, lambda};
    const int N = lines.nodesPerLine;
    const double s[3] = {N == 2 ? (1 - xi) / 2 : xi * (xi - 1) / 2, N == 2 ? (1 + xi) / 2 : xi * (xi + 1) / 2,
                         1 - xi * xi};
    for (int n = 0; n < N; ++n)
      for (int i = 0; i < 2; ++i) {
        const int node = lines.nodes[line * N + n];
        x[i] += s[n] * (mesh.coordinates[3 * node + i] + u[2 * node + i]);
      }
    return tool->project(x).gap;
  }
  /// The least gap of a line and where it is, by ternary search in [-1.25, 1.25].
  std::pair<double, double> least(const Numbers& u, int line, double lambda) const {
    double a = -1.25, b = 1.25;
    for (int i = 0; i < 100; ++i) {
      const double c = a + (b - a) / 3, d = b - (b - a) / 3;
      (gap(u, line, c, lambda) < gap(u, line, d, lambda) ? b : a) =
          gap(u, line, c, lambda) < gap(u, line, d, lambda) ? d : c;
    }
    return {a, gap(u, line, a, lambda)};
  }
  int inContact(double lambda) {
    const auto conditions = problem.conditionsAt(stateAt(lambda));
    return static_cast<int>(std::count(conditions.begin(), conditions.end(), 1));
  }
};

/// Series of several orders at an equilibrium, and along them the event functions: gaps at ends of lines and
/// the least gaps of lines, to the residual's power of a.
void expectSeries(OnRoll& body, double lambda, std::vector<int> orders = {2, 5, 8, 13}) {
  const path::State start = body.stateAt(lambda);
  const auto solver = linear::makeTangentSolver();
  path::Calls calls(body.problem, *solver);
  for (const int order : orders) {
    path::SeriesRequest request;
    request.order = order;
    const auto series = path::buildSeries(calls, start, request);
    // Half as far as usual from where the zone would vanish.
    const double a = expectOrder(body.problem, series, order, order == 8 ? 1e-8 : order > 8 ? 1e-7 : 1e-6);
    auto v = fem::test::zeroVector(body.problem);
    const auto conditions = fem::zoneConditions(body.lines);
    const int ends = static_cast<int>(conditions.size()) - 3 * body.lines.numLines();
    double errors[2] = {0, 0};
    for (int half = 0; half < 2; ++half) {
      const double there = a / (1 + half), lambdaThere = series.evaluate(there, *v);
      const Numbers w = fem::FeProblem::values(*v);
      for (int i = 0; i < body.problem.eventCount(); ++i) {
        const double g = series.scalar(series.eventCoefficients(i))(there);
        if (series.eventCoefficients(i)[0] == 1) continue;  // nothing to tell
        double h = 0;
        if (i < ends) {
          const double* X = &body.mesh.coordinates[3 * conditions[i].node];
          const double x[4] = {X[0] + w[2 * conditions[i].node], X[1] + w[2 * conditions[i].node + 1], 0,
                               lambdaThere};
          h = body.tool->project(x).gap;
        } else {
          const int line = (i - ends) / 3;
          if ((i - ends) % 3 != 0) continue;
          const double gap = body.least(w, line, lambdaThere).second;
          h = gap + (gap < 0 ? 0.5e-7 : 1e-7);  // the lines' length is 1; a zone ends at half its depth
        }
        errors[half] = std::max(errors[half], std::abs(std::abs(g) - std::abs(h)));
      }
    }
    // What is beyond the order: a^(order + 1), until the ternary search's 1e-16 or so.
    if (errors[0] > 1e-12) {
      EXPECT_LT(errors[1], 2 * errors[0] / std::pow(2, order)) << order;
    }
    EXPECT_LT(errors[0], 1e-4);
  }
}

}  // namespace

TEST(Zones, SeriesOfAllOrders) {
  for (const auto cell : planeCells()) {
    SCOPED_TRACE(fem::topologyName(cell));
    OnRoll body(cell, 1.4);
    expectSeries(body, 0.02);
  }
  for (const int exponent : {2, 3}) {
    OnRoll body(fem::Topology::Quad8, 1.4, exponent);
    expectSeries(body, 0.05);
  }
}

TEST(Zones, SeriesOverAMovingTool) {
  Motion motion;
  motion.shift[1][0] = 0.8;
  motion.angle[1] = 0.5;
  motion.pivot[0] = 1;
  OnRoll body(fem::Topology::Quad8, 1.35, 1, motion);
  expectSeries(body, 0.02);
}

namespace {

/// Where f of the equilibrium at lambda changes its sign, by bisection.
template <class F>
double lambdaWhere(OnRoll& body, double low, double high, const F& f) {
  for (int i = 0; i < 24; ++i) {
    const double middle = 0.5 * (low + high);
    (f(body.at(middle), middle) > 0 ? low : high) = middle;
  }
  return low;
}

}  // namespace

// Behind a birth the series reaches as far as the zone is wide, but its orders are right; depths from some 10
// of the least that counts on, on lines 1 long.
TEST(Zones, SeriesNextToABirth) {
  for (const double depth : {1e-3, 1e-5, 2e-6}) {
    OnRoll body(fem::Topology::Quad8, 1.4);
    const double lambda = lambdaWhere(
        body, 0, 0.02, [&](const Numbers& u, double at) { return body.least(u, 1, at).second + depth; });
    expectSeries(body, lambda, {2, 5});
    EXPECT_EQ(body.inContact(lambda), 1);  // the minimum of one line
  }
}

// And next to the end of a line, that is out of contact by this gap, or in.
TEST(Zones, SeriesNextToTheEndOfALine) {
  for (const double gap : {1e-3, 2e-4, -2e-4, -1e-3}) {
    SCOPED_TRACE(gap);
    OnRoll body(fem::Topology::Quad8, 1.9);
    const double lambda =
        lambdaWhere(body, 0, 0.05, [&](const Numbers& u, double at) { return body.gap(u, 1, 1, at) - gap; });
    expectSeries(body, lambda, {2, 5, 8});
    EXPECT_GE(body.inContact(lambda), gap > 0 ? 1 : 2);
  }
}

namespace {

/// The force of a zone of one quadratic line on its nodes, u [node][2], written out for any scalar: over a
/// circle, its limits by Newton's method from their values.
template <class T>
void forceOfLine(const std::vector<double>& X, const double* center, double alpha, int m, const double* start,
                 const T* u, T* F) {
  using std::sqrt;
  T c[3][2];
  for (int i = 0; i < 2; ++i) {
    T x[3];
    for (int n = 0; n < 3; ++n) x[n] = X[2 * n + i] + u[2 * n + i];
    c[0][i] = x[2] - center[i];
    c[1][i] = 0.5 * (x[1] - x[0]);
    c[2][i] = 0.5 * (x[0] + x[1]) - x[2];
  }
  const auto place = [&](const T& xi, int i) -> T { return c[0][i] + xi * (c[1][i] + xi * c[2][i]); };
  const auto along = [&](const T& xi, int i) -> T { return c[1][i] + 2.0 * xi * c[2][i]; };
  T limit[2];
  for (int r = 0; r < 2; ++r) {
    limit[r] = T(start[r]);
    for (int i = 0; i < 8; ++i) {
      const T x = place(limit[r], 0), y = place(limit[r], 1), rho = sqrt(x * x + y * y);
      const T slope = (x * along(limit[r], 0) + y * along(limit[r], 1)) / rho;
      limit[r] = limit[r] - (rho - kRadius) / slope;
    }
  }
  const fem::Tabulation gauss = fem::tabulateFace(fem::Face::Line2, 19);
  for (int i = 0; i < 6; ++i) F[i] = T(0.0);
  for (int q = 0; q < gauss.numPoints; ++q) {
    const T width = limit[1] - limit[0], xi = limit[0] + 0.5 * (1 + gauss.points[q]) * width;
    const T x = place(xi, 0), y = place(xi, 1), rho = sqrt(x * x + y * y);
    T p = T(alpha);
    for (int i = 0; i < m; ++i) p = p * (kRadius - rho);
    T dX[2];
    for (int i = 0; i < 2; ++i)
      dX[i] = 0.5 * (X[2 + i] - X[i]) + 2.0 * xi * (0.5 * (X[i] + X[2 + i]) - X[4 + i]);
    const T weight = 0.5 * gauss.weights[q] * width * sqrt(dX[0] * dX[0] + dX[1] * dX[1]);
    const T shape[3] = {0.5 * xi * (xi - 1.0), 0.5 * xi * (xi + 1.0), 1.0 - xi * xi};
    for (int n = 0; n < 3; ++n) {
      F[2 * n] = F[2 * n] - shape[n] * p * weight * x / rho;
      F[2 * n + 1] = F[2 * n + 1] - shape[n] * p * weight * y / rho;
    }
  }
}

}  // namespace

// Forces and tangents by Fad types, which know that limits move, on a curved edge.
TEST(Zones, TangentIsThatOfFadTypesWithLimitsThatMove) {
  using Fad = Sacado::Fad::SFad<double, 6>;
  for (const int m : {1, 2, 3}) {
    fem::Mesh mesh = planeMesh(fem::Topology::Quad8, {1, 1}, {1, 1});
    const double center[2] = {0.45, -kRadius + 0.02};
    const auto tool = rigidTool(Cylinder{{center[0], center[1], 0}, {0, 0, 1}, kRadius});
    const auto edges = solid::planeEdgeLines(mesh, fem::test::sideSet(mesh, "y_min"), {}, 4).at(0);
    mesh.coordinates[3 * edges.nodes[2] + 1] -= 0.01;  // its middle
    fem::FeModel model;
    model.dofs = fem::DofMap::displacements(mesh.numNodes(), 2);
    const fem::LineSet line = addZones(model, mesh, {}, *tool, {7, m});
    fem::FeProblem problem(std::move(model));
    Numbers u(2 * mesh.numNodes(), 0.0);
    const Numbers moves = fem::test::randomNumbers(6, 0.01, 3);
    double own[6], F[6];
    for (int n = 0; n < 3; ++n)
      for (int i = 0; i < 2; ++i) u[2 * line.nodes[n] + i] = own[2 * n + i] = moves[2 * n + i];
    const double start[2] = {-0.9, 0.7};
    std::vector<double> X;
    for (const int node : line.nodes)
      X.insert(X.end(), {mesh.coordinates[3 * node], mesh.coordinates[3 * node + 1]});
    forceOfLine<double>(X, center, 7, m, start, own, F);
    Fad x[6], y[6];
    for (int i = 0; i < 6; ++i) x[i] = Fad(6, i, own[i]);
    forceOfLine<Fad>(X, center, 7, m, start, x, y);
    const Numbers f = problem.forces(problem.term(0), {fem::test::vectorOf(problem, u), 0});
    const auto K = fem::test::tangent(problem, u, 0);
    double largest = 0, stiffest = 0;
    for (int i = 0; i < 6; ++i) {
      largest = std::max(largest, std::abs(F[i]));
      for (int j = 0; j < 6; ++j) stiffest = std::max(stiffest, std::abs(y[i].dx(j)));
    }
    ASSERT_GT(largest, 0);
    for (int a = 0; a < 6; ++a) {
      const int row = 2 * line.nodes[a / 2] + a % 2;
      EXPECT_NEAR(f[row], F[a], 1e-12 * largest) << m;
      // The part of the limits, which the tangent leaves out, is the error of Gauss' rule.
      for (int b = 0; b < 6; ++b)
        EXPECT_NEAR(K.at(row, 2 * line.nodes[b / 2] + b % 2), y[a].dx(b), 1e-11 * stiffest) << m;
    }
  }
}
