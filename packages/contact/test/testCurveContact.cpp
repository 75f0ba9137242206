// Law (15) with the place on its curve as unknown: the same solutions as with R condensed at the point.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "atrapos/contact/MovingTool.hpp"
#include "atrapos/fem/Loads.hpp"
#include "support/ContactModel.hpp"
#include "support/Derivatives.hpp"
#include "support/PatchSurfaces.hpp"

using namespace atrapos;
using namespace atrapos::contact;
using namespace atrapos::contact::test;

namespace {

/// One HEX8 of unit cross-section held at its top, its lower face at z = 1 over a plane, pulled down by
/// lambda.
fem::FeModel column(const fem::Mesh& mesh) {
  fem::FeModel model = solidModel(mesh, 4, 0);
  for (int n : fem::test::nodesOfSet(mesh, "x_min")) model.prescribe(n, 0, 0, 0);
  for (int n : fem::test::nodesOfSet(mesh, "y_min")) model.prescribe(n, 1, 0, 0);
  for (int n : fem::test::nodesOfSet(mesh, "z_max")) model.prescribe(n, 2, 0, 0);
  fem::addSurfaceForce(mesh, fem::test::sideSet(mesh, "z_min"), {0, 0, -1}, model.load);
  return model;
}

struct Result {
  double w = 0, force = 0;
  path::Outcome outcome;
  std::vector<long long> negative;  ///< pivots at the start of every step
};

Result followed(const fem::Mesh& mesh, fem::FeModel model, double lambda) {
  struct Inertias final : path::Observer {
    std::vector<long long> negative;
    bool onStep(const path::StepReport& report, const path::Series&) override {
      negative.push_back(report.inertia ? report.inertia->negative : -1);
      return true;
    }
  } seen;
  fem::FeProblem problem(std::move(model));
  EXPECT_TRUE(problem.symmetric());
  Result result;
  result.outcome = follow(problem, {problem.initialState(0), 0.0}, lambda, seen);
  result.negative = seen.negative;
  result.w =
      -fem::FeProblem::values(*result.outcome.final.u)[3 * fem::test::nodesOfSet(mesh, "z_min").at(0) + 2];
  result.force = -resultant(problem.forces(problem.term(1), result.outcome.final))[2];
  return result;
}

}  // namespace

TEST(CurveContact, ColumnAsWithThePressureCondensed) {
  const auto mesh = fem::test::box(fem::Topology::Hex8, {1, 1, 1}, {1, 1, 4}, {0, 0, 1});
  const auto points = contactPoints(mesh, "z_min", Where::Nodes);
  for (const RegularisedPressure law :
       {RegularisedPressure{1e-2, 1e-2}, RegularisedPressure{1e-5, 1e-4}, RegularisedPressure{0, 1e-3}}) {
    for (const double lambda : {0.5, 1.4, 1.5, 3.0}) {  // closes at about 1.406
      auto condensed = column(mesh), onCurve = column(mesh);
      addContact(condensed, points, Plane{}, law, 0);
      addCurveContact(onCurve, points, Plane{}, law, Numbers(points.numPoints(), 1.0));
      const Result a = followed(mesh, std::move(condensed), lambda),
                   b = followed(mesh, std::move(onCurve), lambda);
      // Residuals below 1e-10; the column's stiffness is about 1.
      EXPECT_NEAR(a.w, b.w, 1e-8) << law.eta << ' ' << lambda;
      EXPECT_NEAR(a.force, b.force, 1e-8) << law.eta << ' ' << lambda;
      for (const long long n : b.negative) EXPECT_EQ(n, 0);
    }
  }
}

/// Every step moves by as much along the curve: a nearly hard law takes few, at most half as many.
TEST(CurveContact, FewerStepsOnAColumn) {
  const auto mesh = fem::test::box(fem::Topology::Hex8, {1, 1, 1}, {1, 1, 4}, {0, 0, 1});
  const auto points = contactPoints(mesh, "z_min", Where::Nodes);
  const RegularisedPressure law{0, 1e-6};
  auto condensed = column(mesh), onCurve = column(mesh);
  addContact(condensed, points, Plane{}, law, 0);
  addCurveContact(onCurve, points, Plane{}, law, Numbers(points.numPoints(), 1.0));
  const Result a = followed(mesh, std::move(condensed), 3), b = followed(mesh, std::move(onCurve), 3);
  EXPECT_LE(2 * b.outcome.steps, a.outcome.steps);
}

// Tangent and load direction of a body on a cylinder that moves, against central differences.
TEST(CurveContact, TangentIsTheSymmetricDerivativeOfTheResidual) {
  const auto mesh = fem::test::distorted(fem::test::box(fem::Topology::Hex20, {2, 2, 2}, {1, 1, 1}), 0.02);
  MovingTool<Cylinder> tool;
  tool.tool = {{0.4, 0, -2.005}, {0.28, 0.96, 0}, 2.0};
  tool.motion.shift[1][2] = 0.3;
  auto model = solidModel(mesh, 10, 0.3);
  const auto points = contactPoints(mesh, "z_min", Where::Nodes);
  addCurveContact(model, points, tool, {1e-1, 1e-1}, Numbers(points.numPoints(), 0.05));
  fem::FeProblem problem(std::move(model));
  const std::size_t dofs = fem::FeProblem::values(*problem.initialState(0)).size();
  Numbers u = fem::test::randomNumbers(dofs, 0.08, 5);
  for (std::size_t d = mesh.coordinates.size(); d < dofs; ++d) u[d] *= 10;  // t between -0.8 and 0.8
  const double lambda = 0.3;
  const auto K = fem::test::tangent(problem, u, lambda);
  const double largest = fem::test::largest(K.value);
  for (std::size_t i = 0; i + 1 < K.start.size(); ++i)
    for (std::size_t e = K.start[i]; e < K.start[i + 1]; ++e)
      // Sums of some 100 rounded products.
      ASSERT_NEAR(K.value[e], K.at(K.column[e], static_cast<int>(i)), 1e-13 * largest);
  expectDerivative(problem, K, u, lambda, fem::test::randomNumbers(dofs, 1, 6), 0.7, 4e-3);
}

namespace {

/// A block over a tool, pushed down and aside by its top.
fem::FeModel pushed(const fem::Mesh& mesh, double aside) {
  fem::FeModel model = solidModel(mesh, 10, 0.3);
  for (int n : fem::test::nodesOfSet(mesh, "z_max"))
    for (int i = 0; i < 3; ++i) model.prescribe(n, i, 0, i == 2 ? -0.12 : i == 0 ? aside : 0);
  return model;
}

Numbers bodyOf(const fem::Mesh& mesh, const path::Outcome& outcome) {
  Numbers u = fem::FeProblem::values(*outcome.final.u);
  u.resize(mesh.coordinates.size());
  return u;
}

}  // namespace

// The roll as a NURBS surface, points on it from the start of the path to its end.
TEST(CurveContact, SameRollAsPatches) {
  const auto mesh = fem::test::distorted(fem::test::box(fem::Topology::Hex8, {3, 3, 2}, {1, 1, 1}), 0.02);
  const auto points = contactPoints(mesh, "z_min", Where::Nodes);
  const Cylinder roll{{0.4, 0, -2.05}, {0.28, 0.96, 0}, 2.0};
  const RegularisedPressure law{1e-5, 1e-4};
  const Numbers gaps(points.numPoints(), 0.05);
  fem::FeModel implicit = pushed(mesh, 0), patches = pushed(mesh, 0);
  addCurveContact(implicit, points, roll, law, gaps);
  addCurveContact(patches, points, searchOf(nurbsCylinder(roll, 5).patches()), law, gaps);
  fem::FeProblem a(std::move(implicit)), b(std::move(patches));
  const auto endA = follow(a, {a.initialState(0), 0.0}, 1.0), endB = follow(b, {b.initialState(0), 0.0}, 1.0);
  EXPECT_NEAR(endA.steps, endB.steps, 1);
  EXPECT_GT(-resultant(a.forces(a.term(1), endA.final))[2], 0.1);
  const Numbers u = bodyOf(mesh, endA), v = bodyOf(mesh, endB);
  for (std::size_t i = 0; i < u.size(); ++i) EXPECT_NEAR(v[i], u[i], 1e-8);  // bound of the residual: 1e-10
}

// Points beyond the edge carry nothing, others cross a border where the curvature jumps: as with
// the pressure condensed at the points.
TEST(CurveContact, PatchesAsWithThePressureCondensed) {
  const auto mesh = fem::test::box(fem::Topology::Hex8, {3, 3, 2}, {1, 1, 1});
  const auto points = contactPoints(mesh, "z_min", Where::Nodes);
  const RegularisedPressure law{1e-3, 1e-3};
  BezierPatch plate, arc;
  plate.points = {{-1, -1, -0.05}, {-1, 2, -0.05}, {0.36, -1, -0.05}, {0.36, 2, -0.05}};
  arc.degree = {2, 1};
  arc.points = {{0.36, -1, -0.05}, {0.36, 2, -0.05},  {0.6, -1, -0.05},
                {0.6, 2, -0.05},   {0.85, -1, -0.02}, {0.85, 2, -0.02}};
  for (const double aside : {0.0, 0.1}) {
    fem::FeModel condensed = pushed(mesh, aside), onCurve = pushed(mesh, aside);
    const auto surface = searchOf({plate, arc});
    addPatchContact(condensed, points, surface, law, 0.05);
    Numbers gaps;  // those of addPatchContact
    for (int p = 0; p < points.numPoints(); ++p)
      gaps.push_back(std::max(project(*surface.set, {points.positions[3 * p], points.positions[3 * p + 1],
                                                     points.positions[3 * p + 2]})[0],
                              0.05));
    for (double& gap : gaps)
      if (std::isnan(gap)) gap = 0.05;
    addCurveContact(onCurve, points, surface, law, gaps);
    fem::FeProblem a(std::move(condensed)), b(std::move(onCurve));
    struct Breaks final : path::Observer {
      int count = 0;
      bool onStep(const path::StepReport& report, const path::Series&) override {
        count += static_cast<int>(report.events.size());
        return true;
      }
    } breaks;
    const auto endA = follow(a, {a.initialState(0), 0.0}, 0.8),
               endB = follow(b, {b.initialState(0), 0.0}, 0.8, breaks);
    if (aside > 0) {
      EXPECT_GE(breaks.count, 1);
    }
    const auto R = observed(b, 1, endB.final, "contact_pressure"),
               h = observed(b, 1, endB.final, "contact_gap");
    const auto R1 = observed(a, 1, endA.final, "contact_pressure");
    EXPECT_EQ(std::count_if(h.begin(), h.end(), [](double gap) { return std::isinf(gap); }), 4);
    for (std::size_t p = 0; p < R.size(); ++p) EXPECT_NEAR(R[p], R1[p], 1e-6);  // see below; stiffness is 10
    const Numbers u = bodyOf(mesh, endA), v = bodyOf(mesh, endB);
    for (std::size_t i = 0; i < u.size(); ++i) EXPECT_NEAR(v[i], u[i], 1e-7);  // bound of the residual: 1e-10
  }
}

// Tangent and load direction of a body on a NURBS roll that moves, against central differences.
TEST(CurveContact, TangentOnMovingPatches) {
  const auto mesh = fem::test::distorted(fem::test::box(fem::Topology::Hex8, {2, 2, 2}, {1, 1, 1}), 0.02);
  const Cylinder roll{{0.4, 0, -2.005}, {0.28, 0.96, 0}, 2.0};
  const auto set = std::make_shared<const PatchSet>(nurbsCylinder(roll, 5).patches());
  MovingTool<PatchTool> tool{set->tool(), {}};
  tool.motion.shift[1][2] = 0.3;
  tool.motion.angle[1] = 0.2;
  auto model = solidModel(mesh, 10, 0.3);
  const auto points = contactPoints(mesh, "z_min", Where::Nodes);
  addCurveContact(model, points, PatchSearch<MovingTool<PatchTool>>{set, tool}, {1e-1, 1e-1},
                  Numbers(points.numPoints(), 0.05));
  fem::FeProblem problem(std::move(model));
  const std::size_t dofs = fem::FeProblem::values(*problem.initialState(0)).size();
  Numbers u = fem::test::randomNumbers(dofs, 0.08, 5);
  for (std::size_t d = mesh.coordinates.size(); d < dofs; ++d) u[d] *= 10;
  const double lambda = 0.3;
  const auto K = fem::test::tangent(problem, u, lambda);
  expectDerivative(problem, K, u, lambda, fem::test::randomNumbers(dofs, 1, 6), 0.7, 4e-3);
}

TEST(CurveContact, RefusesAGapBelowTheBound) {
  const auto mesh = fem::test::box(fem::Topology::Hex8, {1, 1, 1}, {1, 1, 4}, {0, 0, 1});
  auto model = column(mesh);
  const auto points = contactPoints(mesh, "z_min", Where::Nodes);
  EXPECT_THROW(addCurveContact(model, points, Plane{}, {1, 0.1}, Numbers(points.numPoints(), 0.05)),
               std::invalid_argument);
}
