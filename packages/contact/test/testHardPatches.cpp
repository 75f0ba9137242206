// Hard contact, at nodes and over faces, on surfaces made of patches: borders that do not matter, a jump of
// the curvature, an edge.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "atrapos/fem/Multipliers.hpp"
#include "atrapos/fem/Rows.hpp"
#include "support/ContactModel.hpp"
#include "support/Derivatives.hpp"
#include "support/PatchSurfaces.hpp"

using namespace atrapos;
using namespace atrapos::contact;
using namespace atrapos::contact::test;

namespace {

/// A block above z = 0 whose top is pushed by `way` at load factor 1.
fem::FeModel pushed(const fem::Mesh& mesh, const Vector3& way) {
  fem::FeModel model = solidModel(mesh, 10, 0.3);
  for (int n : fem::test::nodesOfSet(mesh, "z_max"))
    for (int i = 0; i < 3; ++i) model.prescribe(n, i, 0, way[i]);
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

struct Steps final : path::Observer {
  std::vector<path::StepReport> steps;
  bool onStep(const path::StepReport& report, const path::Series&) override {
    steps.push_back(report);
    return true;
  }
};

struct Path {
  std::unique_ptr<fem::FeProblem> problem;
  Steps seen;
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
    force = -resultant(problem->forces(problem->term(1), outcome.final))[2];
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

struct HardPatches : testing::TestWithParam<Where> {
  fem::Mesh mesh = fem::test::distorted(fem::test::box(fem::Topology::Hex8, {3, 3, 2}, {1, 1, 1}), 0.02);
  fem::PointSet points = contactPoints(mesh, "z_min", GetParam(), 2);
  Vector3 down{0, 0, -0.15}, aside{0.5, 0, -0.1};

  bool faces() const { return GetParam() == Where::Quadrature; }

  template <class Tool>
  fem::FeModel over(const Tool& tool, const Vector3& way) const {
    fem::FeModel model = pushed(mesh, way);
    if (faces())
      addHardFaceContact(model, points, tool);
    else
      addHardContact(model, points, tool);
    return model;
  }
};

INSTANTIATE_TEST_SUITE_P(All, HardPatches, testing::Values(Where::Nodes, Where::Quadrature),
                         [](const testing::TestParamInfo<Where>& info) {
                           return info.param == Where::Nodes ? "Nodes" : "Faces";
                         });

}  // namespace

// The implicit cylinder, as a NURBS surface and as polynomials of degree 7, off the circle by 2 (pi/8)^8/8! =
// 3e-8 at most.
TEST_P(HardPatches, SameRollThreeWays) {
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

// What is pressed crosses the jump of the curvature, the rest closes behind it. Where the plate is cut does
// not matter.
TEST_P(HardPatches, OverAJumpOfTheCurvature) {
  const Path a(over(searchOf(plateAndArc(0)), aside)), b(over(searchOf(plateAndArc(-0.4)), aside));
  for (const Path* run : {&a, &b}) {
    ASSERT_EQ(run->outcome.reason, path::EndReason::stopReached) << run->outcome.text;
    EXPECT_GE(run->breaks(), 1);
    EXPECT_GE(run->changes(), 3);
    // No node is inside, none is pulled; over faces it is the mean gaps that are not negative.
    if (!faces()) {
      for (const double h : observed(*run->problem, 1, run->outcome.final, "contact_gap"))
        EXPECT_GT(h, -1e-8);
    }
    for (const double R : observed(*run->problem, 1, run->outcome.final, "contact_pressure"))
      EXPECT_GT(R, -1e-8);
  }
  EXPECT_GT(a.force, 0.05);
  EXPECT_NEAR(b.force, a.force, 1e-8 * a.force);
  for (std::size_t i = 0; i < mesh.coordinates.size(); ++i) EXPECT_NEAR(b.u[i], a.u[i], 1e-8);
}

TEST_P(HardPatches, ARestartHasTheSameBits) {
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

// What is pressed slides over the edge: no equilibrium beyond. Before, what is beyond the edge is free.
TEST_P(HardPatches, PathsEndAtAnEdge) {
  const Path run(over(searchOf({plate(-1, 0.85)}), aside));
  EXPECT_EQ(run.outcome.reason, path::EndReason::problemFailed);
  EXPECT_NE(run.outcome.text.find("slides over an edge of its tool while it is pressed"), std::string::npos)
      << run.outcome.text;
  EXPECT_GE(run.outcome.steps, 2);
  const auto h = observed(*run.problem, 1, run.outcome.final, "contact_gap");
  EXPECT_GT(std::count_if(h.begin(), h.end(), [](double gap) { return std::isinf(gap); }), 0);
  const auto places = run.problem->term(1).places(fem::field(*run.outcome.final.u), 1);
  double nearest = 1;
  for (std::size_t p = 0; p < places.size(); p += 3) nearest = std::min(nearest, std::abs(places[p] - 0.85));
  EXPECT_LT(nearest, 1e-6);
}

namespace {

/// Two of the three columns of faces lie over a plate that ends at x = `edge`, between their points.
struct OverAnEdge : testing::Test {
  fem::Mesh mesh = fem::test::box(fem::Topology::Hex20, {3, 2, 2}, {1, 1, 1});
  fem::PointSet faces = contactPoints(mesh, "z_min", Where::Quadrature);

  /// Pushed so little that the body does not bulge into the edge.
  fem::FeModel overPlane() const { return pushed(mesh, {0, 0, -0.07}); }
  fem::FeModel plateUpTo(double edge) const {
    fem::FeModel model = overPlane();
    addHardFaceContact(model, faces, searchOf({plate(-1, edge)}));
    return model;
  }
};

}  // namespace

// Faces beyond the edge have no part in the means around the corners that they share with others: a plane
// that only the faces before it know.
TEST_F(OverAnEdge, FacesBeyondHaveNoPart) {
  std::vector<int> before;
  for (int e = 0; e < faces.numEntities; ++e)
    if (faces.positions[3 * static_cast<std::size_t>(e) * faces.pointsPerEntity] < 0.66) before.push_back(e);
  ASSERT_EQ(before.size(), 4u);
  fem::PointSet two = faces;
  two.numEntities = 4;
  const std::size_t N = faces.nodesPerEntity, Q = faces.pointsPerEntity;
  two.nodes = fem::rowsOf(faces.nodes, before, N);
  two.shape = fem::rowsOf(faces.shape, before, Q * N);
  two.weights = fem::rowsOf(faces.weights, before, Q);
  two.positions = fem::rowsOf(faces.positions, before, 3 * Q);
  two.normals = fem::rowsOf(faces.normals, before, 3 * Q);
  fem::FeModel model = overPlane();
  Plane plane;
  plane.point[2] = -0.05;
  addHardFaceContact(model, two, plane);
  const Path expected(std::move(model));
  ASSERT_EQ(expected.outcome.reason, path::EndReason::stopReached) << expected.outcome.text;
  EXPECT_GT(expected.force, 0.1);
  for (const double edge : {0.65, 0.69}) {
    const Path run(plateUpTo(edge));
    ASSERT_EQ(run.outcome.reason, path::EndReason::stopReached) << run.outcome.text;
    EXPECT_EQ(run.changes(), expected.changes());
    EXPECT_NEAR(run.force, expected.force, 1e-8 * expected.force);  // bound of the residual: 1e-10
    for (std::size_t i = 0; i < mesh.coordinates.size(); ++i) EXPECT_NEAR(run.u[i], expected.u[i], 1e-8);
  }
}

// The residual along series, and event functions: multipliers, and means over what is above the plate.
TEST_F(OverAnEdge, SeriesAndEventFunctions) {
  fem::FeModel copy;
  copy.dofs = fem::DofMap::displacements(mesh.numNodes());
  const auto own = fem::withCornerMultipliers(copy, faces);
  fem::FeModel model = solidModel(mesh, 10, 0.3);
  for (int n : fem::test::nodesOfSet(mesh, "z_max"))  // tilted, so that some corners stay free
    for (int i = 0; i < 3; ++i) model.prescribe(n, i, 0, i == 2 ? mesh.coordinates[3 * n + 1] - 1 : 0);
  addHardFaceContact(model, faces, searchOf({plate(-1, 0.65)}));
  fem::FeProblem problem(std::move(model));
  const auto end = follow(problem, {problem.initialState(0), 0.0}, 0.09, tightOptions(1e-9));
  const auto conditions = problem.conditionsAt(end.final);
  const auto active = std::count(conditions.begin(), conditions.begin() + problem.eventCount(), 1);
  EXPECT_GE(active, 2);
  EXPECT_LE(active, 7);  // of nine corners that touch the plate
  const Numbers u =
      fem::test::equilibrium(problem, 0.09, fem::FeProblem::values(*end.final.u), 1e-12, end.final.memory).u;
  expectEventFunctions(problem, u, 0.09, end.final.memory, mesh.coordinates.size(),
                       [&](const fem::PointValues& shown) {
                         const int Q = faces.pointsPerEntity, M = own.conditions;
                         Numbers gaps(problem.eventCount(), 0.0), area(problem.eventCount(), 0.0);
                         int beyond = 0;
                         for (int p = 0; p < faces.numPoints(); ++p) {
                           if (std::isinf(shown.values[2 * p])) {
                             ++beyond;
                             continue;
                           }
                           for (int m = 0; m < M; ++m) {
                             const int c = own.multipliers[p / Q * M + m] - mesh.numNodes();
                             area[c] += faces.weights[p] * own.functions[p * M + m];
                             gaps[c] += faces.weights[p] * own.functions[p * M + m] * shown.values[2 * p];
                           }
                         }
                         EXPECT_EQ(beyond, 2 * Q);
                         EXPECT_EQ(std::count(area.begin(), area.end(), 0.0), 3);
                         for (std::size_t c = 0; c < gaps.size(); ++c)
                           gaps[c] = area[c] > 0 ? gaps[c] / area[c] : 1;
                         return gaps;
                       });
}
