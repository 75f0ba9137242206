// The law of a flow: the tangent by differences, which are exact, and every order of the series.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "atrapos/fem/StructuredPlane.hpp"
#include "atrapos/physics/Balance.hpp"
#include "atrapos/physics/Flow.hpp"
#include "atrapos/solid/MixedBody.hpp"
#include "support/Checks.hpp"
#include "support/Meshes.hpp"
#include "support/Vectors.hpp"

using namespace atrapos;
using namespace atrapos::physics;
using namespace atrapos::fem::test;

namespace {

/// A stirred block: velocities of one face grow with the load factor.
fem::FeModel stirred(const fem::Mesh& mesh, const Flow& flow, const std::optional<solid::PlaneSection>& plane,
                     const std::string& face) {
  const fem::Block& block = mesh.blocks[0];
  std::vector<int> all(mesh.numNodes());
  for (int n = 0; n < mesh.numNodes(); ++n) all[n] = n;
  std::vector<fem::DofMap::Located> fields;
  for (const std::string& name : flow.velocity) {
    fem::Field field = scalarField(name);
    field.balance = flow.velocity[0];
    fields.push_back({field, all});
  }
  fields.push_back({scalarField(flow.pressure), solid::pressureNodes(block)});
  fem::FeModel model;
  model.dofs = fem::DofMap(mesh.numNodes(), fields);
  model.terms.push_back(flowTerm(mesh, block, flow, plane));
  for (const int n : nodesOfSet(mesh, face))
    for (std::size_t i = 0; i < flow.velocity.size(); ++i)
      model.prescribe(n, 0, 0, 1.0 + 0.3 * static_cast<double>(i), flow.velocity[i]);
  return model;
}

/// The residual is of second degree: central differences of any length have no error.
void expectTangent(fem::FeModel model) {
  fem::FeProblem problem(std::move(model));
  const int count = problem.model().dofs.numDofs();
  const Numbers u = randomNumbers(count, 0.5, 31), random = randomNumbers(count, 0.5, 32);
  const double lambda = 0.4, rate = 0.7;
  Numbers d = random;
  for (int i = 0; i < count; ++i)
    if (problem.model().supports.fixed(i)) d[i] = rate * problem.model().supports.perLoadFactor(i);
  const Tangent K = tangent(problem, u, lambda);
  const Numbers exact = sum(K.times(d), -rate, K.F);
  const Numbers plus = residual(problem, sum(u, 1, d), lambda + rate).r,
                minus = residual(problem, sum(u, -1, d), lambda - rate).r;
  EXPECT_LT(norm(sum(sum(plus, -1, minus), -2, exact)), 1e-12 * norm(exact));
}

}  // namespace

TEST(FlowLaw, TangentsAndOrders) {
  const Flow plane{{"u", "v"}, "p", 0.7, 30}, space{{"u", "v", "w"}, "p", 0.7, 30};
  fem::RectangleOptions options;
  options.topology = fem::Topology::Quad9;
  options.divisions = {2, 1};
  options.origin = {0.5, 0};
  const fem::Mesh rectangle = fem::rectangleMesh(options);
  for (const auto kind : {solid::PlaneSection::Kind::strain, solid::PlaneSection::Kind::axisymmetric}) {
    const solid::PlaneSection section{kind, 1};
    expectTangent(stirred(rectangle, plane, section, "x_min"));
    checkOrders(stirred(rectangle, plane, section, "x_min"));
  }
  const fem::Mesh cube = box(fem::Topology::Hex20, {1, 1, 1});
  expectTangent(stirred(cube, space, std::nullopt, "x_min"));
  checkOrders(stirred(cube, space, std::nullopt, "x_min"));
}
