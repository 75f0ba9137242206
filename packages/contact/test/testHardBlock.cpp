// Tangent, series and event functions of a whole problem with hard contact at nodes and over faces,
// conditions free and active.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "atrapos/contact/HardContactLaw.hpp"
#include "atrapos/contact/MovingTool.hpp"
#include "atrapos/fem/PointLawOf.hpp"
#include "atrapos/fem/UnilateralTerm.hpp"
#include "atrapos/path/SeriesStep.hpp"
#include "support/ContactModel.hpp"
#include "support/Derivatives.hpp"

using namespace atrapos;
using namespace atrapos::contact;
using namespace atrapos::contact::test;

namespace {

/// A cylinder below, at rest or moving.
Cylinder roll() { return {{0.4, 0, -2.005}, {0.28, 0.96, 0}, 2.0}; }
MovingTool<Cylinder> turning() {
  MovingTool<Cylinder> tool;
  tool.tool = roll();
  tool.motion.shift[1][2] = 0.3;
  tool.motion.angle[1] = 0.2;
  return tool;
}

/// A tool that the package does not compile, as laws in one piece.
using Taper = RadialRoll<TaperedProfile>;
fem::FeModel onTool(const fem::Mesh& mesh, const Taper& tool, Where where) {
  fem::FeModel model = solidModel(mesh, 10, 0.3);
  const fem::PointSet points = contactPoints(mesh, "z_min", where);
  const auto own =
      where == Where::Nodes ? fem::withMultipliers(model, points) : fem::withCornerMultipliers(model, points);
  model.terms.push_back(fem::unilateralTerm(fem::pointLaw(HardContactLaw<Taper>{tool}), own));
  return model;
}

template <class Tool>
fem::FeModel onTool(const fem::Mesh& mesh, const Tool& tool, Where where) {
  fem::FeModel model = solidModel(mesh, 10, 0.3);
  if (where == Where::Nodes)
    addHardContact(model, contactPoints(mesh, "z_min", where), tool);
  else
    addHardFaceContact(model, contactPoints(mesh, "z_min", where), tool);
  return model;
}

/// Every other condition is active.
fem::test::Memory alternating(const fem::FeProblem& problem) {
  auto conditions = problem.conditionsAt({});
  for (std::size_t i = 0; i < conditions.size(); ++i) conditions[i] = i % 2 == 0;
  return problem.memoryOf(conditions);
}

/// Displacements and multipliers of some size; those of free conditions are zero, as on any path.
Numbers someState(const fem::FeProblem& problem, const fem::Mesh& mesh, const std::vector<int>& conditions) {
  const std::size_t dofs = fem::FeProblem::values(*problem.initialState(0)).size();
  Numbers u = fem::test::randomNumbers(dofs, 0.08, 5);
  for (std::size_t p = 0; p < conditions.size(); ++p) {
    if (conditions[p] == 0) u[mesh.coordinates.size() + p] = 0;
  }
  return u;
}

template <class Tool>
void tangentIsDerivative(const Tool& tool, bool symmetric, Where where) {
  const auto mesh = fem::test::distorted(fem::test::box(fem::Topology::Hex20, {2, 2, 2}, {1, 1, 1}), 0.02);
  fem::FeProblem problem(onTool(mesh, tool, where));
  EXPECT_EQ(problem.symmetric(), symmetric);
  const auto memory = alternating(problem);
  const double lambda = 0.3;
  const auto& conditions = memory->conditions;
  const Numbers u = someState(problem, mesh, conditions);

  const auto K = fem::test::tangent(problem, u, lambda, memory);
  const double largest = fem::test::largest(K.value);
  if (symmetric) {
    for (std::size_t i = 0; i + 1 < K.start.size(); ++i)
      for (std::size_t e = K.start[i]; e < K.start[i + 1]; ++e) {
        // Sums of some 100 rounded products.
        ASSERT_NEAR(K.value[e], K.at(K.column[e], static_cast<int>(i)), 1e-13 * largest);
      }
  }

  // Central differences along random directions, lambda included: the error falls by 4. The multipliers of
  // free conditions stay zero: their force is left out of the tangent, so that it is symmetric.
  for (unsigned seed = 6; seed < 9; ++seed) {
    Numbers v = fem::test::randomNumbers(u.size(), 1, seed);
    for (std::size_t p = 0; p < conditions.size(); ++p) {
      if (conditions[p] == 0) v[mesh.coordinates.size() + p] = 0;
    }
    expectDerivative(problem, K, u, lambda, v, 0.7, 4e-3, memory);
  }
}

}  // namespace

TEST(HardBlock, TangentIsTheDerivativeOfTheResidual) {
  for (const Where where : {Where::Nodes, Where::Quadrature}) {
    tangentIsDerivative(roll(), true, where);
    tangentIsDerivative(turning(), true, where);
  }
  Taper taper;
  taper.center[2] = -2.005;
  taper.profile.radius = 2;
  tangentIsDerivative(taper, false, Where::Nodes);  // its normal is not the gradient of its gap
}

// The residual along a series of order K at an equilibrium falls as a^(K+1), and the event functions are the
// gaps and multipliers along it.
TEST(HardBlock, SeriesAndEventFunctions) {
  const auto mesh = fem::test::box(fem::Topology::Hex20, {2, 2, 2}, {1, 1, 1});
  auto model = onTool(mesh, turning(), Where::Nodes);
  for (int n : fem::test::nodesOfSet(mesh, "z_max"))
    for (int i = 0; i < 3; ++i) model.prescribe(n, i, 0, i == 2 ? -1.0 : 0.3);
  fem::FeProblem problem(std::move(model));
  auto start = follow(problem, {problem.initialState(0), 0.0}, 0.06, tightOptions(1e-9));
  const int active = problem.constraintPivots();
  EXPECT_GE(active, 3);
  EXPECT_LT(active, problem.eventCount());
  const Numbers u =
      fem::test::equilibrium(problem, 0.06, fem::FeProblem::values(*start.final.u), 1e-12, start.final.memory)
          .u;
  expectEventFunctions(problem, u, 0.06, start.final.memory, mesh.coordinates.size(),
                       [&](const fem::PointValues& shown) {
                         Numbers gaps;
                         for (int p = 0; p < problem.eventCount(); ++p) gaps.push_back(shown.values[2 * p]);
                         return gaps;
                       });
}
