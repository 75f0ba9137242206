// The condensed shell element in its three uses: residual, tangent, orders of a series.
#include <gtest/gtest.h>

#include <cmath>

#include "ShellChecks.hpp"
#include "atrapos/fem/EnhancedTerm.hpp"
#include "atrapos/fem/PointLawOf.hpp"
#include "atrapos/solid/ShellTerms.hpp"
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

/// A value but no series without shear; the shear stress does no work on the thickness strain of flat shells.
struct KinkedMaterial : SaintVenantKirchhoff {
  template <class T>
  KOKKOS_INLINE_FUNCTION taylor::Symmetric3<T> secondPiola(const taylor::Symmetric3<T>& E) const {
    using std::abs;
    taylor::Symmetric3<T> S = SaintVenantKirchhoff::secondPiola(E);
    const T shear = E(0, 1);
    const T more = S(0, 1) + 0.1 * abs(shear);
    S.set(0, 1, more);
    return S;
  }
};

constexpr double thickness = 0.2;

/// Five curved elements: no multiple of the lanes.
ShellGrid curvedGrid(int nodes = 8) {
  return shellGrid(5, 1, thickness, cylinder(1, 0, 1.5, 0, 0.7), undistorted, nodes);
}

template <class Material>
fem::FeModel curvedModel(const Material& material, int nodes = 8) {
  const ShellGrid grid = curvedGrid(nodes);
  fem::FeModel model;
  model.dofs = fem::DofMap::displacements(2 * grid.numNodes());
  if (nodes == 3)
    model.terms.push_back(
        fem::enhancedTerm(fem::pointLaw(Mitc3Law<Material>{material}), mitc3Points(grid.elements(), 0.3)));
  else if (nodes == 6)
    model.terms.push_back(
        fem::enhancedTerm(sixNodeShellLaw(fem::pointLaw(ShellMaterialStage<Material>{material})),
                          mitc6Points(grid.elements())));
  else if (nodes == 4)
    model.terms.push_back(
        fem::enhancedTerm(fem::pointLaw(Mitc4Law<Material>{material}), mitc4Points(grid.elements(), 0.3)));
  else
    model.terms.push_back(
        fem::enhancedTerm(fem::pointLaw(ShellLaw<Material>{material}), shellPoints(grid.elements())));
  clamp(model, grid, grid.lineI(0));
  const Numbers load = randomNumbers(model.dofs.numDofs(), 0.002, 3);
  model.load = load;
  model.constantLoad.assign(load.size(), 0.0);
  return model;
}

/// The same with assumed transverse shear strains.
template <class Material>
fem::FeModel assumedShearModel(const Material& material) {
  const ShellGrid grid = curvedGrid();
  fem::FeModel model = curvedModel(material);
  model.terms[0] = fem::enhancedTerm(fem::pointLaw(AssumedShearLaw<Material>{material}),
                                     assumedShearPoints(grid.elements()));
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

void expectTangentAndOrders(fem::FeModel model) {
  const Numbers u = randomState(model, 0.02, 17), direction = randomState(model, 0.02, 18);
  fem::FeProblem problem(std::move(model));
  expectTangent(problem, u, direction, 0);
  expectOrders(problem, u, 0.4);
}

}  // namespace

TYPED_TEST_SUITE(ShellOrders, Materials);

TYPED_TEST(ShellOrders, TangentIsTheDerivativeOfTheResidual) {
  fem::FeModel model = curvedModel(make<TypeParam>());
  const Numbers u = randomState(model, 0.02, 17), direction = randomState(model, 0.02, 18);
  fem::FeProblem problem(std::move(model));
  expectTangent(problem, u, direction, 0);
}

// The enhanced parameters are solved anew at every state along the series.
TYPED_TEST(ShellOrders, ResidualStartsAtOrderKPlusOne) {
  fem::FeModel model = curvedModel(make<TypeParam>());
  const Numbers u0 = randomState(model, 0.02, 17);
  fem::FeProblem problem(std::move(model));
  expectOrders(problem, u0, 0.4);
}

TEST(AssumedShearOrders, TangentAndOrders) {
  expectTangentAndOrders(assumedShearModel(UnsymmetricMaterial{}));
}

TEST(Mitc3Orders, TangentAndOrders) { expectTangentAndOrders(curvedModel(UnsymmetricMaterial{}, 3)); }

TEST(Mitc6Orders, TangentAndOrders) { expectTangentAndOrders(curvedModel(UnsymmetricMaterial{}, 6)); }

TEST(Mitc4Orders, TangentAndOrders) { expectTangentAndOrders(curvedModel(UnsymmetricMaterial{}, 4)); }

// The tangent of a material with an energy is symmetric on any quadrilaterals, warped ones too, and
// triangles.
void expectSymmetry(Shear shear) {
  ShellGrid grid = curvedGrid(nodesOf(shear));
  const Numbers moves = randomNumbers(3 * grid.numNodes(), 0.05, 9);
  for (int n = 0; n < grid.numNodes(); ++n)
    for (int i = 0; i < 3; ++i) grid.x[n][i] += moves[3 * n + i];
  fem::FeProblem problem(shellModel(grid, SaintVenantKirchhoff::fromYoung(1, 0.3), {}, shear));
  const Numbers u = randomNumbers(6 * grid.numNodes(), 0.02, 1), a = randomNumbers(u.size(), 1, 2),
                b = randomNumbers(u.size(), 1, 3);
  const Tangent K = tangent(problem, u, 0);
  const double aKb = dot(a, K.times(b)), bKa = dot(b, K.times(a));
  EXPECT_NEAR(aKb, bKa, 1e-13 * norm(a) * norm(K.times(b)));  // rounding of the sums
  EXPECT_GT(std::abs(aKb), 1e-6);
}
TEST(Mitc4Orders, TangentIsSymmetric) { expectSymmetry(Shear::mitc4); }
TEST(Mitc3Orders, TangentIsSymmetric) { expectSymmetry(Shear::mitc3); }
TEST(Mitc6Orders, TangentIsSymmetric) { expectSymmetry(Shear::mitc6); }

// The enhanced parameters depend on the state alone: the same bits after any other state.
TYPED_TEST(ShellOrders, ResidualHasNoMemory) {
  fem::FeModel model = curvedModel(make<TypeParam>());
  const Numbers u = randomState(model, 0.02, 17);
  fem::FeProblem problem(std::move(model));
  const Numbers before = residual(problem, u, 0).r;
  residual(problem, sum(u, 0.7, u), 0);
  EXPECT_EQ(residual(problem, u, 0).r, before);
}

// A second series of another order in the same problem: neither histories nor g_k of the first shine through.
TYPED_TEST(ShellOrders, HistoriesStartAfresh) {
  const auto curvedProblem = [] { return fem::FeProblem(curvedModel(make<TypeParam>())); };
  fem::FeProblem used = curvedProblem(), fresh = curvedProblem();
  const fem::FeModel model = curvedModel(make<TypeParam>());
  const Numbers u1 = randomState(model, 0.02, 1), u2 = randomState(model, 0.02, 2);
  const auto orderThree = [&](fem::FeProblem& problem, const Numbers& u, int maxOrder) {
    problem.beginSeries({vectorOf(problem, u), 0}, maxOrder);
    auto F = zeroVector(problem);
    for (int k = 1; k <= 3; ++k) {
      problem.orderRhs(k, *F);
      problem.completeOrder(k, *vectorOf(problem, randomState(model, 0.1, 50 + k)), 0);
    }
    return fem::FeProblem::values(*F);
  };
  orderThree(used, u1, 8);
  EXPECT_EQ(orderThree(used, u2, 3), orderThree(fresh, u2, 3));
  orderThree(used, u1, 3);
  EXPECT_EQ(orderThree(used, u2, 3), orderThree(fresh, u2, 3));
  EXPECT_GT(norm(orderThree(fresh, u2, 3)), 1e-6);
}

// H, S and e; 16 are raised by one (taylor::historyShape). Sums: H^T H and H S.
TEST(ShellLawHistories, SaintVenantKirchhoff) {
  const auto shape = taylor::historyShape(ShellLaw<SaintVenantKirchhoff>{make<SaintVenantKirchhoff>()});
  EXPECT_EQ(shape.slots, 17);
  EXPECT_EQ(shape.constants, 0);
  EXPECT_EQ(shape.sums, 15);
}

TEST(ShellOrdersFailure, APointWithoutSeriesIsNamed) {
  const KinkedMaterial material{SaintVenantKirchhoff::fromYoung(1, 0.3)};
  const ShellGrid grid = shellGrid(2, 1, thickness, flat(1, 1));
  fem::FeModel model;
  model.dofs = fem::DofMap::displacements(2 * grid.numNodes());
  model.terms.push_back(
      fem::enhancedTerm(fem::pointLaw(ShellLaw<KinkedMaterial>{material}), shellPoints(grid.elements())));
  fem::FeProblem problem(std::move(model));
  const Numbers u(3 * 2 * grid.numNodes(), 0.0);
  EXPECT_EQ(residual(problem, u, 0).norm.norm, 0.0);
  try {
    problem.beginSeries({vectorOf(problem, u), 0}, 3);
    FAIL() << "a series of |x| at 0";
  } catch (const taylor::DomainError& error) {
    EXPECT_STREQ(error.what(), "entity 1, point 1: abs of 0: its argument must not vanish");
  }
}

TEST(ShellOrdersFailure, AStateOutsideTheLawsDomainIsNamed) {
  const auto material = SaintVenantKirchhoff{-1.0, 0.2};  // unstable: lambda + 2 mu < 0
  fem::FeModel model;
  const ShellGrid grid = curvedGrid();
  model.dofs = fem::DofMap::displacements(2 * grid.numNodes());
  model.terms.push_back(shellTerm(grid.elements(), material));
  fem::FeProblem problem(std::move(model));
  const Numbers u = randomNumbers(3 * 2 * grid.numNodes(), 0.01, 1);
  const auto r = residual(problem, u, 0);
  EXPECT_TRUE(std::isnan(r.norm.norm));
  try {
    problem.beginSeries({vectorOf(problem, u), 0}, 3);
    FAIL() << "a series from a state without enhanced strain";
  } catch (const taylor::DomainError& error) {
    EXPECT_EQ(std::string(error.what()).find("element 1: the material is unstable in the enhanced strain"),
              0u)
        << error.what();
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
