// A tool that moves on to a body at rest is the body that moves on to the tool.
#include <gtest/gtest.h>

#include "atrapos/contact/MovingTool.hpp"
#include "support/Column.hpp"

using namespace atrapos;
using namespace atrapos::contact;
using namespace atrapos::contact::test;

namespace {

/// The column of Column.hpp with its top held, and a plane that rises by lambda.
std::unique_ptr<fem::FeProblem> risingPlane(const Column& column) {
  const fem::Mesh& mesh = column.mesh;
  fem::FeModel model = solidModel(mesh, column.E, 0);
  for (int n : fem::test::nodesOfSet(mesh, "x_min")) model.prescribe(n, 0, 0, 0);
  for (int n : fem::test::nodesOfSet(mesh, "y_min")) model.prescribe(n, 1, 0, 0);
  for (int n : fem::test::nodesOfSet(mesh, "z_max")) model.prescribe(n, 2, 0, 0);
  MovingTool<Plane> tool;
  tool.motion.shift[1][2] = 1;
  const fem::PointSet points = contactPoints(mesh, "z_min", Where::Quadrature);
  model.terms.push_back(
      rigid(tool)->term(AnyPressure(column.pressure), points, Numbers(points.numPoints(), column.gap)));
  return std::make_unique<fem::FeProblem>(std::move(model));
}

}  // namespace

TEST(MovingColumn, SamePathAsTheMovingBody) {
  const Column driven({1e-3, 1e-2}, Where::Quadrature, 0, 1);
  const auto rising = risingPlane(driven);
  EXPECT_TRUE(rising->term(1).seesLoadFactor());
  for (const double lambda : {0.5, 0.95, 1.2}) {
    const auto a = follow(*driven.problem, driven.start(), lambda);
    const auto b = follow(*rising, {rising->initialState(0), 0.0}, lambda);
    // Both paths are corrected to a relative residual of 1e-10; the stiffness at the foot is one or more.
    EXPECT_NEAR(driven.w(*a.final.u) - lambda, driven.w(*b.final.u), 1e-8);
    EXPECT_NEAR(driven.assembledForce(a.final), -resultant(rising->forces(rising->term(1), b.final))[2],
                1e-8);
    EXPECT_NEAR(driven.imbalance(driven.w(*b.final.u) + lambda, lambda), 0, 1e-8);
  }
}
