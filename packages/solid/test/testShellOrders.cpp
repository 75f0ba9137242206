// The condensed shell element in its three uses: residual, tangent, orders of a series.
#include <gtest/gtest.h>

#include <cmath>

#include "ShellModel.hpp"
#include "atrapos/linear/MakeTangentSolver.hpp"
#include "atrapos/path/SeriesStep.hpp"
#include "support/Meshes.hpp"

using namespace atrapos;
using namespace atrapos::solid;
using namespace atrapos::solid::test;
using namespace atrapos::fem::test;

namespace {

/// Made for having infinite series and a nonlinear equation for the enhanced parameters:
/// S = a (exp(b tr E) - 1) I + 2 mu E.
struct ExponentialMaterial {
  static constexpr bool symmetric = true;
  double a = 0.6, b = 3, mu = 0.4;

  template <class T>
  KOKKOS_INLINE_FUNCTION void secondPiola(const T* E, T* S) const {
    using std::exp;
    const T volumetric = a * exp(b * (E[0] + E[1] + E[2])) - a;
    for (int i = 0; i < 3; ++i) S[i] = volumetric + (2 * mu) * E[i];
    for (int i = 3; i < 6; ++i) S[i] = (2 * mu) * E[i];
  }
};

/// The same with a part that has no energy: the tangent is not symmetric.
struct UnsymmetricMaterial : ExponentialMaterial {
  static constexpr bool symmetric = false;

  template <class T>
  KOKKOS_INLINE_FUNCTION void secondPiola(const T* E, T* S) const {
    ExponentialMaterial::secondPiola(E, S);
    S[2] = S[2] + 0.3 * E[0] + 0.5 * (E[0] * E[2]);
  }
};

constexpr double thickness = 0.2;

/// Five curved elements: no multiple of the lanes.
ShellGrid curvedGrid() { return shellGrid(5, 1, thickness, cylinder(1, 0, 1.5, 0, 0.7)); }

template <class Material>
fem::FeModel curvedModel(const Material& material) {
  const ShellGrid grid = curvedGrid();
  fem::FeModel model;
  model.numNodes = 2 * grid.numNodes();
  model.terms.push_back(
      std::make_unique<ShellTerm<Material>>(ShellLaw<Material>{material}, shellPoints(grid.elements())));
  model.supports = fem::Supports(model.numNodes);
  clamp(model, grid, grid.lineI(0));
  const Numbers load = randomNumbers(3 * model.numNodes, 0.002, 3);
  model.load = load;
  model.constantLoad.assign(load.size(), 0.0);
  return model;
}

/// A state off the linear range: strains of 0.1.
Numbers state(const fem::Supports& supports) {
  Numbers u = randomNumbers(3 * supports.numNodes(), 0.02, 17);
  for (std::size_t d = 0; d < u.size(); ++d)
    if (supports.fixed(static_cast<int>(d))) u[d] = 0;
  return u;
}

template <class Material>
class ShellOrders : public testing::Test {};
using Materials = testing::Types<SaintVenantKirchhoff, ExponentialMaterial, UnsymmetricMaterial>;

template <class Material>
Material make() {
  return {};
}
template <>
SaintVenantKirchhoff make() {
  return SaintVenantKirchhoff::fromYoung(1, 0.3);
}

path::Series series(fem::FeProblem& problem, const Numbers& u, double lambda, int order) {
  linear::TangentSolverOptions options;
  options.symmetric = problem.symmetric();
  const auto solver = linear::makeTangentSolver(options);
  path::Calls calls(problem, *solver);
  path::SeriesRequest request;
  request.order = order;
  return path::buildSeries(calls, {vectorOf(problem, u), lambda}, request);
}

}  // namespace

TYPED_TEST_SUITE(ShellOrders, Materials);

// Central differences of the residual against the condensed tangent: their error falls like h^2.
TYPED_TEST(ShellOrders, TangentIsTheDerivativeOfTheResidual) {
  fem::FeModel model = curvedModel(make<TypeParam>());
  const Numbers u = state(model.supports);
  fem::FeProblem problem(std::move(model));
  Numbers direction = randomNumbers(u.size(), 0.02, 18);
  for (std::size_t d = 0; d < u.size(); ++d)
    if (u[d] == 0) direction[d] = 0;
  const Numbers exact = tangent(problem, u, 0).times(direction);
  const auto error = [&](double h) {
    const Numbers difference =
        sum(residual(problem, sum(u, h, direction), 0).r, -1, residual(problem, sum(u, -h, direction), 0).r);
    Numbers e = exact;
    for (std::size_t d = 0; d < e.size(); ++d) e[d] -= difference[d] / (2 * h);
    return norm(e) / norm(exact);
  };
  const double coarse = error(0.1), fine = error(0.05);
  EXPECT_GT(coarse, 1e-7);                        // far above rounding, 1e-16/h
  EXPECT_NEAR(std::log2(coarse / fine), 2, 0.1);  // the next term is h^2 smaller
}

// Where U_1..U_K solve the order equations, what is left of the residual along the series, with the enhanced
// parameters solved anew at every state, starts at order K+1.
TYPED_TEST(ShellOrders, ResidualStartsAtOrderKPlusOne) {
  fem::FeModel model = curvedModel(make<TypeParam>());
  const Numbers u0 = state(model.supports);
  fem::FeProblem problem(std::move(model));
  const Numbers R0 = residual(problem, u0, 0.4).r;
  const int longest = 12;
  const path::Series reference = series(problem, u0, 0.4, longest);
  const double unit = std::pow(reference.norm(1) / reference.norm(longest), 1.0 / (longest - 1));
  ASSERT_TRUE(std::isfinite(unit));
  for (int K : {1, 3, 6, 10}) {
    SCOPED_TRACE("order " + std::to_string(K));
    const path::Series part = series(problem, u0, 0.4, K);
    auto u = zeroVector(problem);
    const auto left = [&](double a) {
      const double lambda = part.evaluate(a, *u);
      const auto r = residual(problem, fem::FeProblem::values(*u), lambda);
      return norm(sum(r.r, -1, R0)) / r.norm.scale;
    };
    // A remainder of 1e-8 of its size at the unit: above rounding at a/2 too, and a small against the radius.
    const double a = std::pow(1e-8, 1.0 / (K + 1)) * unit;
    EXPECT_NEAR(std::log2(left(a) / left(a / 2)), K + 1, 0.25);
  }
}

// The enhanced parameters depend on the state alone: the same bits after any other state.
TYPED_TEST(ShellOrders, ResidualHasNoMemory) {
  fem::FeModel model = curvedModel(make<TypeParam>());
  const Numbers u = state(model.supports);
  fem::FeProblem problem(std::move(model));
  const Numbers before = residual(problem, u, 0).r;
  residual(problem, sum(u, 0.7, u), 0);
  EXPECT_EQ(residual(problem, u, 0).r, before);
}

TEST(ShellOrdersFailure, AStateOutsideTheLawsDomainIsNamed) {
  const auto material = SaintVenantKirchhoff{-1.0, 0.2};  // unstable: lambda + 2 mu < 0
  fem::FeModel model;
  const ShellGrid grid = curvedGrid();
  model.numNodes = 2 * grid.numNodes();
  auto term = std::make_unique<Shell>(ShellLaw<SaintVenantKirchhoff>{material}, shellPoints(grid.elements()));
  const Shell& shell = *term;
  model.terms.push_back(std::move(term));
  model.supports = fem::Supports(model.numNodes);
  fem::FeProblem problem(std::move(model));
  const auto r = residual(problem, randomNumbers(3 * 2 * grid.numNodes(), 0.01, 1), 0);
  EXPECT_TRUE(std::isnan(r.norm.norm));
  EXPECT_EQ(shell.failure(), "element 1: the material is unstable in the enhanced strain");
}

TEST(ShellPointsErrors, JacobianNamesTheElement) {
  // Thicker than the radius of curvature allows: 1 - t/(2R) < 0 inside.
  const ShellGrid grid = shellGrid(2, 1, 2.5, cylinder(1, 0, 1, 0, 1));
  try {
    shellPoints(grid.elements());
    FAIL() << "not refused";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("shell element 1: the Jacobian is not positive"),
              std::string::npos);
  }
  ShellElements turned = shellGrid(2, 1, 0.1, flat(1, 1)).elements();
  for (std::size_t i = 24; i < 48; ++i) turned.directors[i] *= -1;
  EXPECT_THROW(shellPoints(turned), std::runtime_error);
}
