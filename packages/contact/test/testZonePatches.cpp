// Zones of contact with tools made of patches: they go over borders within a zone, and end at edges.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "atrapos/contact/Cylinder.hpp"
#include "support/ContactModel.hpp"
#include "support/Derivatives.hpp"
#include "support/PatchSurfaces.hpp"
#include "support/PlaneContact.hpp"

using namespace atrapos;
using namespace atrapos::contact;
using namespace atrapos::contact::test;

namespace {

constexpr double kTop = std::acos(-1.0) / 2;  ///< the angle of a roll's top

std::unique_ptr<RigidTool> toolOf(const std::vector<BezierPatch>& patches,
                                  const std::optional<Motion>& motion = {}) {
  return rigidTool(std::make_shared<const PatchSet>(patches), motion);
}

/// A roll with its top at (x, y) as arcs of which one begins at this angle.
std::vector<BezierPatch> rollOfArcs(double x, double y, double radius, double angle) {
  return twoArcs(x, y - radius, radius, radius, angle);
}

/// Contact alone: of four edges 1 wide on y = 0.
struct Row {
  fem::Mesh mesh = planeMesh(fem::Topology::Quad8, {4, 1}, {4, 1});
  fem::FeProblem problem;

  explicit Row(const RigidTool& tool, int exponent = 1) : problem(model(tool, exponent)) {}
  fem::FeModel model(const RigidTool& tool, int exponent) {
    fem::FeModel all = planeModel(mesh, {}, 10, 0.3);
    addZones(all, mesh, {}, tool, {7, exponent});
    return all;
  }
  Numbers forces(const Numbers& u, double lambda = 0) {
    return problem.forces(problem.term(1), {fem::test::vectorOf(problem, u), lambda});
  }
  double forceUp() {
    const Numbers f = forces(Numbers(2 * static_cast<std::size_t>(mesh.numNodes()), 0.0));
    double sum = 0;
    for (std::size_t d = 1; d < f.size(); d += 2) sum -= f[d];
    return sum;
  }
};

/// The force up on the line y = 0 over twoArcs: Simpson's rule on 4000 pieces of either side of the normal at
/// their border, where p has a kink at most (error 1e-11).
double lineOnTwoArcs(double x, double y, double left, double right, double angle, int m) {
  const double way = left - right, cx = x + way * std::cos(angle), cy = y + way * std::sin(angle);
  const double border = x - y / std::tan(angle);
  const auto at = [&](double s, bool isRight) {
    const double a = isRight ? cx : x, b = isRight ? cy : y, rho = std::hypot(s - a, b);
    const double depth = (isRight ? right : left) - rho;
    return depth > 0 ? 7 * std::pow(depth, m) * -b / rho : 0.0;
  };
  const double first = std::min(border, x - std::sqrt(std::max(left * left - y * y, 0.0))),
               last = std::max(border, cx + std::sqrt(std::max(right * right - cy * cy, 0.0)));
  double sum = 0;
  constexpr int n = 4000;
  for (const bool isRight : {false, true}) {
    const double from = isRight ? border : first, to = isRight ? last : border, d = (to - from) / n;
    for (int i = 0; i < n; ++i)
      sum += d / 6 *
             (at(from + i * d, isRight) + 4 * at(from + (i + 0.5) * d, isRight) +
              at(from + (i + 1) * d, isRight));
  }
  return sum;
}

}  // namespace

TEST(ZonePatches, ForceOverTheBorderOfTwoArcs) {
  for (const int m : {1, 2})
    for (const double right : {2.0, 1.0, 0.5})
      for (const double angle : {kTop + 0.02, kTop - 0.05, kTop + 0.08}) {
        // The border is at (1.4, 0.03), within the zone.
        const double x = 1.4 - 2 * std::cos(angle), y = 0.03 - 2 * std::sin(angle);
        Row row(*toolOf(twoArcs(x, y, 2, right, angle)), m);
        const double exact = lineOnTwoArcs(x, y, 2, right, angle, m);
        ASSERT_GT(exact, 1e-4);
        EXPECT_NEAR(row.forceUp(), exact, 1e-9 * exact) << m << ' ' << right << ' ' << angle;
      }
}

TEST(ZonePatches, TangentIsTheSymmetricDerivativeOfTheForce) {
  Motion motion;
  motion.shift[1][1] = 0.3;
  motion.angle[1] = 0.2;
  motion.pivot[0] = 1;
  const double angle = kTop + 0.02;
  Row row(*toolOf(twoArcs(1.4 - 2 * std::cos(angle), 0.05 - 2 * std::sin(angle), 2, 1, angle), motion));
  const Numbers u = fem::test::randomNumbers(2 * row.mesh.numNodes(), 0.01, 5);
  ASSERT_GT(fem::test::largest(row.forces(u, 0.05)), 1e-3);
  const auto K = fem::test::tangent(row.problem, u, 0.05);
  expectSymmetric(K);
  for (const double rate : {0.0, 1.0})
    expectDerivative(row.problem, K, u, 0.05, fem::test::randomNumbers(u.size(), 1, 6), rate, 1e-3);
}

namespace {

/// A body of two rows of cells on a roll of these patches, its top pressed down by lambda.
struct Pressed {
  fem::Mesh mesh = planeMesh(fem::Topology::Quad8, {3, 2}, {3, 1});
  fem::LineSet lines;
  fem::FeProblem problem;

  explicit Pressed(const RigidTool& tool) : problem(model(tool)) {}
  fem::FeModel model(const RigidTool& tool) {
    fem::FeModel all = planeModel(mesh, {}, 10, 0.3);
    for (const int n : fem::test::nodesOfSet(mesh, "y_max")) {
      all.prescribe(n, 0, 0, 0.1);
      all.prescribe(n, 1, 0, -1);
    }
    lines = addZones(all, mesh, {}, tool, {200, 1});
    return all;
  }
  path::State at(double lambda) {
    Numbers u;
    for (int n = 0; n < mesh.numNodes(); ++n) u.insert(u.end(), {0.1 * lambda, -lambda});
    u = fem::test::equilibrium(problem, lambda, u, 1e-13).u;
    return problem.settled({fem::test::vectorOf(problem, u), lambda});
  }
};

}  // namespace

// Patches of one surface are the surface, wherever its border lies in a zone: all orders, and the numbers of
// the smooth tool.
TEST(ZonePatches, SeriesOverPatchesOfOneSurface) {
  Pressed smooth(*rigidTool(Cylinder{{1.4, -2, 0}, {0, 0, 1}, 2}));
  const Numbers u = fem::FeProblem::values(*smooth.at(0.02).u);
  for (const double angle : {kTop, kTop + 0.01, kTop - 0.03}) {
    Pressed body(*toolOf(rollOfArcs(1.4, 0, 2, angle)));
    const path::State start = body.at(0.02);
    EXPECT_LE(fem::test::largest(fem::test::sum(fem::FeProblem::values(*start.u), -1, u)), 1e-11);
    const auto solver = linear::makeTangentSolver();
    path::Calls calls(body.problem, *solver);
    for (const int order : {2, 5, 8, 13}) {
      path::SeriesRequest request;
      request.order = order;
      expectOrder(body.problem, path::buildSeries(calls, start, request), order, order > 8 ? 1e-7 : 1e-6);
    }
  }
}

// Where curvatures differ the border is a limit that moves along the body.
TEST(ZonePatches, SeriesOverTwoArcs) {
  Pressed body(*toolOf(twoArcs(1.4, -2, 2, 1, kTop)));
  const path::State start = body.at(0.02);
  const auto solver = linear::makeTangentSolver();
  path::Calls calls(body.problem, *solver);
  for (const int order : {2, 5, 8}) {
    path::SeriesRequest request;
    request.order = order;
    expectOrder(body.problem, path::buildSeries(calls, start, request), order);
  }
}

// A zone that grows over an edge, or over a crease, has no pressure that ends with zero: the path ends, and
// says so.
TEST(ZonePatches, EdgesAndCreasesEndAPath) {
  const auto endOn = [](const std::vector<BezierPatch>& patches) {
    Pressed body(*toolOf(patches));
    const auto solver = linear::makeTangentSolver();
    path::Stops stops;
    stops.loadFactors = {0.05};
    path::PathFollower follower(body.problem, *solver, tightOptions(), stops);
    NoObserver observer;
    const auto out = follower.run({body.problem.initialState(0), 0.0}, observer);
    EXPECT_EQ(out.reason, path::EndReason::problemFailed);
    // Half of the zone is 0.1 wide there, on a roll of radius 2 that goes on; cells make it a little more to the
    // other side.
    Pressed whole(*rigidTool(Cylinder{{1.4, -2.001, 0}, {0, 0, 1}, 2}));
    double width = 0;
    const path::State same = whole.at(out.final.lambda);
    const Numbers parts = observed(whole.problem, 1, same, "contact_part");
    for (std::size_t i = 0; i < parts.size(); ++i) width += whole.lines.weights[i] * parts[i];
    EXPECT_NEAR(width, 0.2, 0.02);
    return out.text;
  };
  const BezierPatch arc = arcPatch(1.4, -2.001, 2, kTop - 0.05, kTop + 1, 1);
  const auto has = [](const std::string& text, const char* part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  has(endOn({arc}), "zone limit 6 (of 12) slides over an edge of its tool while it is pressed");
  // Behind its end the surface goes down by a tenth more.
  const double x = 1.4 + 2 * std::sin(0.05), y = -2.001 + 2 * std::cos(0.05);
  BezierPatch slope;
  slope.points = {{x + 2, y - 0.3, -1}, {x + 2, y - 0.3, 1}, {x, y, -1}, {x, y, 1}};
  has(endOn({arc, slope}), "where its force would jump: the surface has a crease or a gap there");
}
