// Cost of shell elements, of eight nodes with compatible and assumed transverse shear, of four and of three
// (squares of two), against HEX20 (full cubature, as a row one cell wide and thick needs) on the strip of the
// paper, 400 x 20 x 0.8 mm, as a cantilever bent by 2 N at its end to a deflection of 179 mm: error of the
// deflection, times of the tangent and of all orders 1..20 of a series, best of several.
#include <Tpetra_Core.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <string>

#include "ShellPath.hpp"
#include "SolidModel.hpp"
#include "atrapos/fem/Loads.hpp"
#include "atrapos/fem/StructuredMesh.hpp"

using namespace atrapos;
using namespace atrapos::solid;
using namespace atrapos::solid::test;

namespace {

constexpr double length = 400, width = 20, thickness = 0.8, force = 2;
constexpr double deflection = 179.0373;  // to which both kinds of meshes converge
constexpr int order = 20, repeats = 9;
const auto material = SaintVenantKirchhoff::fromYoung(220000, 0);

template <class Work>
double seconds(const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

struct Case {
  std::string name;
  std::unique_ptr<fem::FeProblem> problem;
  int tipDof = 0;
};

Case shell(int n, Shear shear) {
  const ShellGrid grid = shellGrid(n, 1, thickness, flat(length, width), undistorted, nodesOf(shear));
  fem::FeModel model = shellModel(grid, material, {}, shear);
  clamp(model, grid, grid.lineI(0));
  addShellEdgeForce(grid.elements(), grid.side(1), {0, 0, -force / width}, model.load);
  constexpr const char* names[] = {"shell ", "assumed ", "SHELL4 ", "SHELL3 ", "SHELL6 "};
  const int tip = grid.lineI(2 * n)[nodesOf(shear) > 4 ? 1 : 0];
  return {names[static_cast<int>(shear)] + std::to_string(n),
          std::make_unique<fem::FeProblem>(std::move(model)), 3 * tip + 2};
}

Case hex20(int n) {
  fem::StripOptions options;
  options.length = length;
  options.width = width;
  options.thickness = thickness;
  options.divisions = {n, 1, 1};
  const fem::Mesh mesh = fem::stripMesh(options);
  const auto cell = fem::tabulate(fem::Topology::Hex20, 5);
  fem::FeModel model = solidModel(mesh, material, &cell);
  for (int k : fem::test::nodesOfSet(mesh, "x_min"))
    for (int i = 0; i < 3; ++i) model.prescribe(k, i, 0, 0);
  fem::addSurfaceForce(mesh, fem::test::sideSet(mesh, "x_max"), {0, 0, -force}, model.load);
  return {"HEX20 " + std::to_string(n), std::make_unique<fem::FeProblem>(std::move(model)),
          3 * fem::test::nodesOfSet(mesh, "x_max_mid").at(0) + 2};
}

void measure(const Case& c) {
  fem::FeProblem& problem = *c.problem;
  path::Stops stops;
  stops.loadFactors = {1};
  const ShellPath path = followPath(problem, stops);
  const double error = std::abs(-atLoad(path, 1, {c.tipDof}).u[0] - deflection) / deflection;
  const path::State& state = path.outcome.final;
  const path::Series& last = path.series.back();  // may have fewer orders: it ends at the stop
  auto F = fem::test::zeroVector(problem);
  double tangent = 1e9, orders = 1e9;
  for (int i = 0; i < repeats; ++i) {
    tangent = std::min(tangent, seconds([&] { problem.tangent(state, *F); }));
    orders = std::min(orders, seconds([&] {
                        problem.beginSeries(state, order);
                        for (int k = 1; k <= order; ++k) {
                          problem.orderRhs(k, *F);
                          problem.completeOrder(k, *last.coefficient(std::min(k, last.order())).u, 0);
                        }
                      }));
  }
  const int dofs = problem.numFreeDofs();
  std::printf("%-10s %7d %9.1e %12.3f %12.3f %12.2f %12.2f %10.3f\n", c.name.c_str(), dofs, error,
              tangent * 1e3, orders * 1e3, tangent * 1e6 / dofs, orders * 1e6 / dofs,
              path.outcome.seconds.total);
}

}  // namespace

int main(int argc, char** argv) {
  Tpetra::ScopeGuard scope(&argc, &argv);
  std::printf("%-10s %7s %9s %12s %12s %12s %12s %10s\n", "elements", "dofs", "error", "tangent ms",
              "orders ms", "tangent us/d", "orders us/d", "path s");
  for (Shear shear : {Shear::compatible, Shear::assumed, Shear::mitc4, Shear::mitc3, Shear::mitc6})
    for (int n : {4, 8, 16, 32, 64}) measure(shell(n, shear));
  measure(shell(128, Shear::mitc4));
  for (int n : {20, 40, 80, 160}) measure(hex20(n));
}
