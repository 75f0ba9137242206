// Blocks pressed on rigid tools: equilibrium of forces and moments, uniform pressure, a body held by contact
// only.
#include <gtest/gtest.h>

#include "atrapos/fem/Loads.hpp"
#include "support/ContactModel.hpp"

using namespace atrapos;
using namespace atrapos::contact;
using namespace atrapos::contact::test;

namespace {

void press(fem::FeModel& model, const fem::Mesh& mesh, const std::string& set) {
  for (int n : fem::test::nodesOfSet(mesh, set)) {
    model.prescribe(n, 0, 0, 0);
    model.prescribe(n, 1, 0, 0);
    model.prescribe(n, 2, 0, -1);  // down by the load factor
  }
}

// A clamped top is driven down on to a skew cylinder. In equilibrium the forces and, about the origin in the
// displaced configuration, the moments of supports and tool balance.
TEST(Block, SupportsCarryTheContactForce) {
  for (const Where where : {Where::Nodes, Where::Quadrature}) {
    const auto mesh = fem::test::box(fem::Topology::Hex20, {4, 2, 2}, {3, 2, 1.5}, {0, 0, 0.05});
    fem::FeModel model = solidModel(mesh, 10, 0.3);
    press(model, mesh, "z_max");
    const Cylinder tool{{1.6, 0, -4.0}, {0.28, 0.96, 0}, 4.0};
    const double share = where == Where::Nodes ? 0.1 : 1.0;  // about the area of a node
    addContact(model, contactPoints(mesh, "z_min", where), tool, {1e-4 / share, 1e-2 * share}, 0);
    fem::FeProblem problem(std::move(model));
    const double bound = 1e-8;
    const auto outcome = follow(problem, {problem.initialState(0), 0.0}, 0.2, tightOptions(bound));
    const auto& u = *outcome.final.u;
    const Numbers values = fem::FeProblem::values(u);
    const Numbers contact = problem.forces(problem.term(1), outcome.final);  // minus the forces on the body
    const Numbers reactions = problem.reactions(outcome.final);
    const auto norm = fem::test::residual(problem, values, 0.2).norm;
    EXPECT_LE(norm.relative(), bound);
    // The free rows leave a residual of this norm; a sum of n of its entries is at most sqrt(n) of it. Lever
    // arms are below 4. Rounding adds some 1e-16 of the nodal forces, far less.
    const double tolerance = std::sqrt(mesh.numNodes()) * norm.norm + 1e-12 * norm.scale;
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(resultant(reactions)[i], resultant(contact)[i], tolerance);
      EXPECT_NEAR(moment(mesh, values, reactions)[i], moment(mesh, values, contact)[i], 6 * tolerance);
    }
    EXPECT_GT(-resultant(contact)[2], 0.1);  // pressed: E A strain is about 6 if all of it were compressed
    EXPECT_GT(std::abs(resultant(contact)[0]), 100 * tolerance);  // and not only upwards

    const Numbers pressures = observed(problem, 1, outcome.final, "contact_pressure");
    const Numbers gaps = observed(problem, 1, outcome.final, "contact_gap");
    EXPECT_GT(*std::max_element(pressures.begin(), pressures.end()), 0.1 * share);
    EXPECT_GT(*std::max_element(gaps.begin(), gaps.end()), 0.05);  // the edges are still off the tool
  }
}

/// Pressures under a flat block whose top is pressed down evenly and slides freely.
Numbers flatPressures(fem::Topology cell, Where where) {
  auto mesh = fem::test::box(cell, {3, 2, 2}, {1.5, 1, 1}, {0, 0, 0.1});
  fem::FeModel model = solidModel(mesh, 10, 0.3);
  for (int n : fem::test::nodesOfSet(mesh, "x_min")) model.prescribe(n, 0, 0, 0);
  for (int n : fem::test::nodesOfSet(mesh, "y_min")) model.prescribe(n, 1, 0, 0);
  for (int n : fem::test::nodesOfSet(mesh, "z_max")) model.prescribe(n, 2, 0, -1);
  addContact(model, contactPoints(mesh, "z_min", where), Plane{}, {1e-2, 1e-2}, 0);
  fem::FeProblem problem(std::move(model));
  const auto outcome = follow(problem, {problem.initialState(0), 0.0}, 0.2);
  return observed(problem, 1, outcome.final, "contact_pressure");
}

double spread(const Numbers& x) {
  const auto [least, most] = std::minmax_element(x.begin(), x.end());
  return (*most - *least) / *most;
}

// The contact patch test: a uniform pressure is an equilibrium of quadrature points on any cell.
TEST(Block, FlatContactIsUniformAtQuadraturePoints) {
  for (const fem::Topology cell : fem::test::allCells()) {
    const Numbers R = flatPressures(cell, Where::Quadrature);
    EXPECT_GT(R[0], 0.5) << fem::topologyName(cell);  // 10 % of E = 10, less the contact's own compliance
    // The residual 1e-10 of forces of about 1, shared by nodes of 1/10 of the area, amplified by the body.
    EXPECT_LT(spread(R), 1e-7) << fem::topologyName(cell);
  }
}

// One law at every node is no uniform pressure: corners have a quarter of the area of inner nodes, and
// mid-side nodes of quadratic faces the most. That is the nodal law's meaning, not an error: only the total
// agrees.
TEST(Block, FlatContactIsNotUniformAtNodes) {
  EXPECT_GT(spread(flatPressures(fem::Topology::Hex8, Where::Nodes)), 0.3);
  EXPECT_GT(spread(flatPressures(fem::Topology::Hex20, Where::Nodes)), 0.3);
}

// A block that nothing but the law holds against falling: R = P/A whatever the body does, so the gap is the
// inverse of (15), h = (eta Delta - R^2/alpha)/(R + eta), and the top follows the closed form of a bar.
TEST(Block, HeldByContactOnly) {
  const double E = 5, Delta = 0.3, area = 2;
  for (const RegularisedPressure& law : {RegularisedPressure{1e-3, 0.1}, RegularisedPressure{0, 0.1}}) {
    const auto mesh = fem::test::box(fem::Topology::Hex8, {2, 1, 2}, {2, 1, 1}, {0, 0, Delta});
    fem::FeModel model = solidModel(mesh, E, 0);
    for (int n : fem::test::nodesOfSet(mesh, "x_min")) model.prescribe(n, 0, 0, 0);
    for (int n : fem::test::nodesOfSet(mesh, "y_min")) model.prescribe(n, 1, 0, 0);
    fem::addSurfaceForce(mesh, fem::test::sideSet(mesh, "z_max"), {0, 0, -area * E}, model.load);
    addContact(model, contactPoints(mesh, "z_min", Where::Quadrature), Plane{}, law, 0);
    fem::FeProblem problem(std::move(model));
    const auto outcome = follow(problem, {problem.initialState(0), 0.0}, 0.1);
    EXPECT_NEAR(outcome.final.lambda, 0.1, 1e-14);
    const double R = 0.1 * E, h = (law.eta * Delta - law.compliance * R * R) / (R + law.eta);
    for (const double r : observed(problem, 1, outcome.final, "contact_pressure")) EXPECT_NEAR(r, R, 1e-8);
    // Residual 1e-10 of forces of about 1 over the stiffness dR/dh, which is above 1 here, and E.
    for (const double g : observed(problem, 1, outcome.final, "contact_gap")) EXPECT_NEAR(g, h, 1e-8);
    const Numbers u = fem::FeProblem::values(*outcome.final.u);
    const double s = 1 + u[3 * fem::test::nodesOfSet(mesh, "z_max")[0] + 2] - (h - Delta);
    EXPECT_NEAR(s * (s * s - 1) / 2, -0.1, 1e-8);
  }
}

// The tool stops a body that is not there yet and lets a rigid one through nowhere: a state pressed through a
// rigid surface is refused with a reason, not followed.
TEST(Block, RigidContactRefusesAPenetratingStart) {
  const auto mesh = fem::test::box(fem::Topology::Hex8, {1, 1, 1}, {1, 1, 1}, {0, 0, -0.1});
  fem::FeModel model = solidModel(mesh, 1, 0);
  press(model, mesh, "z_max");
  addContact(model, contactPoints(mesh, "z_min", Where::Nodes), Plane{}, {0, 0.1}, 1.0);
  fem::FeProblem problem(std::move(model));
  const auto solver = linear::makeTangentSolver();
  path::PathFollower follower(problem, *solver, {});
  NoObserver observer;
  const auto outcome = follower.run({problem.initialState(0), 0.0}, observer);
  EXPECT_EQ(outcome.reason, path::EndReason::notFinite) << outcome.text;
  EXPECT_EQ(outcome.steps, 0);
}

}  // namespace
