// The laws of rubber in plane bodies and shells.
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "RubberLaws.hpp"
#include "ShellChecks.hpp"
#include "atrapos/fem/EnhancedTerm.hpp"
#include "atrapos/fem/LawTerm.hpp"
#include "atrapos/fem/ReferenceCell.hpp"
#include "atrapos/fem/StructuredPlane.hpp"
#include "atrapos/solid/PlaneBody.hpp"
#include "support/Checks.hpp"
#include "support/Meshes.hpp"

using namespace atrapos;
using namespace atrapos::solid;
using namespace atrapos::solid::test;
using namespace atrapos::fem::test;
using Kind = PlaneSection::Kind;
using Numbers = std::vector<double>;

namespace {

template <class Law>
class RubberBodies : public testing::Test {};

fem::Mesh rectangle(double x0 = 0) {
  fem::RectangleOptions options;
  options.topology = fem::Topology::Quad8;
  options.divisions = {2, 1};
  options.lengths = {1, 0.5};
  options.origin = {x0, 0};
  return fem::rectangleMesh(options);
}

template <class Law>
fem::FeModel body(const fem::Mesh& mesh, const PlaneSection& section) {
  fem::FeModel model;
  model.dofs = fem::DofMap::displacements(mesh.numNodes(), 2);
  const fem::Block& block = mesh.blocks[0];
  model.terms.push_back(fem::lawTerm(planeLaw(fem::pointLaw(rubber<Law>()), section.kind),
                                     planePoints(mesh, block, fem::tabulate(block.topology), section)));
  return model;
}

/// Five curved elements: no multiple of the lanes.
template <class Law>
fem::FeModel shell(Shear shear) {
  const ShellGrid grid = shellGrid(5, 1, 0.2, cylinder(1, 0, 1.5, 0, 0.7));
  fem::FeModel model;
  model.dofs = fem::DofMap::displacements(2 * grid.numNodes());
  if (shear == Shear::assumed)
    model.terms.push_back(fem::enhancedTerm(fem::pointLaw(AssumedShearLaw<Law>{rubber<Law>()}),
                                            assumedShearPoints(grid.elements())));
  else
    model.terms.push_back(
        fem::enhancedTerm(fem::pointLaw(ShellLaw<Law>{rubber<Law>()}), shellPoints(grid.elements())));
  clamp(model, grid, grid.lineI(0));
  model.load = randomNumbers(model.dofs.numDofs(), 0.002, 3);
  model.constantLoad.assign(model.load.size(), 0.0);
  return model;
}

}  // namespace

TYPED_TEST_SUITE(RubberBodies, RubberTypes);

// Stretched along x and y: the forces on the sides are those of the principal stresses, in plane stress with
// the thickness at which nothing acts on the faces.
TYPED_TEST(RubberBodies, PlaneStretchIsTheClosedForm) {
  const TypeParam law = rubber<TypeParam>();
  const Real x = 1.4L, y = 0.9L;
  const fem::Mesh mesh = rectangle();
  for (const Kind kind : {Kind::strain, Kind::stress}) {
    fem::FeProblem problem(body<TypeParam>(mesh, {kind, 0.2}));
    Numbers u(problem.model().dofs.numDofs());
    for (int n = 0; n < mesh.numNodes(); ++n) {
      u[2 * n] = static_cast<double>(x - 1) * mesh.coordinates[3 * n];
      u[2 * n + 1] = static_cast<double>(y - 1) * mesh.coordinates[3 * n + 1];
    }
    const Numbers r = residual(problem, u, 0).r;
    const Real z = kind == Kind::stress ? freeStretch(law, x, y, false) : 1;
    const double P[2] = {static_cast<double>(principalStress(law, Stretches{x, y, z})),
                         static_cast<double>(principalStress(law, Stretches{y, z, x}))};
    double force[2] = {0, 0};
    for (const int n : nodesOfSet(mesh, "x_max")) force[0] += r[2 * n];
    for (const int n : nodesOfSet(mesh, "y_max")) force[1] += r[2 * n + 1];
    EXPECT_NEAR(force[0], P[0] * 0.5 * 0.2, rounding);
    EXPECT_NEAR(force[1], P[1] * 1.0 * 0.2, rounding);
  }
}

TYPED_TEST(RubberBodies, PlaneTangentAndOrders) {
  const fem::Mesh mesh = rectangle(1);
  for (const Kind kind : {Kind::strain, Kind::stress, Kind::axisymmetric}) {
    SCOPED_TRACE(static_cast<int>(kind));
    const auto model = [&] {
      fem::FeModel m = body<TypeParam>(mesh, {kind, 0.2});
      for (const int n : nodesOfSet(mesh, "y_min")) m.prescribe(n, 1, 0, 0.3);
      for (const int n : nodesOfSet(mesh, "x_min")) m.prescribe(n, 0, 0.02, 0);
      m.load = randomNumbers(m.dofs.numDofs(), 0.01, 5);
      return m;
    };
    checkTangent(model());
    checkOrders(model());
  }
}

TYPED_TEST(RubberBodies, ShellTangentAndOrders) {
  for (const Shear shear : {Shear::compatible, Shear::assumed}) {
    fem::FeModel model = shell<TypeParam>(shear);
    // A state whose remainders lie above rounding with all laws.
    const Numbers u = randomState(model, 0.02, 19), direction = randomState(model, 0.02, 18);
    fem::FeProblem problem(std::move(model));
    expectTangent(problem, u, direction, 0);
    expectOrders(problem, u, 0.4);
  }
}
