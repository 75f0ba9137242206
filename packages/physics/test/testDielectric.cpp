// Materials in an electric field: stress and charge are the derivatives of the energy, three ways.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "atrapos/fem/LawTerm.hpp"
#include "atrapos/fem/ReferenceCell.hpp"
#include "atrapos/physics/Balance.hpp"
#include "atrapos/physics/Dielectric.hpp"
#include "support/Checks.hpp"
#include "support/Meshes.hpp"
#include "support/Vectors.hpp"

using namespace atrapos;
using namespace atrapos::physics;
using namespace atrapos::fem::test;

namespace {

using Law = Dielectric<solid::NeoHookean>;

Law lawOf(double permittivity) { return {solid::NeoHookean::fromYoung(2, 0.3), permittivity}; }

/// The electric part of the energy, written out in another way: by the inverse of F.
double energy(const Numbers& in, double permittivity) {
  double F[9];
  for (int i = 0; i < 9; ++i) F[i] = in[i] + (i % 4 == 0 ? 1 : 0);
  const double J = F[0] * (F[4] * F[8] - F[5] * F[7]) - F[1] * (F[3] * F[8] - F[5] * F[6]) +
                   F[2] * (F[3] * F[7] - F[4] * F[6]);
  // F^T e = grad phi by Cramer's rule.
  double square = 0;
  for (int i = 0; i < 3; ++i) {
    double A[9];
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) A[3 * r + c] = c == i ? in[9 + r] : F[3 * c + r];
    const double e = (A[0] * (A[4] * A[8] - A[5] * A[7]) - A[1] * (A[3] * A[8] - A[5] * A[6]) +
                      A[2] * (A[3] * A[7] - A[4] * A[6])) /
                     J;
    square += e * e;
  }
  return -permittivity / 2 * J * square;
}

Numbers point() {
  Numbers in = randomNumbers(12, 0.3, 4);
  in[9] += 1;
  return in;
}

}  // namespace

/// Stress and charge are the slopes of the energy: differences whose error falls like h^2.
TEST(Dielectric, SlopesOfTheEnergy) {
  const Numbers in = point();
  Numbers with(12), without(12);
  taylor::value(lawOf(0.7), in.data(), nullptr, with.data());
  taylor::value(lawOf(0), in.data(), nullptr, without.data());
  for (int i = 0; i < 12; ++i) {
    const auto error = [&](double h) {
      Numbers plus = in, minus = in;
      plus[i] += h;
      minus[i] -= h;
      return std::abs((energy(plus, 0.7) - energy(minus, 0.7)) / (2 * h) - (with[i] - without[i]));
    };
    const double coarse = error(0.01);
    if (coarse < 1e-10) continue;  // the energy is quadratic in the potential
    EXPECT_NEAR(coarse / error(0.005), 4, 0.1) << i;
  }
}

TEST(Dielectric, TangentThreeWays) {
  const Law law = lawOf(0.7);
  const Numbers in = point();
  Numbers out(12), jacobian(144);
  taylor::tangent(law, in.data(), nullptr, out.data(), jacobian.data());
  constexpr int L = taylor::nativeLanes;
  taylor::Context<L> context;
  context.shape = taylor::historyShape(law);
  Numbers memory(context.shape.doubles<L>(0));
  context.memory = memory.data();
  taylor::Lanes<L> x[12], y[12], slopes[144];
  for (int i = 0; i < 12; ++i) x[i] = in[i];
  const taylor::Lanes<L>* none = nullptr;
  taylor::tangent(law, context, x, none, y, slopes);
  for (int i = 0; i < 12; ++i)
    for (int j = 0; j < 12; ++j) {
      EXPECT_NEAR(jacobian[12 * i + j], jacobian[12 * j + i], 1e-14);
      EXPECT_NEAR(slopes[12 * i + j][0], jacobian[12 * i + j], 1e-13);
    }
}

/// A body of elements: tangent against differences of the residual, orders along the series; the potentials
/// that are free owe the tangent their negative pivots.
TEST(Dielectric, BodiesTangentAndOrders) {
  for (const fem::Topology cell : {fem::Topology::Hex8, fem::Topology::Hex20}) {
    const fem::Mesh mesh = distorted(box(cell, {2, 2, 1}), 0.05);
    const auto model = [&] {
      fem::Field potential = scalarField("phi");
      potential.role = fem::Role::multiplier;
      fem::FeModel m;
      m.dofs = fem::DofMap(mesh.numNodes(), {{fem::displacementField(), {}}, {potential, {}}});
      const fem::Tabulation t = fem::tabulate(cell, 4);
      fem::PointSet points = fem::volumePoints(mesh, mesh.blocks[0], t);
      points.more.push_back(fem::gradientsOf(potential, points, t));
      m.terms.push_back(fem::lawTerm(fem::pointLaw(lawOf(0.4)), points));
      for (const int n : nodesOfSet(mesh, "z_min")) {
        for (int i = 0; i < 3; ++i) m.prescribe(n, i, 0, 0);
        m.prescribe(n, 0, 0, 0, "phi");
      }
      for (const int n : nodesOfSet(mesh, "z_max")) m.prescribe(n, 0, 0.7, 1.1, "phi");
      return m;
    };
    checkTangent(model());
    checkOrders(model());
    fem::FeProblem problem(model());
    const int all = mesh.numNodes(),
              held = static_cast<int>(nodesOfSet(mesh, "z_min").size() + nodesOfSet(mesh, "z_max").size());
    EXPECT_EQ(problem.constraintPivots(), all - held);
  }
}
