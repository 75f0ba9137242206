// A body pressed on a roll that is a NURBS surface, polynomial patches or the implicit cylinder: one path.
#include <gtest/gtest.h>

#include <cmath>

#include "atrapos/contact/PatchSearch.hpp"
#include "atrapos/path/Forced.hpp"
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
    for (int i = 0; i < 3; ++i) model.prescribe(n, i, 0, i == 2 ? -drive : 0);
  return model;
}

const RegularisedPressure pressure{1e-3, 1e-2};

std::shared_ptr<const PatchSet> setOf(const std::vector<BezierPatch>& patches) {
  return std::make_shared<PatchSet>(patches);
}

/// Contact with these patches.
void addContact(fem::FeModel& model, const fem::PointSet& points, std::shared_ptr<const PatchSet> set,
                double least) {
  const PatchTool tool = set->tool();
  addPatchContact(model, points, {std::move(set), tool}, pressure, least);
}

struct Result {
  Numbers u;
  int steps = 0;
  double force = 0;
};

Result pathEnd(fem::FeModel model) {
  fem::FeProblem problem(std::move(model));
  const path::State start{problem.initialState(0), 0.0};
  // Rational forms magnify rounding, here to a fifth of the residual: numbers of steps are compared.
  path::Options options = test::tightOptions();
  options.pade = path::PadeUse::off;
  const auto outcome = follow(problem, start, 1.0, options);
  Result result;
  result.u = fem::FeProblem::values(*outcome.final.u);
  result.steps = outcome.steps;
  result.force = -resultant(problem.forces(problem.term(1), outcome.final))[2];
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

// Part of the face beyond the edge of the tool: those points carry nothing. At 0.9 of the way the body has
// sunk beside the tool and bulges into its edge, which is no contact of points with a surface: the path ends
// there.
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
  const auto gap = observed(problem, 1, outcome.final, "contact_gap");
  const auto R = observed(problem, 1, outcome.final, "contact_pressure");
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

  const auto solver = linear::makeTangentSolver();
  path::Stops stops;
  stops.loadFactors = {1.0};
  NoObserver observer;
  const auto end = path::PathFollower(problem, *solver, tightOptions(), stops).run(outcome.final, observer);
  EXPECT_EQ(end.reason, path::EndReason::problemFailed) << end.text;
  EXPECT_NE(end.text.find("comes over an edge of its tool into its surface"), std::string::npos) << end.text;
  // Exactly there: a point is at the edge.
  double nearest = 1;
  const Numbers u = fem::FeProblem::values(*end.final.u);
  for (int p = 0; p < points.numPoints(); ++p) {
    double x = points.positions[3 * p];
    const int e = p / points.pointsPerEntity, N = points.nodesPerEntity;
    for (int n = 0; n < N; ++n) x += points.shape[p * N + n] * u[3 * points.nodes[e * N + n]];
    nearest = std::min(nearest, std::abs(x - 0.5));
  }
  EXPECT_LT(nearest, 1e-6);  // Newton's correction of the step's end may move it: bound of the residual 1e-10
}

/// A block whose top is pushed down and along x by a half: its points cross what is at x = 0.5 below it.
fem::FeModel slid(const fem::Mesh& mesh) {
  fem::FeModel model = solidModel(mesh, 10, 0.3);
  const double way[3] = {0.5, 0, -0.1};
  for (int n : fem::test::nodesOfSet(mesh, "z_max"))
    for (int i = 0; i < 3; ++i) model.prescribe(n, i, 0, way[i]);
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

/// A plate that turns up into an arc at x = 0.55 with a common tangent but not the same curvature; the plate
/// is cut at `border`.
std::vector<BezierPatch> plateAndArc(double border) {
  std::vector<BezierPatch> patches(3);
  const auto plate = [](double from, double to) {
    BezierPatch p;
    p.points = {{from, -1, -0.05}, {from, 2, -0.05}, {to, -1, -0.05}, {to, 2, -0.05}};
    return p;
  };
  patches[0] = plate(-1, border);
  patches[1] = plate(border, 0.55);
  patches[2].degree = {2, 1};
  patches[2].points = {{0.55, -1, -0.05}, {0.55, 2, -0.05}, {1.3, -1, -0.05},
                       {1.3, 2, -0.05},   {2, -1, 0.3},     {2, 2, 0.3}};
  return patches;
}

// Pressed points cross the jump of the curvature: a step ends at the border, the next one begins on the arc.
// Borders within the plate are none.
TEST_F(Slide, OverAJumpOfTheCurvature) {
  fem::FeModel one = slid(mesh), two = slid(mesh);
  addContact(one, points, setOf(plateAndArc(0)), 1e-3);
  addContact(two, points, setOf(plateAndArc(-0.4)), 1e-3);
  const Result a = pathEnd(std::move(one)), b = pathEnd(std::move(two));
  EXPECT_GT(a.force, 0.05);
  EXPECT_NEAR(b.force, a.force, 1e-8 * a.force);  // residuals of 1e-10 at the ends of steps
  for (std::size_t i = 0; i < a.u.size(); ++i) EXPECT_NEAR(b.u[i], a.u[i], 1e-8);
}

// Every break is at the border, and a restart from any step, behind a break too, has the same bits.
TEST_F(Slide, BreaksAreAtTheBorderAndRestart) {
  const auto set = setOf(plateAndArc(0));
  const auto problem = [&] {
    fem::FeModel model = slid(mesh);
    addContact(model, points, set, 1e-3);
    return fem::FeProblem(std::move(model));
  };
  struct Seen final : path::Observer {
    std::vector<path::StepReport> steps;
    bool onStep(const path::StepReport& report, const path::Series&) override {
      steps.push_back(report);
      return true;
    }
  };
  path::Stops stops;
  stops.loadFactors = {1.0};
  const auto run = [&](fem::FeProblem& on, const path::Start& start, Seen& seen) {
    const auto solver = linear::makeTangentSolver();
    return path::PathFollower(on, *solver, tightOptions(), stops).runFrom(start, seen);
  };
  fem::FeProblem whole = problem();
  Seen all;
  path::Start start;
  start.state = {whole.initialState(0), 0.0};
  const auto outcome = run(whole, start, all);
  ASSERT_EQ(outcome.reason, path::EndReason::stopReached) << outcome.text;
  int breaks = 0;
  for (const auto& step : all.steps) {
    if (step.events.empty()) continue;
    ++breaks;
    double nearest = 1;
    for (const double x : whole.term(1).places(fem::field(*step.end.u), step.end.lambda))
      nearest = std::min(nearest, std::abs(x - 0.55));
    EXPECT_LT(nearest, 1e-6);  // Newton's correction of a step's end may move it
  }
  EXPECT_GE(breaks, 2);
  EXPECT_LE(outcome.steps, 60);
  for (std::size_t s = 0; s + 1 < all.steps.size(); s += all.steps[s].events.empty() ? 6 : 2) {
    fem::FeProblem other = problem();
    Seen rest;
    const auto again = run(other, all.steps[s].next, rest);
    EXPECT_EQ(again.steps, outcome.steps);
    EXPECT_TRUE(fem::FeProblem::values(*again.final.u) == fem::FeProblem::values(*outcome.final.u))
        << "behind step " << s + 1;
  }
}

/// Two plates that meet at x = 0.55 under an angle; the second one rises with this slope, from `step` above
/// the first.
std::vector<BezierPatch> creased(double slope, double step) {
  std::vector<BezierPatch> plates(2);
  plates[0].points = {{-1, -1, -0.05}, {-1, 2, -0.05}, {0.55, -1, -0.05}, {0.55, 2, -0.05}};
  const double low = -0.05 + step, high = low + slope * 1.45;
  plates[1].points = {{0.55, -1, low}, {0.55, 2, low}, {2, -1, high}, {2, 2, high}};
  return plates;
}

// What modellers leave where faces meet: tangents off by 2e-3 either way, a gap of 2e-6. Pressed points come
// over it, forces jump by some 1e-4, and the path goes on from the corrected state. Beyond a thousandth of
// the forces, or where none is allowed, it ends.
TEST_F(Slide, ASlightCreaseIsPassed) {
  const auto run = [&](double slope, double step, double jumpBound) {
    fem::FeModel model = slid(mesh);
    addContact(model, points, setOf(creased(slope, step)), 1e-3);
    fem::FeProblem problem(std::move(model));
    const auto solver = linear::makeTangentSolver();
    path::Stops stops;
    stops.loadFactors = {1.0};
    auto options = tightOptions(1e-8);
    options.jumpBound = jumpBound;
    NoObserver observer;
    return path::PathFollower(problem, *solver, options, stops).run({problem.initialState(0), 0.0}, observer);
  };
  const auto flat = run(0, 0, 1e-3);
  ASSERT_EQ(flat.reason, path::EndReason::stopReached) << flat.text;
  EXPECT_EQ(flat.jumps, 0);
  const Numbers u = fem::FeProblem::values(*flat.final.u);
  for (const double slope : {2e-3, -2e-3}) {
    const auto end = run(slope, -2e-6, 1e-3);
    ASSERT_EQ(end.reason, path::EndReason::stopReached) << end.text;
    EXPECT_GE(end.jumps, 2);
    EXPECT_GT(end.worstJump, 1e-6);
    EXPECT_LT(end.worstJump, 1e-3);
    EXPECT_LE(end.worstResidual, 1e-8);
    const Numbers v = fem::FeProblem::values(*end.final.u);
    // The plate is 1.9e-3 higher or lower where the block ends, at x = 1.5.
    for (std::size_t i = 0; i < u.size(); ++i) EXPECT_NEAR(v[i], u[i], 2.2e-3);
    const auto strict = run(slope, -2e-6, 0);
    EXPECT_EQ(strict.reason, path::EndReason::problemFailed);
    EXPECT_NE(strict.text.find("the surface has a crease or a gap there"), std::string::npos) << strict.text;
  }
  const auto sharp = run(0.2, 0, 1e-3);
  EXPECT_EQ(sharp.reason, path::EndReason::problemFailed);
  EXPECT_NE(sharp.text.find("the surface has a crease or a gap there"), std::string::npos) << sharp.text;
}

/// Keeps how every step ended.
struct Ends final : path::Observer {
  std::vector<path::Start> next;
  int breaks = 0;
  bool onStep(const path::StepReport& report, const path::Series&) override {
    next.push_back(report.next);
    breaks += report.events.empty() ? 0 : 1;
    return true;
  }
};

// The path of an imperfect body, a force on the perfect one, is that of the body with this force among its
// dead loads; breaks too.
TEST_F(Slide, ImperfectPathsCrossTheBorder) {
  const auto set = setOf(plateAndArc(0));
  Numbers force(mesh.coordinates.size(), 0.0);
  for (int n : fem::test::nodesOfSet(mesh, "x_max")) force[3 * n + 1] = 0.01;
  for (int n : fem::test::nodesOfSet(mesh, "z_max")) force[3 * n + 1] = 0;  // held
  fem::FeModel perfect = slid(mesh), loaded = slid(mesh);
  addContact(perfect, points, set, 1e-3);
  addContact(loaded, points, set, 1e-3);
  loaded.constantLoad = force;
  fem::FeProblem problem(std::move(perfect)), other(std::move(loaded));
  path::ForcedProblem imperfect(problem, {fem::test::vectorOf(problem, force), {}});
  Ends ends, otherEnds;
  const auto a = follow(imperfect, {problem.initialState(0), 0.0}, 1.0, ends);
  const auto b = follow(other, {other.initialState(0), 0.0}, 1.0, otherEnds);
  EXPECT_GE(ends.breaks, 2);
  const Numbers u = fem::FeProblem::values(*a.final.u), v = fem::FeProblem::values(*b.final.u);
  for (std::size_t i = 0; i < u.size(); ++i) EXPECT_NEAR(u[i], v[i], 1e-8);  // residuals of 1e-10
}

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
  ASSERT_GT(ends.next.size(), 2u);
  fem::FeProblem other = problem();
  const auto again = run(other, ends.next[ends.next.size() / 2], rest);
  EXPECT_EQ(again.steps, outcome.steps);
  EXPECT_EQ(again.final.lambda, outcome.final.lambda);
  EXPECT_EQ(fem::FeProblem::values(*again.final.u), fem::FeProblem::values(*outcome.final.u));
}

}  // namespace
