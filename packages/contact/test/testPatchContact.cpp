// A body pressed on a roll that is a NURBS surface, polynomial patches or the implicit cylinder: one path.
#include <gtest/gtest.h>

#include <cmath>

#include "atrapos/contact/PatchSearch.hpp"
#include "support/ContactModel.hpp"
#include "support/PatchSurfaces.hpp"

using namespace atrapos;
using namespace atrapos::contact;
using namespace atrapos::contact::test;

namespace {

constexpr double drive = 0.15;

const Cylinder& roll() {
  static const Cylinder cylinder{{0.4, 0, -2.01}, {0.28, 0.96, 0}, 2.0};
  return cylinder;
}

/// A block whose top is pushed down towards the roll.
fem::Mesh block() {
  return fem::test::distorted(fem::test::box(fem::Topology::Hex8, {3, 3, 2}, {1, 1, 1}), 0.02);
}

fem::FeModel pushed(const fem::Mesh& mesh) {
  fem::FeModel model = solidModel(mesh, 10, 0.3);
  for (int n : fem::test::nodesOfSet(mesh, "z_max"))
    for (int i = 0; i < 3; ++i) model.supports.prescribe(n, i, 0, i == 2 ? -drive : 0);
  return model;
}

const RegularisedPressure pressure{1e-3, 1e-2};

/// Contact with patches: four data a point, found at every state.
void addContact(fem::FeModel& model, const fem::PointSet& points, std::shared_ptr<const PatchSet> set,
                double least) {
  std::vector<double> data;
  for (int p = 0; p < points.numPoints(); ++p) {
    const double* x = &points.positions[3 * p];
    const auto place = set->locate(x);
    double y[6] = {};
    if (place[0] >= 0) taylor::solveImplicit<3, 6, 3>(set->tool(), x, place.data(), y);
    data.insert(data.end(), {std::max(y[0], least), -1, 0, 0});
  }
  using Law = ContactLaw<PatchTool>;
  const PatchTool tool = set->tool();
  model.terms.push_back(std::make_unique<fem::LawTerm<Law, fem::CurrentPosition>>(
      Law{tool, pressure}, points, data, PatchSearch<PatchTool>{std::move(set), tool}));
}
std::shared_ptr<const PatchSet> setOf(const std::vector<BezierPatch>& patches) {
  return std::make_shared<PatchSet>(patches);
}

struct Result {
  Numbers u;
  int steps = 0;
  double force = 0;
};

Result pathEnd(fem::FeModel model) {
  fem::FeProblem problem(std::move(model));
  const path::State start{problem.initialState(0), 0.0};
  const auto outcome = follow(problem, start, 1.0);
  Result result;
  result.u = fem::FeProblem::values(*outcome.final.u);
  result.steps = outcome.steps;
  result.force = -resultant(problem.forces(problem.term(1), *outcome.final.u, outcome.final.lambda))[2];
  return result;
}

TEST(PatchContact, SameRollThreeWays) {
  const auto mesh = block();
  const auto points = contactPoints(mesh, "z_min", Where::Quadrature, 2);
  const double least = 1e-3;
  fem::FeModel implicit = pushed(mesh), nurbs = pushed(mesh), bezier = pushed(mesh);
  test::addContact(implicit, points, roll(), pressure, least);
  addContact(nurbs, points, setOf(nurbsCylinder(roll(), 5).patches()), least);
  addContact(bezier, points, setOf(bezierCylinder(roll(), 5, 7)), least);
  const Result a = pathEnd(std::move(implicit)), b = pathEnd(std::move(nurbs)),
               c = pathEnd(std::move(bezier));
  EXPECT_GT(a.force, 0.1);
  EXPECT_EQ(a.steps, b.steps);
  EXPECT_NEAR(a.steps, c.steps, 1);
  EXPECT_NEAR(b.force, a.force, 1e-9 * a.force);  // bound of the residual on the path: 1e-10
  for (std::size_t i = 0; i < a.u.size(); ++i) {
    EXPECT_NEAR(b.u[i], a.u[i], 1e-9 * drive);
    // Polynomials of degree 7: off the circle by 2 (pi/8)^8/8! = 3e-8 at most.
    EXPECT_NEAR(c.u[i], a.u[i], 1e-7);
  }
}

// Part of the face beyond the edge of the tool: those points carry nothing. At 0.9 of the way a pressed one
// slides over the edge, where paths end.
TEST(PatchContact, PointsBeyondTheEdgeCarryNothing) {
  const auto mesh = block();
  const auto points = contactPoints(mesh, "z_min", Where::Quadrature, 2);
  BezierPatch plate;  // under the half of the face with x < 0.5
  plate.points = {{-1, -1, -0.01}, {-1, 2, -0.01}, {0.5, -1, -0.01}, {0.5, 2, -0.01}};
  fem::FeModel model = pushed(mesh);
  addContact(model, points, setOf({plate}), 1e-3);
  fem::FeProblem problem(std::move(model));
  const path::State start{problem.initialState(0), 0.0};
  const auto outcome = follow(problem, start, 0.8);
  const auto gap = observed(problem, 1, *outcome.final.u, "contact_gap");
  const auto R = observed(problem, 1, *outcome.final.u, "contact_pressure");
  int over = 0, pressed = 0, beyond = 0;
  for (std::size_t p = 0; p < gap.size(); ++p)
    if (points.positions[3 * p] < 0.5) {
      ++over;
      EXPECT_LT(gap[p], 0.1);
      pressed += R[p] > 0.1 ? 1 : 0;  // the body bends over the edge and lifts off elsewhere
    } else {
      ++beyond;
      EXPECT_TRUE(std::isinf(gap[p]));
      EXPECT_EQ(R[p], 0.0);
    }
  EXPECT_GT(over, 5);
  EXPECT_GT(pressed, 2);
  EXPECT_GT(beyond, 5);
}

/// A block whose top is pushed down and along x by a half: its points cross what is at x = 0.5 below it.
fem::FeModel slid(const fem::Mesh& mesh) {
  fem::FeModel model = solidModel(mesh, 10, 0.3);
  const double way[3] = {0.5, 0, -0.1};
  for (int n : fem::test::nodesOfSet(mesh, "z_max"))
    for (int i = 0; i < 3; ++i) model.supports.prescribe(n, i, 0, way[i]);
  return model;
}

/// A wavy bicubic surface below the block.
BezierPatch washboard() {
  BezierPatch patch;
  patch.degree = {3, 1};
  const double x[4] = {-1, 0, 1, 2}, z[4] = {-0.2, 0.18, -0.22, -0.1};
  for (int i = 0; i < 4; ++i)
    for (const double y : {-1.0, 2.0}) patch.points.push_back({x[i], y, z[i] - 0.05});
  return patch;
}

struct Slide : testing::Test {
  fem::Mesh mesh = block();
  fem::PointSet points = contactPoints(mesh, "z_min", Where::Quadrature, 2);
};

// Cut in two at x = 0.5, where pressed points cross: the same path, whichever side they come from.
TEST_F(Slide, TwoSideBySideAreOne) {
  fem::FeModel one = slid(mesh), two = slid(mesh);
  addContact(one, points, setOf({washboard()}), 1e-3);
  addContact(two, points, setOf(halves(washboard(), 0)), 1e-3);
  const Result a = pathEnd(std::move(one)), b = pathEnd(std::move(two));
  EXPECT_GT(a.force, 0.02);
  EXPECT_EQ(a.steps, b.steps);
  EXPECT_NEAR(b.force, a.force, 1e-9 * a.force);  // bound of the residual on the path: 1e-10
  for (std::size_t i = 0; i < a.u.size(); ++i) EXPECT_NEAR(b.u[i], a.u[i], 1e-9);
}

/// Keeps how every step ended.
struct Ends final : path::Observer {
  std::vector<path::Start> next;
  bool onStep(const path::StepReport& report, const path::Series&) override {
    next.push_back(report.next);
    return true;
  }
};

// Another problem that begins at the end of a step in the middle goes on with the same bits: which patch a
// point is over is no matter of where it came from.
TEST_F(Slide, GoesOnBitByBitFromTheMiddle) {
  const auto set = setOf(halves(washboard(), 0));
  const auto problem = [&] {
    fem::FeModel model = slid(mesh);
    addContact(model, points, set, 1e-3);
    return fem::FeProblem(std::move(model));
  };
  path::Stops stops;
  stops.loadFactors = {1.0};
  const auto run = [&](fem::FeProblem& on, const path::Start& start, Ends& ends) {
    const auto solver = linear::makeTangentSolver();
    path::PathFollower follower(on, *solver, tightOptions(), stops);
    return follower.runFrom(start, ends);
  };
  fem::FeProblem whole = problem();
  Ends ends, rest;
  path::Start start;
  start.state = {whole.initialState(0), 0.0};
  const auto outcome = run(whole, start, ends);
  ASSERT_EQ(outcome.reason, path::EndReason::stopReached) << outcome.text;
  ASSERT_GT(ends.next.size(), 4u);
  fem::FeProblem other = problem();
  const auto again = run(other, ends.next[ends.next.size() / 2], rest);
  EXPECT_EQ(again.steps, outcome.steps);
  EXPECT_EQ(again.final.lambda, outcome.final.lambda);
  EXPECT_EQ(fem::FeProblem::values(*again.final.u), fem::FeProblem::values(*outcome.final.u));
}

}  // namespace
