// Hard contact on surfaces made of patches: borders that do not matter, a jump of the curvature, an edge.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "atrapos/contact/HardContact.hpp"
#include "support/ContactModel.hpp"
#include "support/PatchSurfaces.hpp"

using namespace atrapos;
using namespace atrapos::contact;
using namespace atrapos::contact::test;

namespace {

/// A block above z = 0 whose top is pushed by `way` at load factor 1.
fem::FeModel pushed(const fem::Mesh& mesh, const Vector3& way) {
  fem::FeModel model = solidModel(mesh, 10, 0.3);
  for (int n : fem::test::nodesOfSet(mesh, "z_max"))
    for (int i = 0; i < 3; ++i) model.supports.prescribe(n, i, 0, way[i]);
  return model;
}

BezierPatch plate(double from, double to) {
  BezierPatch p;
  p.points = {{from, -1, -0.05}, {from, 2, -0.05}, {to, -1, -0.05}, {to, 2, -0.05}};
  return p;
}

/// A plate that turns up into an arc at x = 1.05 with a common tangent but not the same curvature; the plate
/// is cut at `border`.
std::vector<BezierPatch> plateAndArc(double border) {
  BezierPatch arc;
  arc.degree = {2, 1};
  arc.points = {{1.05, -1, -0.05}, {1.05, 2, -0.05}, {1.5, -1, -0.05},
                {1.5, 2, -0.05},   {2.2, -1, 0.3},   {2.2, 2, 0.3}};
  return {plate(-1, border), plate(border, 1.05), arc};
}

PatchSearch<PatchTool> searchOf(const std::vector<BezierPatch>& patches) {
  const auto set = std::make_shared<const PatchSet>(patches);
  return {set, set->tool()};
}

struct Seen final : path::Observer {
  std::vector<path::StepReport> steps;
  bool onStep(const path::StepReport& report, const path::Series&) override {
    steps.push_back(report);
    return true;
  }
};

struct Path {
  std::unique_ptr<fem::FeProblem> problem;
  Seen seen;
  path::Outcome outcome;
  Numbers u;
  double force = 0;

  explicit Path(fem::FeModel model) : problem(std::make_unique<fem::FeProblem>(std::move(model))) {
    path::Start start;
    start.state = {problem->initialState(0), 0.0};
    follow(start);
  }
  Path(fem::FeModel model, const path::Start& start)
      : problem(std::make_unique<fem::FeProblem>(std::move(model))) {
    follow(start);
  }

  void follow(const path::Start& start) {
    const auto solver = linear::makeTangentSolver();
    path::Stops stops;
    stops.loadFactors = {1.0};
    outcome = path::PathFollower(*problem, *solver, tightOptions(), stops).runFrom(start, seen);
    u = fem::FeProblem::values(*outcome.final.u);
    force = -resultant(problem->forces(problem->term(1), *outcome.final.u, outcome.final.lambda))[2];
  }
  int changes() const {  // of the contact set
    int n = 0;
    for (const auto& step : seen.steps)
      n += std::any_of(step.events.begin(), step.events.end(),
                       [&](int i) { return i < problem->eventCount(); });
    return n;
  }
  int breaks() const {
    int n = 0;
    for (const auto& step : seen.steps)
      n += std::any_of(step.events.begin(), step.events.end(),
                       [&](int i) { return i >= problem->eventCount(); });
    return n;
  }
};

struct HardPatches : testing::Test {
  fem::Mesh mesh = fem::test::distorted(fem::test::box(fem::Topology::Hex8, {3, 3, 2}, {1, 1, 1}), 0.02);
  fem::PointSet points = contactPoints(mesh, "z_min", Where::Nodes);
  Vector3 down{0, 0, -0.15}, aside{0.5, 0, -0.1};

  template <class Tool>
  fem::FeModel over(const Tool& tool, const Vector3& way) const {
    fem::FeModel model = pushed(mesh, way);
    addHardContact(model, points, tool);
    return model;
  }
};

}  // namespace

// The implicit cylinder, as a NURBS surface and as polynomials of degree 7, off the circle by 2 (pi/8)^8/8! =
// 3e-8 at most.
TEST_F(HardPatches, SameRollThreeWays) {
  const Cylinder roll{{0.4, 0, -2.05}, {0.28, 0.96, 0}, 2.0};
  const Path a(over(roll, down)), b(over(searchOf(nurbsCylinder(roll, 5).patches()), down)),
      c(over(searchOf(bezierCylinder(roll, 5, 7)), down));
  for (const Path* run : {&a, &b, &c})
    ASSERT_EQ(run->outcome.reason, path::EndReason::stopReached) << run->outcome.text;
  EXPECT_GT(a.force, 0.1);
  EXPECT_GE(a.changes(), 5);
  EXPECT_EQ(a.outcome.steps, b.outcome.steps);
  EXPECT_EQ(a.changes(), b.changes());
  EXPECT_EQ(a.changes(), c.changes());
  EXPECT_EQ(b.breaks(), 0);
  for (std::size_t i = 0; i < mesh.coordinates.size(); ++i) {
    EXPECT_NEAR(b.u[i], a.u[i], 1e-8);  // bound of the residual: 1e-10 of the scale of forces
    EXPECT_NEAR(c.u[i], a.u[i], 3e-7);
  }
}

// Pressed nodes cross the jump of the curvature, others close behind it. Where the plate is cut does not
// matter.
TEST_F(HardPatches, OverAJumpOfTheCurvature) {
  const Path a(over(searchOf(plateAndArc(0)), aside)), b(over(searchOf(plateAndArc(-0.4)), aside));
  for (const Path* run : {&a, &b}) {
    ASSERT_EQ(run->outcome.reason, path::EndReason::stopReached) << run->outcome.text;
    EXPECT_GE(run->breaks(), 1);
    EXPECT_GE(run->changes(), 3);
    // No node is inside, none is pulled.
    for (const double h : observed(*run->problem, 1, *run->outcome.final.u, "contact_gap"))
      EXPECT_GT(h, -1e-8);
    for (const double R : observed(*run->problem, 1, *run->outcome.final.u, "contact_pressure"))
      EXPECT_GT(R, -1e-8);
  }
  EXPECT_GT(a.force, 0.05);
  EXPECT_NEAR(b.force, a.force, 1e-8 * a.force);
  for (std::size_t i = 0; i < mesh.coordinates.size(); ++i) EXPECT_NEAR(b.u[i], a.u[i], 1e-8);
}

TEST_F(HardPatches, ARestartHasTheSameBits) {
  const auto surface = searchOf(plateAndArc(0));
  const Path whole(over(surface, aside));
  const auto& all = whole.seen.steps;
  ASSERT_EQ(whole.outcome.reason, path::EndReason::stopReached) << whole.outcome.text;
  int behindBreaks = 0;
  for (std::size_t s = 0; s + 1 < all.size(); ++s) {
    if (all[s].events.empty() && s % 4 != 0) continue;
    const Path rest(over(surface, aside), all[s].next);
    EXPECT_EQ(rest.outcome.steps, whole.outcome.steps);
    EXPECT_TRUE(rest.u == whole.u) << "behind step " << s + 1;
    for (const int i : all[s].events) behindBreaks += i >= whole.problem->eventCount();
  }
  EXPECT_GT(behindBreaks, 0);
}

// A pressed node slides over the edge: no equilibrium beyond. Before, the nodes beyond the edge are free.
TEST_F(HardPatches, PathsEndAtAnEdge) {
  const Path run(over(searchOf({plate(-1, 0.85)}), aside));
  EXPECT_EQ(run.outcome.reason, path::EndReason::problemFailed);
  EXPECT_NE(run.outcome.text.find("slides over an edge of its tool while it is pressed"), std::string::npos)
      << run.outcome.text;
  EXPECT_GE(run.outcome.steps, 2);
  const auto h = observed(*run.problem, 1, *run.outcome.final.u, "contact_gap");
  EXPECT_GT(std::count_if(h.begin(), h.end(), [](double gap) { return std::isinf(gap); }), 0);
  double nearest = 1;
  for (int p = 0; p < points.numPoints(); ++p)
    nearest = std::min(nearest, std::abs(points.positions[3 * p] + run.u[3 * points.nodes[p]] - 0.85));
  EXPECT_LT(nearest, 1e-6);
}
