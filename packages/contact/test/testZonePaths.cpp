// Paths of bodies whose zones of contact are born, pass from edge to edge, merge and die, on one rank and on
// several.
#include <gtest/gtest.h>
#include <mpi.h>

#include <Teuchos_DefaultMpiComm.hpp>
#include <algorithm>
#include <cmath>

#include "atrapos/contact/Cylinder.hpp"
#include "atrapos/contact/Plane.hpp"
#include "support/ContactModel.hpp"
#include "support/PatchSurfaces.hpp"
#include "support/PlaneContact.hpp"

using namespace atrapos;
using namespace atrapos::contact;
using namespace atrapos::contact::test;

namespace {

constexpr double kLength = 10, kHeight = 0.5;

fem::Mesh stripMesh(int cells, fem::Topology cell = fem::Topology::Quad8) {
  return planeMesh(cell, {cells, 1}, {kLength, kHeight});
}

/// A strip that is clamped on the left and pulled down on the right over a tool.
fem::FeModel strip(const fem::Mesh& mesh, bool alone, const RigidTool& tool, double load = -1) {
  fem::FeModel model = planeModel(mesh, {}, 1000, 0.2);
  for (const int n : fem::test::nodesOfSet(mesh, "x_min"))
    for (int i = 0; i < 2; ++i) model.prescribe(n, i, 0, 0);
  for (const int n : fem::test::nodesOfSet(mesh, "x_max")) model.load[2 * n + 1] = load;
  addZones(model, mesh, {}, tool, {2e3, 1});
  if (alone) model.comm = linear::rcp(new Teuchos::MpiComm<int>(MPI_COMM_SELF));
  return model;
}
/// Over a roll, which may move along it.
fem::FeModel strip(const fem::Mesh& mesh, bool alone, double slide = 0) {
  Motion motion;
  motion.shift[1][0] = slide;
  const auto roll =
      rigidTool(Cylinder{{5.3, -2.06, 0}, {0, 0, 1}, 2}, slide == 0 ? std::nullopt : std::optional(motion));
  return strip(mesh, alone, *roll, slide == 0 ? -1 : -0.1);
}
/// Over the same roll, of half the radius from 4 degrees behind its top on.
fem::FeModel stripOverArcs(const fem::Mesh& mesh, bool alone) {
  const double angle = std::acos(-1.0) / 2 - 0.07;
  return strip(mesh, alone, *rigidTool(std::make_shared<const PatchSet>(twoArcs(5.3, -2.06, 2, 1, angle))));
}

/// Events, and where the path went.
struct Walk final : path::Observer {
  std::vector<std::vector<int>> ofSteps;
  double worst = 0;
  bool onStep(const path::StepReport& report, const path::Series&) override {
    ofSteps.push_back(report.events);
    std::sort(ofSteps.back().begin(), ofSteps.back().end());
    worst = std::max(worst, report.residual);
    return true;
  }
};

path::Options loose(double bound) {
  path::Options options;
  options.delta = options.residualBound = bound;
  return options;
}

}  // namespace

// The end of a path is an equilibrium that Newton's method, which knows no events, finds as well; there and
// back.
TEST(ZonePaths, LeadToTheEquilibriumOfNewtonsMethod) {
  for (const auto cell : planeCells()) {
    SCOPED_TRACE(fem::topologyName(cell));
    const auto mesh = stripMesh(12, cell);
    fem::FeProblem problem(strip(mesh, true));
    Walk walk, back;
    const auto out = follow(problem, {problem.initialState(0), 0.0}, 1, walk, loose(1e-8));
    EXPECT_GE(out.events, 2);
    EXPECT_LT(walk.worst, 1e-8);
    const Numbers u = fem::FeProblem::values(*out.final.u);
    const Numbers exact = fem::test::equilibrium(problem, 1, u, 1e-11).u;
    // The bound of the residual times the condition of a thin body, some 1e3.
    EXPECT_LE(fem::test::largest(fem::test::sum(u, -1, exact)), 1e-5 * fem::test::largest(exact));
    const auto home = follow(problem, out.final, 0, back, loose(1e-8));
    EXPECT_GE(home.events, 2);
    EXPECT_LE(fem::test::largest(fem::FeProblem::values(*home.final.u)), 1e-5);
  }
}

// A roll that comes from afar, onto the node that two edges share, next to it and onto the middle of an edge:
// the zone is born on two edges at once, or on one and passes on to the other, and dies as it was born.
TEST(ZonePaths, RollOnANode) {
  const auto mesh = stripMesh(12);
  const double size = kLength / 12;
  std::vector<double> forces;
  for (const double off : {0.0, 1e-7, 1e-4, 1e-2, 0.5}) {
    SCOPED_TRACE(off);
    fem::FeModel model = planeModel(mesh, {}, 1000, 0.2);
    for (const char* const set : {"x_min", "x_max"})
      for (const int n : fem::test::nodesOfSet(mesh, set))
        for (int i = 0; i < 2; ++i) model.prescribe(n, i, 0, 0);
    Motion motion;
    motion.shift[1][1] = 1;
    const auto roll =
        rigidTool(Cylinder{{6 * size + off * size, -2.1, 0}, {0, 0, 1}, 2}, std::optional(motion));
    const auto lines = addZones(model, mesh, {}, *roll, {2e3, 1});
    model.comm = linear::rcp(new Teuchos::MpiComm<int>(MPI_COMM_SELF));
    fem::FeProblem problem(std::move(model));
    Walk walk, back;
    const auto out = follow(problem, {problem.initialState(0), 0.0}, 0.5, walk, loose(1e-8));
    ASSERT_EQ(out.reason, path::EndReason::stopReached) << out.text;
    EXPECT_GE(out.events, 1);
    EXPECT_LT(walk.worst, 1e-8);
    const Numbers u = fem::FeProblem::values(*out.final.u);
    const Numbers exact = fem::test::equilibrium(problem, 0.5, u, 1e-11).u;
    EXPECT_LE(fem::test::largest(fem::test::sum(u, -1, exact)), 1e-5 * fem::test::largest(exact));
    const Numbers pressures = observed(problem, 1, out.final, "contact_pressure");
    double force = 0;
    for (std::size_t i = 0; i < pressures.size(); ++i) force += lines.weights[i] * pressures[i];
    forces.push_back(force);
    const auto home = follow(problem, out.final, 0, back, loose(1e-8));
    ASSERT_EQ(home.reason, path::EndReason::stopReached) << home.text;
    EXPECT_GE(home.events, 1);
    EXPECT_LE(fem::test::largest(fem::FeProblem::values(*home.final.u)), 1e-8);
  }
  // Forces are even functions of the offset.
  EXPECT_NEAR(forces[1], forces[0], 1e-6 * forces[0]);
  EXPECT_NEAR(forces[2], forces[0], 1e-6 * forces[0]);
  EXPECT_NEAR(forces[3], forces[0], 1e-3 * forces[0]);
}

// The contact patch test, from a gap and from where all ends of edges touch at the start: they close
// together.
TEST(ZonePaths, FlatContactIsUniform) {
  constexpr double E = 10, alpha = 300, way = 0.1;
  for (const auto cell : planeCells())
    for (const double gap : {0.05, 0.0}) {
      SCOPED_TRACE(fem::topologyName(cell));
      const auto mesh = planeMesh(cell, {4, 2}, {2, 1}, {0, gap});
      fem::FeModel model = planeModel(mesh, {}, E, 0);
      for (const int n : fem::test::nodesOfSet(mesh, "x_min")) model.prescribe(n, 0, 0, 0);
      for (const int n : fem::test::nodesOfSet(mesh, "y_max")) model.prescribe(n, 1, 0, -way);
      const auto lines = addZones(model, mesh, {}, *rigidTool(Plane{{0, 0, 0}, {0, 1, 0}}), {alpha, 1});
      model.comm = linear::rcp(new Teuchos::MpiComm<int>(MPI_COMM_SELF));
      fem::FeProblem problem(std::move(model));
      const auto outcome = follow(problem, {problem.initialState(0), 0.0}, 1, loose(1e-9));
      EXPECT_LE(outcome.steps, 4);
      // Saint Venant-Kirchhoff under the stretch l of its height 1, on springs alpha.
      double p = 0;
      for (int i = 0; i < 50; ++i) {
        const double l = 1 - (way - gap - p / alpha);
        p = -E * l * (l * l - 1) / 2;
      }
      for (const double R : observed(problem, 1, outcome.final, "contact_gap"))
        EXPECT_NEAR(R, -p / alpha, 1e-9);
      const Numbers pressures = observed(problem, 1, outcome.final, "contact_pressure");
      double force = 0;
      for (std::size_t i = 0; i < pressures.size(); ++i) force += lines.weights[i] * pressures[i];
      EXPECT_NEAR(force, 2 * p, 1e-8);
    }
}

// Over the border of two arcs: each of the zone's limits that passes it ends a step at most, and the steps in
// between are few. The path leads to the equilibrium, there and back.
TEST(ZonePaths, OverTheBorderOfTwoArcs) {
  const auto mesh = stripMesh(12);
  fem::FeProblem smooth(strip(mesh, true)), problem(stripOverArcs(mesh, true));
  Walk walk, back;
  const auto out = follow(problem, {problem.initialState(0), 0.0}, 1, walk, loose(1e-8));
  ASSERT_EQ(out.reason, path::EndReason::stopReached) << out.text;
  EXPECT_LT(walk.worst, 1e-8);
  const auto onRoll = follow(smooth, {smooth.initialState(0), 0.0}, 1, loose(1e-8));
  EXPECT_LE(out.steps, onRoll.steps + 6);
  const Numbers u = fem::FeProblem::values(*out.final.u), onlyRoll = fem::FeProblem::values(*onRoll.final.u);
  const Numbers exact = fem::test::equilibrium(problem, 1, u, 1e-11).u;
  EXPECT_LE(fem::test::largest(fem::test::sum(u, -1, exact)), 1e-5 * fem::test::largest(exact));
  EXPECT_GT(fem::test::largest(fem::test::sum(u, -1, onlyRoll)), 1e-3 * fem::test::largest(exact));
  const auto home = follow(problem, out.final, 0, back, loose(1e-8));
  ASSERT_EQ(home.reason, path::EndReason::stopReached) << home.text;
  EXPECT_LE(fem::test::largest(fem::FeProblem::values(*home.final.u)), 1e-5);
}

// Steps go with events and not with the mesh nor the stiffness.
TEST(ZonePaths, RollThatSlidesFromEdgeToEdge) {
  int steps[2], events[2];
  for (int i = 0; i < 2; ++i) {
    const auto mesh = stripMesh(i == 0 ? 10 : 40);
    fem::FeProblem problem(strip(mesh, true, 2.0));
    Walk walk;
    const auto out = follow(problem, {problem.initialState(0), 0.0}, 1, walk, loose(1e-7));
    steps[i] = out.steps;
    events[i] = out.events;
    const Numbers end = fem::FeProblem::values(*out.final.u);
    const Numbers exact = fem::test::equilibrium(problem, 1, end, 1e-11).u;
    EXPECT_LE(fem::test::largest(fem::test::sum(end, -1, exact)), 1e-4 * fem::test::largest(exact));
  }
  EXPECT_GE(events[0], 3);
  EXPECT_GT(events[1], 2 * events[0]);
  EXPECT_LE(steps[0], 2 * events[0] + 12);
  EXPECT_LE(steps[1], 2 * events[1] + 12);
}

// Conditions, state and direction are all that a path needs to go on, also from a state at which an event is
// due.
TEST(ZonePaths, RunThatIsTakenUpAgainGoesTheSameWay) {
  for (const bool arcs : {false, true}) {
    const auto model = [&, mesh = stripMesh(12)] {
      return arcs ? stripOverArcs(mesh, true) : strip(mesh, true);
    };
    fem::FeProblem whole(model());
    struct Keep final : path::Observer {
      std::vector<path::Start> starts;
      std::vector<std::vector<int>> conditions;
      std::vector<double> ends;
      bool onStep(const path::StepReport& report, const path::Series& series) override {
        starts.push_back(report.next);
        ends.push_back(report.end.lambda);
        (void)series;
        return true;
      }
    } keep;
    follow(whole, {whole.initialState(0), 0.0}, 1, keep, loose(1e-7));
    ASSERT_GE(keep.starts.size(), 4u);
    for (std::size_t i = 0; i + 1 < keep.starts.size(); ++i) {
      fem::FeProblem again(model());
      Keep rest;
      const auto solver = linear::makeTangentSolver();
      path::Stops stops;
      stops.loadFactors = {1};
      path::PathFollower follower(again, *solver, loose(1e-7), stops);
      follower.runFrom(keep.starts[i], rest);
      ASSERT_EQ(rest.ends.size(), keep.ends.size() - i - 1) << i;
      for (std::size_t j = 0; j < rest.ends.size(); ++j)
        EXPECT_EQ(rest.ends[j], keep.ends[i + 1 + j]) << i << ' ' << j;
    }
  }
}

TEST(ZoneRanks, SumsAndEventsAreThoseOfOneRank) {
  for (const bool arcs : {false, true}) {
    const auto mesh = stripMesh(12);
    const auto model = [&](bool alone) { return arcs ? stripOverArcs(mesh, alone) : strip(mesh, alone); };
    fem::FeProblem shared(model(false)), whole(model(true));
    ASSERT_EQ(shared.eventCount(), whole.eventCount());
    Walk walk, walk1;
    const auto end = follow(shared, {shared.initialState(0), 0.0}, 1, walk, loose(1e-8));
    const auto end1 = follow(whole, {whole.initialState(0), 0.0}, 1, walk1, loose(1e-8));
    EXPECT_EQ(walk.ofSteps, walk1.ofSteps);
    EXPECT_EQ(shared.conditionsAt(end.final), whole.conditionsAt(end1.final));
    const auto& memory = end1.final.memory;
    const Numbers u = fem::FeProblem::values(*end.final.u), u1 = fem::FeProblem::values(*end1.final.u);
    // Rounding of sums at shared nodes, times the condition of the strip.
    EXPECT_LE(fem::test::largest(fem::test::sum(u, -1, u1)), 1e-8 * fem::test::largest(u1));
    const Numbers x = fem::test::randomNumbers(u.size(), 1, 6);
    const auto K = fem::test::tangentTimes(shared, u1, 1, x, memory),
               K1 = fem::test::tangentTimes(whole, u1, 1, x, memory);
    EXPECT_LE(fem::test::largest(fem::test::sum(K.Kx, -1, K1.Kx)), 1e-12 * fem::test::largest(K1.Kx));
    const auto seen = shared.observe(1, {fem::test::vectorOf(shared, u1), 1, memory}),
               seen1 = whole.observe(1, {fem::test::vectorOf(whole, u1), 1, memory});
    EXPECT_LE(fem::test::largest(fem::test::sum(seen.values, -1, seen1.values)),
              1e-12 * fem::test::largest(seen1.values));
  }
}
