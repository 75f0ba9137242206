// The condensed shell element in its three uses: residual, tangent, orders of a series.
#include <gtest/gtest.h>

#include <cmath>

#include "ShellChecks.hpp"
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
  KOKKOS_INLINE_FUNCTION taylor::Symmetric3<T> secondPiola(const taylor::Symmetric3<T>& E) const {
    using std::exp;
    const T volumetric = a * exp(b * trace(E)) - a;
    return plusIdentity((2 * mu) * E, volumetric);
  }
};

/// The same with a part that has no energy: the tangent is not symmetric.
struct UnsymmetricMaterial : ExponentialMaterial {
  static constexpr bool symmetric = false;

  template <class T>
  KOKKOS_INLINE_FUNCTION taylor::Symmetric3<T> secondPiola(const taylor::Symmetric3<T>& E) const {
    taylor::Symmetric3<T> S = ExponentialMaterial::secondPiola(E);
    const T Exx = E(0, 0), Ezz = E(2, 2);
    const T more = S(2, 2) + 0.3 * Exx + 0.5 * (Exx * Ezz);
    S.set(2, 2, more);
    return S;
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

}  // namespace

TYPED_TEST_SUITE(ShellOrders, Materials);

TYPED_TEST(ShellOrders, TangentIsTheDerivativeOfTheResidual) {
  fem::FeModel model = curvedModel(make<TypeParam>());
  const Numbers u = randomState(model.supports, 0.02, 17), direction = randomState(model.supports, 0.02, 18);
  fem::FeProblem problem(std::move(model));
  expectTangent(problem, u, direction, 0);
}

// The enhanced parameters are solved anew at every state along the series.
TYPED_TEST(ShellOrders, ResidualStartsAtOrderKPlusOne) {
  fem::FeModel model = curvedModel(make<TypeParam>());
  const Numbers u0 = randomState(model.supports, 0.02, 17);
  fem::FeProblem problem(std::move(model));
  expectOrders(problem, u0, 0.4);
}

// The enhanced parameters depend on the state alone: the same bits after any other state.
TYPED_TEST(ShellOrders, ResidualHasNoMemory) {
  fem::FeModel model = curvedModel(make<TypeParam>());
  const Numbers u = randomState(model.supports, 0.02, 17);
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
  const Numbers u = randomNumbers(3 * 2 * grid.numNodes(), 0.01, 1);
  const auto r = residual(problem, u, 0);
  EXPECT_TRUE(std::isnan(r.norm.norm));
  EXPECT_EQ(shell.failure(), "element 1: the material is unstable in the enhanced strain");
  try {
    problem.beginSeries(*vectorOf(problem, u), 0, 3);
    FAIL() << "a series from a state without enhanced strain";
  } catch (const taylor::DomainError& error) {
    EXPECT_EQ(std::string(error.what()).find(shell.failure()), 0u) << error.what();
  }
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
