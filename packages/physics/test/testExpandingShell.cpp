// Expansion in shells: what grows freely has no stress, and what grows more at the top bends.
#include <gtest/gtest.h>

#include <cmath>

#include "ShellChecks.hpp"
#include "atrapos/physics/Expansion.hpp"
#include "atrapos/solid/MooneyRivlin.hpp"
#include "atrapos/solid/ShellTerms.hpp"
#include "support/Meshes.hpp"

using namespace atrapos;
using namespace atrapos::solid;
using namespace atrapos::solid::test;
using namespace atrapos::fem::test;

namespace {

const std::vector<Shear> kinds{Shear::compatible, Shear::assumed, Shear::mitc4, Shear::mitc3, Shear::mitc6};

ShellStrains strainsOf(Shear shear) {
  return shear == Shear::assumed ? ShellStrains::assumedShear : ShellStrains::compatible;
}

template <class Material>
fem::FeModel expandingModel(const ShellGrid& grid, const Material& material, double poissonsRatio,
                            const std::string& formula, Shear shear) {
  fem::FeModel model;
  model.dofs = fem::DofMap::displacements(2 * grid.numNodes());
  model.terms.push_back(expandingShellTerm(grid.elements(), strainsOf(shear), poissonsRatio,
                                           fem::pointLaw(ShellMaterialStage<Material>{material}),
                                           physics::shellExpansion(formula, {{"a", 0.05}})));
  model.constantLoad.assign(model.dofs.numDofs(), 0.0);
  model.load.assign(model.dofs.numDofs(), 0.0);
  return model;
}

ShellGrid arch(Shear shear, double thickness = 0.2) {
  return shellGrid(3, 2, thickness, cylinder(1, 0, 1, 0, 1), undistorted, nodesOf(shear));
}

}  // namespace

TEST(ExpandingShell, FreeGrowthHasNoStress) {
  const auto expectFree = [](const ShellGrid& grid, fem::FeModel model) {
    const Numbers u = homogeneous(grid, {0.1, 0, 0, 0, 0.1, 0, 0, 0, 0.1});
    fem::FeProblem problem(std::move(model));
    EXPECT_GT(largest(residual(problem, u, 0).r), 1e-4);
    EXPECT_LT(largest(residual(problem, u, 2).r), 1e-15);  // rounding of stresses of 1e-1 times areas
  };
  for (const Shear shear : kinds) {
    const ShellGrid grid = arch(shear);
    expectFree(grid, expandingModel(grid, SaintVenantKirchhoff::fromYoung(1, 0.3), 0.3, "a*lambda", shear));
    expectFree(grid, expandingModel(grid, MooneyRivlin::fromModuli(0.3, 0.1, 5), 0.4, "a*lambda", shear));
  }
}

TEST(ExpandingShell, TangentAndOrders) {
  const auto stiff = SaintVenantKirchhoff::fromYoung(1, 0.3);
  for (const Shear shear : kinds) {
    fem::FeModel model =
        expandingModel(arch(shear), stiff, 0.3, "a*lambda*(1 + 2*zeta + x*zeta) - 0.01*lambda^2", shear);
    hold(model, {0, 1}, "xyz");
    model.load = randomNumbers(model.dofs.numDofs(), 0.0005, 3);
    const Numbers u = randomState(model, 0.02, 17), direction = randomState(model, 0.02, 18);
    fem::FeProblem problem(std::move(model));
    EXPECT_TRUE(problem.symmetric());
    expectTangent(problem, u, direction, 0.7);
    expectOrders(problem, u, 0.7);
    // F = -dR/dlambda by differences, whose error falls like h^2.
    const Numbers F = tangent(problem, u, 0.7).F;
    const auto error = [&](double h) {
      Numbers e = sum(residual(problem, u, 0.7 + h).r, -1, residual(problem, u, 0.7 - h).r);
      for (std::size_t d = 0; d < e.size(); ++d) e[d] = F[d] + e[d] / (2 * h);
      return norm(e) / norm(F);
    };
    EXPECT_GT(error(0.2), 1e-8);
    EXPECT_NEAR(std::log2(error(0.2) / error(0.1)), 2, 0.1);
  }
}

// A strip whose top grows and whose bottom shrinks bends to an arc, of curvature 2 e/h: here a quarter of a
// circle, and no stress but what the elements' shapes make. Its middle keeps its length.
TEST(ExpandingShell, TopGrowsMoreThanBottom) {
  const double length = 10, h = 0.02, k = M_PI / (2 * length);
  const auto stiff = SaintVenantKirchhoff::fromYoung(1, 0);
  for (const Shear shear : kinds) {
    const auto error = [&](int n) {
      const ShellGrid grid = shellGrid(n, 1, h, flat(length, 1), undistorted, nodesOf(shear));
      fem::FeModel model = expandingModel(grid, stiff, 0, "lambda*zeta*" + std::to_string(k * h / 2), shear);
      clamp(model, grid, grid.lineI(0));
      // Across, growth bends it too: that is held.
      for (int node = 0; node < grid.numNodes(); ++node)
        for (const int which : {node, grid.director(node)})
          if (!model.supports.fixed(3 * which + 1)) model.prescribe(which, 1, 0, 0);
      Numbers circle(6 * grid.numNodes(), 0.0);
      for (int node = 0; node < grid.numNodes(); ++node) {
        const double s = grid.x[node][0];
        circle[3 * node] = std::sin(k * s) / k - s;
        circle[3 * node + 2] = (std::cos(k * s) - 1) / k;
        circle[3 * grid.director(node)] = std::sin(k * s) * h / 2;
        circle[3 * grid.director(node) + 2] = (std::cos(k * s) - 1) * h / 2;
      }
      fem::FeProblem problem(std::move(model));
      const Numbers u = equilibrium(problem, 1, circle, 1e-9).u;
      const int tip = grid.lineI(2 * n).front();
      return std::hypot(u[3 * tip] - circle[3 * tip], u[3 * tip + 2] - circle[3 * tip + 2]) / length;
    };
    // Strains are of size 1.6e-3, and the thickness, which grows and shrinks too, counts by parts of that,
    // 9e-5. Facets stand for arcs by chords, an error of order 2.
    const bool facets = shear == Shear::mitc3 || shear == Shear::mitc4;
    for (const int n : {8, 16})
      EXPECT_LT(error(n), 1.2e-4 + (facets ? 0.11 / (n * n) : 0)) << static_cast<int>(shear);
  }
}

TEST(ExpandingShell, FormulasOfOtherThings) {
  EXPECT_THROW(physics::shellExpansion("a*T", {{"a", 1}}), formula::FormulaError);
  EXPECT_THROW(physics::expansionOf("lambda*zeta", {}, {}), formula::FormulaError);
}
