// Expansion in shells: what grows freely has no stress, and what grows more at the top bends.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "ShellChecks.hpp"
#include "atrapos/physics/Balance.hpp"
#include "atrapos/physics/Expansion.hpp"
#include "atrapos/solid/MooneyRivlin.hpp"
#include "atrapos/solid/ShellTerms.hpp"
#include "support/Checks.hpp"
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
                            const std::string& formula, Shear shear,
                            const std::vector<std::string>& fields = {}) {
  fem::FeModel model;
  std::vector<int> mesh(grid.numNodes());
  std::iota(mesh.begin(), mesh.end(), 0);
  std::vector<fem::DofMap::Located> located{{fem::displacementField(), {}}};
  for (const std::string& field : fields) located.push_back({physics::scalarField(field), mesh});
  model.dofs = fem::DofMap(2 * grid.numNodes(), located);
  auto expansion = physics::shellExpansion(formula, fields, {{"a", 0.05}});
  EXPECT_EQ(expansion.fields, fields);
  model.terms.push_back(expandingShellTerm(grid.elements(), strainsOf(shear), poissonsRatio,
                                           fem::pointLaw(ShellMaterialStage<Material>{material}),
                                           std::move(expansion.stage), expansion.fields));
  model.constantLoad.assign(model.dofs.numDofs(), 0.0);
  model.load.assign(model.dofs.numDofs(), 0.0);
  return model;
}

/// Balances in the shells of a grid.
std::unique_ptr<fem::Term> balanceTerm(const ShellGrid& grid, Shear shear,
                                       const std::vector<std::string>& fields,
                                       const std::vector<physics::Balance>& balances) {
  const ShellElements elements = grid.elements();
  const int nodes = nodesOf(shear);
  fem::Block block;
  block.topology = nodes == 3   ? fem::Topology::Shell3
                   : nodes == 4 ? fem::Topology::Shell4
                   : nodes == 6 ? fem::Topology::Shell6
                                : fem::Topology::Shell8;
  return physics::balanceTerm({}, block, fields, balances, {}, {}, &elements);
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

// Mean and difference of a temperature are fields: what displacements owe them, also through the enhanced
// strain, which is condensed.
TEST(ExpandingShell, FieldsTangentAndOrders) {
  const auto stiff = SaintVenantKirchhoff::fromYoung(1, 0.3);
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    SCOPED_TRACE(k);
    const ShellGrid grid = arch(kinds[k]);
    const std::vector<std::string> fields{"T", "D"};
    const auto model = [&] {
      fem::FeModel m =
          expandingModel(grid, stiff, 0.3, "a*(T + zeta*D + 0.2*T*D) + 0.1*lambda*x", kinds[k], fields);
      m.terms.push_back(
          balanceTerm(grid, kinds[k], fields, {{"T", "1 + 0.1*D", "lambda"}, {"D", "1/3", "T"}}));
      hold(m, {0, 1}, "xyz");
      for (const std::string& field : fields) m.prescribe(0, 0, 0.1, 0.2, field);
      m.load = randomNumbers(m.dofs.numDofs(), 0.0005, 3);
      return m;
    };
    EXPECT_FALSE(fem::FeProblem(model()).symmetric());
    checkTangent(model());
    checkOrders(model());
  }
}

// On a cylinder of radius 1 the place x is a field with -div grad x = x.
TEST(ShellFields, ConductionAlongACurvedSurface) {
  const double thickness = 0.1;
  for (std::size_t k = 1; k < kinds.size(); ++k) {
    const auto error = [&](int n) {
      const ShellGrid grid =
          shellGrid(n, n, thickness, cylinder(1, 0, 1, 0, 1), undistorted, nodesOf(kinds[k]));
      fem::FeModel model;
      model.dofs = fem::DofMap(grid.numNodes(), {{physics::scalarField("T"), {}}});
      model.terms.push_back(balanceTerm(grid, kinds[k], {"T"}, {{"T", "2", "2*x"}}));
      for (const auto& line : {grid.lineI(0), grid.lineI(2 * n), grid.lineJ(0), grid.lineJ(2 * n)})
        for (const int node : line)
          if (!model.supports.fixed(node)) model.prescribe(node, 0, grid.x[node][0], 0, "T");
      fem::FeProblem problem(std::move(model));
      const Numbers u = equilibrium(problem, 0, Numbers(grid.numNodes(), 0.0), 1e-10).u;
      double largest = 0;
      for (int node = 0; node < grid.numNodes(); ++node)
        largest = std::max(largest, std::abs(u[node] - grid.x[node][0]));
      return largest;
    };
    const double coarse = error(4), fine = error(8);
    const bool quadratic = nodesOf(kinds[k]) == 8 || nodesOf(kinds[k]) == 6;
    EXPECT_LT(fine, quadratic ? 1e-4 : 1e-2);
    EXPECT_GT(std::log2(coarse / fine), quadratic ? 2.8 : 1.75) << k;
  }
}

TEST(ShellFields, WeightsAreThicknessTimesArea) {
  const ShellGrid grid = shellGrid(3, 2, 0.1, cylinder(2, 0, 1, 0, 1), undistorted, 8);
  const fem::PointSet points = shellFieldPoints(grid.elements(), fem::tabulate(fem::Topology::Shell8, 5));
  // Parabolas in the place of arcs: 3e-5 of the area.
  EXPECT_NEAR(std::accumulate(points.weights.begin(), points.weights.end(), 0.0), 0.1 * 2, 6e-6);
  EXPECT_THROW(shellFieldPoints(grid.elements(), fem::tabulate(fem::Topology::Shell4, 2)), std::logic_error);
}

TEST(ExpandingShell, FormulasOfOtherThings) {
  EXPECT_THROW(physics::shellExpansion("a*T", {}, {{"a", 1}}), formula::FormulaError);
  EXPECT_THROW(physics::shellExpansion("a + b + c + d + e", {"a", "b", "c", "d", "e"}, {}),
               formula::FormulaError);
  EXPECT_THROW(physics::expansionOf("lambda*zeta", {}, {}), formula::FormulaError);
}
