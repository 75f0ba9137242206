// Several problems in one process: two meshes and two communicators, one path followed inside the observer of
// another, and, on several ranks, one on each at the same time. Each gives the same bits as alone. One that
// several ranks share gives the same path. Prints nothing unless something is wrong, and neither does the
// library: the test looks.
#include <Teuchos_DefaultMpiComm.hpp>
#include <Tpetra_Core.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>

#include "atrapos/fem/FeProblem.hpp"
#include "atrapos/fem/LawTerm.hpp"
#include "atrapos/fem/Loads.hpp"
#include "atrapos/fem/StructuredMesh.hpp"
#include "atrapos/linear/MakeTangentSolver.hpp"
#include "atrapos/path/NewtonFollower.hpp"
#include "atrapos/path/PathFollower.hpp"
#include "atrapos/solid/SaintVenantKirchhoff.hpp"

using namespace atrapos;
using Comm = Teuchos::RCP<const Teuchos::Comm<int>>;

/// A cantilever of so many cells under a force at its end, followed to load factor 1.
struct Cantilever {
  int cells = 4;
  bool newton = false;
  Comm comm;
  std::function<void()> meanwhile = [] {};  ///< after every step

  struct Watch : path::Observer {
    const std::function<void()>& meanwhile;
    explicit Watch(const std::function<void()>& call) : meanwhile(call) {}
    bool onStep(const path::StepReport&, const path::Series&) override {
      meanwhile();
      return true;
    }
  };

  std::vector<double> follow() const {
    fem::BoxOptions box;
    box.lengths = {8, 1, 1};
    box.divisions = {cells, 1, 1};
    const fem::Mesh mesh = fem::boxMesh(box);
    fem::FeModel model;
    model.comm = comm;
    model.dofs = fem::DofMap::displacements(mesh.numNodes());
    const auto law = solid::SaintVenantKirchhoff::fromYoung(1000.0 + cells, 0.2);
    model.terms.push_back(fem::lawTerm(
        fem::pointLaw(law), fem::volumePoints(mesh, mesh.blocks[0], fem::tabulate(fem::Topology::Hex8))));
    for (const int node : mesh.nodeSets[fem::findNodeSet(mesh, "x_min")].nodes)
      for (int i = 0; i < 3; ++i) model.prescribe(node, i, 0, 0);
    model.load.assign(3 * mesh.numNodes(), 0.0);
    fem::addSurfaceForce(mesh, mesh.sideSets[fem::findSideSet(mesh, "x_max")], {0, 0, -2}, model.load);
    fem::FeProblem problem(std::move(model));
    const auto solver = linear::makeTangentSolver({});
    path::Stops stops;
    stops.loadFactors = {1.0};
    Watch watch(meanwhile);
    const path::State start{problem.initialState(0.0), 0.0};
    path::Outcome outcome;
    if (newton)
      outcome = path::NewtonFollower(problem, *solver, {}, stops).run(start, watch);
    else
      outcome = path::PathFollower(problem, *solver, {}, stops).run(start, watch);
    if (outcome.reason != path::EndReason::stopReached) return {};
    return fem::FeProblem::values(*outcome.final.u);
  }
};

static bool independent() {
  int rank = 0, size = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  MPI_Comm alone, split;
  MPI_Comm_dup(MPI_COMM_SELF, &alone);
  MPI_Comm_split(MPI_COMM_WORLD, rank, 0, &split);
  bool good = true;
  {
    Cantilever a, b;
    a.cells = 4 + rank;  // ranks do different things at the same time
    b.cells = 7;
    b.newton = true;
    a.comm = Teuchos::rcp(new Teuchos::MpiComm<int>(alone));
    b.comm = Teuchos::rcp(new Teuchos::MpiComm<int>(split));
    const auto first = a.follow(), second = b.follow();
    std::vector<double> inside;
    int calls = 0;
    a.meanwhile = [&] {
      inside = b.follow();
      ++calls;
    };
    const auto again = a.follow();
    const auto check = [&](bool holds, const char* what) {
      if (!holds) std::printf("rank %d: %s\n", rank, what);
      good = good && holds;
    };
    check(!first.empty() && !second.empty(), "a path does not reach its end");
    check(calls > 0, "no path was followed inside another");
    check(first == again, "a path depends on what is followed inside it");
    check(inside == second, "a path depends on where it is followed");
    if (size > 1) {  // all ranks share one problem
      b.comm = Teuchos::null;
      const auto shared = b.follow();
      double off = shared.size() == second.size() ? 0 : 1, largest = 0;
      for (std::size_t i = 0; i < shared.size() && off < 1; ++i) {
        off = std::max(off, std::abs(shared[i] - second[i]));
        largest = std::max(largest, std::abs(second[i]));
      }
      // Shared rows are summed in another order; the tangent's condition number is some 1e5.
      check(off < 1e-9 * largest, "a path depends on the number of ranks");
    }
  }
  MPI_Comm_free(&alone);
  MPI_Comm_free(&split);
  return good;
}

int main(int argc, char** argv) {
  bool good = false;
  {
    const Tpetra::ScopeGuard guard(&argc, &argv);
    good = independent();
    int finalized = 0;
    MPI_Finalized(&finalized);
    if (finalized || !Kokkos::is_initialized()) {
      std::printf("the library ended MPI or Kokkos\n");
      good = false;
    }
  }
  return good ? 0 : 1;
}
