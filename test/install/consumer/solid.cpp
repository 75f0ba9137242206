// A bar of one cell pulled to load factor 1 with the installed library, from mesh to path: P/(EA) = s (s^2 -
// 1)/2 for the stretch s of a Saint Venant-Kirchhoff bar with nu = 0.
#include <Kokkos_Core.hpp>
#include <Tpetra_Core.hpp>
#include <Tpetra_Vector.hpp>
#include <cmath>
#include <cstdio>

#include "atrapos/fem/FeProblem.hpp"
#include "atrapos/fem/LawTerm.hpp"
#include "atrapos/fem/Loads.hpp"
#include "atrapos/fem/StructuredMesh.hpp"
#include "atrapos/linear/MakeTangentSolver.hpp"
#include "atrapos/path/PathFollower.hpp"
#include "atrapos/solid/SaintVenantKirchhoff.hpp"

using namespace atrapos;

struct Silent : path::Observer {
  bool onStep(const path::StepReport&, const path::Series&) override { return true; }
};

static int follow() {
  const fem::Mesh mesh = fem::boxMesh({});  // the unit cube
  fem::FeModel model;
  model.dofs = fem::DofMap::displacements(mesh.numNodes());
  const auto law = solid::SaintVenantKirchhoff::fromYoung(1.0, 0.0);
  const auto points = fem::volumePoints(mesh, mesh.blocks[0], fem::tabulate(fem::Topology::Hex8));
  model.terms.push_back(fem::lawTerm(fem::pointLaw(law), points));
  const char* faces[] = {"x_min", "y_min", "z_min"};
  for (int i = 0; i < 3; ++i)
    for (int node : mesh.nodeSets[fem::findNodeSet(mesh, faces[i])].nodes) model.prescribe(node, i, 0, 0);
  model.load.assign(3 * mesh.numNodes(), 0.0);
  const double s = 1.25, force = s * (s * s - 1) / 2;
  fem::addSurfaceForce(mesh, mesh.sideSets[fem::findSideSet(mesh, "x_max")], {force, 0, 0}, model.load);

  fem::FeProblem problem(std::move(model));
  const auto solver = linear::makeTangentSolver({});
  path::Stops stops;
  stops.loadFactors = {1.0};
  path::PathFollower follower(problem, *solver, {}, stops);
  Silent observer;
  const auto outcome = follower.run({problem.initialState(0.0), 0.0}, observer);
  const int corner = mesh.nodeSets[fem::findNodeSet(mesh, "x_max")].nodes[0];
  const double u = fem::FeProblem::values(*outcome.final.u)[3 * corner];
  // The default bound of the relative residual is 1e-6.
  if (outcome.reason == path::EndReason::stopReached && std::abs(u - (s - 1)) < 1e-5) return 0;
  std::printf("%s: u = %.10g instead of %.10g\n", outcome.text.c_str(), u, s - 1);
  return 1;
}

int main(int argc, char** argv) {
  const Tpetra::ScopeGuard guard(&argc, &argv);
  return follow();
}
