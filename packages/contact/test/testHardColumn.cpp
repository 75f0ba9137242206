// Hard contact of a column in closed form: closing, opening, closing again, starts that touch.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <optional>

#include "atrapos/contact/MovingTool.hpp"
#include "atrapos/fem/Loads.hpp"
#include "support/ContactModel.hpp"

using namespace atrapos;
using namespace atrapos::contact;
using namespace atrapos::contact::test;

namespace {

/// One HEX8 of unit cross-section held at its top, its lower face at z = gap; a dead force loadRate lambda
/// pulls the face down by w, E s (s^2 - 1)/2 = force, s = 1 + w/length.
struct HardColumn {
  static constexpr double length = 4, E = 4;
  double gap, loadRate;
  fem::Mesh mesh;
  std::unique_ptr<fem::FeProblem> problem;

  template <class Tool>
  HardColumn(const Tool& tool, double itsGap, double rate, Where where = Where::Nodes)
      : gap(itsGap), loadRate(rate) {
    mesh = fem::test::box(fem::Topology::Hex8, {1, 1, 1}, {1, 1, length}, {0, 0, gap});
    fem::FeModel model = solidModel(mesh, E, 0);
    for (int n : fem::test::nodesOfSet(mesh, "x_min")) model.prescribe(n, 0, 0, 0);
    for (int n : fem::test::nodesOfSet(mesh, "y_min")) model.prescribe(n, 1, 0, 0);
    for (int n : fem::test::nodesOfSet(mesh, "z_max")) model.prescribe(n, 2, 0, 0);
    if (rate != 0) fem::addSurfaceForce(mesh, fem::test::sideSet(mesh, "z_min"), {0, 0, -rate}, model.load);
    addHardContact(model, contactPoints(mesh, "z_min", where, 2), tool);
    problem = std::make_unique<fem::FeProblem>(std::move(model));
  }

  static double barForce(double w) {
    const double s = 1 + w / length;
    return E * s * (s * s - 1) / 2;
  }
  path::Start start() const {
    path::Start s;
    s.state = {problem->initialState(0), 0.0};
    return s;
  }
  double w(const path::Vector& u) const {
    return -fem::FeProblem::values(u)[3 * fem::test::nodesOfSet(mesh, "z_min").at(0) + 2];
  }
  /// Force of the tool on the column.
  double force(const path::State& state) const {
    return -resultant(problem->forces(problem->term(1), state))[2];
  }
};

struct Seen final : path::Observer {
  const fem::FeProblem& problem;
  std::vector<path::StepReport> steps;
  std::vector<std::vector<int>> conditions;
  std::vector<double> events;  ///< their load factors
  explicit Seen(const fem::FeProblem& p) : problem(p) {}
  bool onStep(const path::StepReport& report, const path::Series&) override {
    steps.push_back(report);
    conditions.push_back(problem.conditionsAt(report.next.state));
    if (!report.events.empty()) events.push_back(report.lambdaEnd);
    return true;
  }
};

path::Outcome followTo(HardColumn& column, const path::Start& start, double loadFactor, Seen& seen,
                       std::optional<double> weight = {}) {
  const auto solver = linear::makeTangentSolver();
  path::Stops stops;
  stops.loadFactors = {loadFactor};
  auto options = tightOptions();
  options.weight = weight;
  return path::PathFollower(*column.problem, *solver, options, stops).runFrom(start, seen);
}

double root(const std::function<double(double)>& f, double a, double b) {
  for (int i = 0; i < 200; ++i) {
    const double middle = (a + b) / 2;
    ((f(a) > 0) == (f(middle) > 0) ? a : b) = middle;
  }
  return (a + b) / 2;
}

/// A plane that comes, goes and comes again: the column's foot is reached at about lambda = 1, left at 2 and
/// reached at 3 (a little earlier and later, as a small load pulls the foot towards it).
struct ThereAndBack {
  MovingTool<Plane> plane;
  ThereAndBack() {
    const double c[] = {1 - 3.0 * 6, 3.0 * 11, -3.0 * 6, 3.0};  // 1 + 3 (x - 1)(x - 2)(x - 3)
    for (int k = 0; k < 4; ++k) plane.motion.shift[k][2] = c[k];
  }
  static double height(double lambda) { return 1 + 3 * (lambda - 1) * (lambda - 2) * (lambda - 3); }
};
constexpr double smallLoad = 0.05;
/// Of the path parameter: how little the load moves the column at the start says nothing about what the plane
/// does to it later.
constexpr double weight = 0.01;

/// Distance of the free foot from the plane.
double freeGap(double lambda) {
  const double w = root([&](double x) { return HardColumn::barForce(x) - smallLoad * lambda; }, 0, 1);
  return 1 - w - ThereAndBack::height(lambda);
}

}  // namespace

TEST(HardColumn, DeadLoadPressesItsFootOnAPlane) {
  for (const Where where : {Where::Nodes, Where::Quadrature}) {
    HardColumn column(Plane{}, 1, 1, where);
    Seen seen(*column.problem);
    const auto outcome = followTo(column, column.start(), 2, seen);
    ASSERT_EQ(outcome.reason, path::EndReason::stopReached) << outcome.text;
    // All four points together; the bound of the residual, 1e-10, over a stiffness of about 1.
    ASSERT_EQ(seen.events.size(), 1u);
    EXPECT_LE(outcome.steps, 4);  // to the event, from it, and two for the bar's own radius
    EXPECT_NEAR(seen.events[0], HardColumn::barForce(1), 1e-9);
    EXPECT_NEAR(column.w(*outcome.final.u), 1, 1e-9);
    EXPECT_NEAR(column.force(outcome.final), 2 - HardColumn::barForce(1), 1e-9);
    // Four quarters; at the cubature points of the face the pressure, force over its unit area.
    const double expected = (2 - HardColumn::barForce(1)) / (where == Where::Nodes ? 4 : 1);
    for (const double R : observed(*column.problem, 1, outcome.final, "contact_pressure"))
      EXPECT_NEAR(R, expected, 1e-8);
    for (const double h : observed(*column.problem, 1, outcome.final, "contact_gap")) EXPECT_NEAR(h, 0, 1e-9);
    EXPECT_EQ(column.problem->constraintPivots(), 4);
    // The multipliers' pivots are no instability.
    for (const auto& step : seen.steps) {
      ASSERT_TRUE(step.inertia);
      EXPECT_EQ(step.inertia->negative, 0);
    }
  }
}

TEST(HardColumn, ClosesOpensAndClosesAgain) {
  HardColumn column(ThereAndBack().plane, 1, smallLoad);
  EXPECT_TRUE(column.problem->symmetric());
  Seen seen(*column.problem);
  const auto outcome = followTo(column, column.start(), 3.2, seen, weight);
  ASSERT_EQ(outcome.reason, path::EndReason::stopReached) << outcome.text;
  ASSERT_EQ(seen.events.size(), 3u);
  const double brackets[3][2] = {{0.5, 1.2}, {1.8, 2.5}, {2.5, 3.2}};
  for (int i = 0; i < 3; ++i)
    EXPECT_NEAR(seen.events[i], root(freeGap, brackets[i][0], brackets[i][1]), 1e-9) << i;
  const double w = 1 - ThereAndBack::height(3.2);
  EXPECT_NEAR(column.w(*outcome.final.u), w, 1e-9);
  EXPECT_NEAR(column.force(outcome.final), smallLoad * 3.2 - HardColumn::barForce(w), 1e-9);
}

TEST(HardColumn, AStartThatTouches) {
  {
    HardColumn pressed(Plane{}, 0, 1);
    Seen seen(*pressed.problem);
    const auto outcome = followTo(pressed, pressed.start(), 1, seen);
    ASSERT_EQ(outcome.reason, path::EndReason::stopReached) << outcome.text;
    EXPECT_NEAR(pressed.w(*outcome.final.u), 0, 1e-9);
    EXPECT_NEAR(pressed.force(outcome.final), 1, 1e-9);
    EXPECT_TRUE(seen.events.empty());
  }
  HardColumn lifted(Plane{}, 0, -0.1);
  Seen seen(*lifted.problem);
  const auto outcome = followTo(lifted, lifted.start(), 1, seen);
  ASSERT_EQ(outcome.reason, path::EndReason::stopReached) << outcome.text;
  EXPECT_NEAR(HardColumn::barForce(lifted.w(*outcome.final.u)), -0.1, 1e-9);
  EXPECT_EQ(lifted.problem->constraintPivots(), 0);
}

/// A tool that moves from where it touches is all that drives the body.
TEST(HardColumn, DrivenByTheToolAlone) {
  MovingTool<Plane> plane;
  plane.motion.shift[1][2] = 1;
  HardColumn column(plane, 0, 0);
  Seen seen(*column.problem);
  const auto outcome = followTo(column, column.start(), 0.5, seen);
  ASSERT_EQ(outcome.reason, path::EndReason::stopReached) << outcome.text;
  EXPECT_NEAR(column.w(*outcome.final.u), -0.5, 1e-9);
  EXPECT_NEAR(column.force(outcome.final), -HardColumn::barForce(-0.5), 1e-9);
}

TEST(HardColumn, AStartInsideTheToolIsRefused) {
  HardColumn column(Plane{}, -0.1, 1);
  Seen seen(*column.problem);
  const auto outcome = followTo(column, column.start(), 1, seen);
  EXPECT_EQ(outcome.reason, path::EndReason::problemFailed);
  EXPECT_NE(outcome.text.find("inside the tool where the path starts"), std::string::npos) << outcome.text;
}

/// From any step on, given the conditions of the points: the same bits.
TEST(HardColumn, ARestartKeepsTheContactSet) {
  HardColumn whole(ThereAndBack().plane, 1, smallLoad);
  Seen all(*whole.problem);
  ASSERT_EQ(followTo(whole, whole.start(), 3.2, all, weight).reason, path::EndReason::stopReached);
  ASSERT_GE(all.steps.size(), 4u);
  for (std::size_t s = 0; s + 1 < all.steps.size(); ++s) {
    HardColumn again(ThereAndBack().plane, 1, smallLoad);
    Seen rest(*again.problem);
    followTo(again, all.steps[s].next, 3.2, rest, weight);
    ASSERT_EQ(rest.steps.size() + s + 1, all.steps.size());
    for (std::size_t i = 0; i < rest.steps.size(); ++i) {
      const auto &a = rest.steps[i], &b = all.steps[s + 1 + i];
      EXPECT_EQ(a.length, b.length);
      EXPECT_EQ(a.lambdaEnd, b.lambdaEnd);
      EXPECT_EQ(fem::FeProblem::values(*a.end.u), fem::FeProblem::values(*b.end.u));
      EXPECT_EQ(rest.conditions[i], all.conditions[s + 1 + i]);
    }
  }
  HardColumn other(ThereAndBack().plane, 1, smallLoad);
  EXPECT_THROW(other.problem->memoryOf({1, 0}), std::invalid_argument);
}
