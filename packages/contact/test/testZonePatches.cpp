// Zones of contact with tools made of patches: they go over borders within a zone, and end at edges.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "atrapos/contact/Cylinder.hpp"
#include "support/ContactModel.hpp"
#include "support/Derivatives.hpp"
#include "support/PatchSurfaces.hpp"
#include "support/ZoneBodies.hpp"

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
        Row row(fem::Topology::Quad8, *toolOf(twoArcs(x, y, 2, right, angle)), {7, m});
        const double exact = lineOnTwoArcs(x, y, 2, right, angle, m);
        ASSERT_GT(exact, 1e-4);
        EXPECT_NEAR(row.forceUp(Numbers(row.dofs(), 0.0)), exact, 1e-9 * exact)
            << m << ' ' << right << ' ' << angle;
      }
}

TEST(ZonePatches, TangentIsTheSymmetricDerivativeOfTheForce) {
  Motion motion;
  motion.shift[1][1] = 0.3;
  motion.angle[1] = 0.2;
  motion.pivot[0] = 1;
  const double angle = kTop + 0.02;
  Row row(fem::Topology::Quad8,
          *toolOf(twoArcs(1.4 - 2 * std::cos(angle), 0.05 - 2 * std::sin(angle), 2, 1, angle), motion),
          {7, 1});
  const Numbers u = fem::test::randomNumbers(2 * row.mesh.numNodes(), 0.01, 5);
  ASSERT_GT(fem::test::largest(row.forces(u, 0.05)), 1e-3);
  const auto K = fem::test::tangent(row.problem, u, 0.05);
  expectSymmetric(K);
  for (const double rate : {0.0, 1.0})
    expectDerivative(row.problem, K, u, 0.05, fem::test::randomNumbers(u.size(), 1, 6), rate, 1e-3);
}

// Patches of one surface are the surface, wherever its border lies in a zone: all orders, and the numbers of
// the smooth tool.
TEST(ZonePatches, SeriesOverPatchesOfOneSurface) {
  Pressed smooth(fem::Topology::Quad8, rigidTool(Cylinder{{1.4, -2, 0}, {0, 0, 1}, 2}));
  const Numbers u = smooth.at(0.02);
  for (const double angle : {kTop, kTop + 0.01, kTop - 0.03}) {
    Pressed body(fem::Topology::Quad8, toolOf(rollOfArcs(1.4, 0, 2, angle)));
    const path::State start = body.stateAt(0.02);
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
  Pressed body(fem::Topology::Quad8, toolOf(twoArcs(1.4, -2, 2, 1, kTop)));
  const path::State start = body.stateAt(0.02);
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
    Pressed body(fem::Topology::Quad8, toolOf(patches));
    const auto solver = linear::makeTangentSolver();
    path::Stops stops;
    stops.loadFactors = {0.05};
    path::PathFollower follower(body.problem, *solver, tightOptions(), stops);
    NoObserver observer;
    const auto out = follower.run({body.problem.initialState(0), 0.0}, observer);
    EXPECT_EQ(out.reason, path::EndReason::problemFailed);
    // Half of the zone is 0.1 wide there, on a roll of radius 2 that goes on; cells make it a little more to
    // the other side.
    Pressed whole(fem::Topology::Quad8, rigidTool(Cylinder{{1.4, -2.001, 0}, {0, 0, 1}, 2}));
    double width = 0;
    const path::State same = whole.stateAt(out.final.lambda);
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
