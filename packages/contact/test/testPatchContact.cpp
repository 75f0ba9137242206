// A body pressed on a roll that is a NURBS surface, polynomial patches or the implicit cylinder: one path.
#include <gtest/gtest.h>

#include <cmath>

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

/// Contact with patches: four data a point, found by the global search.
void addContact(fem::FeModel& model, const fem::PointSet& points, const PatchSet& set, double least) {
  std::vector<double> data;
  for (int p = 0; p < points.numPoints(); ++p) {
    const double* x = &points.positions[3 * p];
    const auto place = set.locate(x);
    double y[6] = {};
    if (place[0] >= 0) taylor::solveImplicit<3, 6, 3>(set.tool(), x, place.data(), y);
    data.insert(data.end(), {std::max(y[0], least), place[0], place[1], place[2]});
  }
  using Law = ContactLaw<PatchTool>;
  model.terms.push_back(
      std::make_unique<fem::LawTerm<Law, fem::CurrentPosition>>(Law{set.tool(), pressure}, points, data));
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
  addContact(nurbs, points, PatchSet(nurbsCylinder(roll(), 5).patches()), least);
  addContact(bezier, points, PatchSet(bezierCylinder(roll(), 5, 7)), least);
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

// Part of the face beyond the edge of the tool: those points carry nothing.
TEST(PatchContact, PointsBeyondTheEdgeCarryNothing) {
  const auto mesh = block();
  const auto points = contactPoints(mesh, "z_min", Where::Quadrature, 2);
  BezierPatch plate;  // under the half of the face with x < 0.5
  plate.points = {{-1, -1, -0.01}, {-1, 2, -0.01}, {0.5, -1, -0.01}, {0.5, 2, -0.01}};
  const PatchSet set({plate});
  fem::FeModel model = pushed(mesh);
  addContact(model, points, set, 1e-3);
  fem::FeProblem problem(std::move(model));
  const path::State start{problem.initialState(0), 0.0};
  const auto outcome = follow(problem, start, 1.0);
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

}  // namespace
