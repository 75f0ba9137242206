// The law of docs/own_law.md, compiled from the document.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "atrapos/fem/FeProblem.hpp"
#include "atrapos/fem/LawTerm.hpp"
#include "atrapos/fem/PointLawOf.hpp"
#include "atrapos/fem/ReferenceCell.hpp"
#include "atrapos/taylor/Tensor.hpp"

#include "OwnLawOfTheDocument.hpp"
#include "support/Checks.hpp"
#include "support/Meshes.hpp"
#include "support/Vectors.hpp"

using namespace atrapos::fem;
using namespace atrapos::fem::test;

namespace {

/// Held at x = 0 in x, y = 0 in y, z = 0 in z.
FeModel onThreePlanes(const Mesh& mesh, const HeatedBody& law) {
  FeModel model = heatedBody(mesh, law);
  const char* planes[] = {"x_min", "y_min", "z_min"};
  for (int i = 0; i < 3; ++i)
    for (const int n : nodesOfSet(mesh, planes[i])) model.prescribe(n, i, 0, 0);
  return model;
}

bool hasTemperature(const FeModel& model, int node) { return model.dofs.numDofs(node) == 4; }

}  // namespace

TEST(OwnLaw, TangentAndOrders) {
  const auto model = [] {
    const Mesh mesh = distorted(box(Topology::Hex20, {3, 2, 2}), 0.02);
    FeModel m = onThreePlanes(mesh, {1.0, 0.8, 0.2, 0.7, 1.5});
    for (const int n : nodesOfSet(mesh, "x_min"))
      if (hasTemperature(m, n)) m.prescribe(n, 0, 0.1, 0.5, "temperature");
    m.load = randomNumbers(m.dofs.numDofs(), 0.02, 22);
    return m;
  };
  checkTangent(model());
  checkOrders(model());
}

// k0 e^(b theta) theta' is the same at all x: e^(b theta) is linear between theta = 0 and theta = 1. In a
// body that cannot strain, so that conduction is all; linear temperatures are good to h^2.
TEST(OwnLaw, ConductionIsThatOfTheClosedForm) {
  const double b = 1.2;
  const auto error = [&](int cells) {
    const Mesh mesh = box(Topology::Hex20, {cells, 1, 1});
    FeModel model = heatedBody(mesh, {1, 1, 0, 1, b});
    for (int n = 0; n < mesh.numNodes(); ++n)
      for (int i = 0; i < 3; ++i) model.prescribe(n, i, 0, 0);
    for (const int n : nodesOfSet(mesh, "x_min"))
      if (hasTemperature(model, n)) model.prescribe(n, 0, 0, 0, "temperature");
    for (const int n : nodesOfSet(mesh, "x_max"))
      if (hasTemperature(model, n)) model.prescribe(n, 0, 0, 1, "temperature");
    const DofMap dofs = model.dofs;
    FeProblem problem(std::move(model));
    const auto state = equilibrium(problem, 1.0, FeProblem::values(*problem.initialState(1.0)));
    double worst = 0;
    for (int n = 0; n < mesh.numNodes(); ++n) {
      if (dofs.numDofs(n) < 4) continue;
      const double exact = std::log(1 + mesh.coordinates[3 * n] * (std::exp(b) - 1)) / b;
      worst = std::max(worst, std::abs(state.u[dofs.dof(dofs.find("temperature"), n, 0)] - exact));
    }
    return worst;
  };
  const double coarse = error(4), fine = error(8);
  EXPECT_LT(fine, 1e-3);
  EXPECT_NEAR(std::log2(coarse / fine), 4, 0.3);
}

// A body at one temperature that is free to expand has no stress: E = alpha theta I.
TEST(OwnLaw, FreeExpansionIsStressFree) {
  const Mesh mesh = distorted(box(Topology::Hex20, {2, 2, 2}), 0.0);
  FeModel model = onThreePlanes(mesh, {1.0, 0.8, 0.1, 1, 0});
  for (int n = 0; n < mesh.numNodes(); ++n)
    if (hasTemperature(model, n)) model.prescribe(n, 0, 0, 1, "temperature");
  const DofMap dofs = model.dofs;
  FeProblem problem(std::move(model));
  const auto state = equilibrium(problem, 1.0, FeProblem::values(*problem.initialState(1.0)));
  const double stretch = std::sqrt(1 + 2 * 0.1);
  for (int n = 0; n < mesh.numNodes(); ++n)
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR(state.u[dofs.firstDof(n) + i], (stretch - 1) * mesh.coordinates[3 * n + i], 1e-12);
}
