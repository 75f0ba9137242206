#pragma once

#include <memory>

#include "ContactModel.hpp"
#include "PlaneContact.hpp"

/// Plane bodies on tools, their contact integrated over zones.
namespace atrapos::contact::test {

/// Contact alone: of a row of four edges 1 wide on y = 0, displaced.
struct Row {
  fem::Mesh mesh;
  fem::FeProblem problem;

  Row(fem::Topology cell, const RigidTool& tool, const Overclosure& law,
      const solid::PlaneSection& section = {})
      : mesh(planeMesh(cell, {4, 1}, {4, 1})), problem(model(tool, law, section)) {}

  fem::FeModel model(const RigidTool& tool, const Overclosure& law, const solid::PlaneSection& section) {
    fem::FeModel all = planeModel(mesh, section, 10, 0.3);
    addZones(all, mesh, section, tool, law);
    return all;
  }
  std::size_t dofs() const { return 2 * static_cast<std::size_t>(mesh.numNodes()); }
  Numbers forces(const Numbers& u, double lambda = 0) {
    return problem.forces(problem.term(1), {fem::test::vectorOf(problem, u), lambda});
  }
  double forceUp(const Numbers& u) {
    const Numbers f = forces(u);
    double sum = 0;
    for (std::size_t d = 1; d < f.size(); d += 2) sum -= f[d];
    return sum;
  }
};

/// A body of two rows of cells on a tool, its top pressed down by lambda.
struct Pressed {
  fem::Mesh mesh;
  std::unique_ptr<RigidTool> tool;
  fem::LineSet lines;
  fem::FeProblem problem;

  Pressed(fem::Topology cell, std::unique_ptr<RigidTool> on, int exponent = 1)
      : mesh(planeMesh(cell, {3, 2}, {3, 1})), tool(std::move(on)), problem(model(exponent)) {}

  fem::FeModel model(int exponent) {
    fem::FeModel all = planeModel(mesh, {}, 10, 0.3);
    for (const int n : fem::test::nodesOfSet(mesh, "y_max")) {
      all.prescribe(n, 0, 0, 0.1);
      all.prescribe(n, 1, 0, -1);
    }
    lines = addZones(all, mesh, {}, *tool, {200, exponent});
    return all;
  }
  /// Equilibrium at lambda, from the undeformed body moved as a whole.
  Numbers at(double lambda) {
    Numbers u;
    for (int n = 0; n < mesh.numNodes(); ++n) u.insert(u.end(), {0.1 * lambda, -lambda});
    return fem::test::equilibrium(problem, lambda, u, 1e-13).u;
  }
  path::State stateAt(double lambda) {
    return problem.settled({fem::test::vectorOf(problem, at(lambda)), lambda});
  }
};

}  // namespace atrapos::contact::test
