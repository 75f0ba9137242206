// A cantilever whose mesh the application holds in memory, as Exodus has it: coordinates in three arrays,
// connectivity by element block and sides of elements, numbers from 1. It is handed over without a file;
// results go back by node number.
#include <Tpetra_Core.hpp>
#include <Tpetra_Vector.hpp>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>

#include "atrapos/fem/FeProblem.hpp"
#include "atrapos/fem/LawTerm.hpp"
#include "atrapos/fem/Loads.hpp"
#include "atrapos/fem/StructuredMesh.hpp"
#include "atrapos/linear/MakeTangentSolver.hpp"
#include "atrapos/path/PathFollower.hpp"
#include "atrapos/solid/SaintVenantKirchhoff.hpp"

using namespace atrapos;

/// What the application has.
struct HostMesh {
  struct Block {
    int id;
    std::string type;          // Exodus' name of the element
    std::vector<int> connect;  // [element][node], from 1
  };
  struct SideSet {
    int id;
    std::vector<int> elements, sides;  // from 1, elements counted over all blocks
  };
  struct NodeSet {
    int id;
    std::vector<int> nodes;  // from 1
  };
  std::vector<double> x, y, z;
  std::vector<Block> blocks;
  std::vector<NodeSet> nodeSets;
  std::vector<SideSet> sideSets;
};

/// A bar of nx cells along x, 10 x 1 x 1, in the application's own numbering: cells and nodes in two blocks,
/// the second half first.
static HostMesh hostBar(int nx) {
  HostMesh mesh;
  for (int j = 0; j < 4; ++j)  // node numbers run along the bar
    for (int i = 0; i <= nx; ++i) {
      mesh.x.push_back(10.0 * i / nx);
      mesh.y.push_back(j % 2);
      mesh.z.push_back(j / 2);
    }
  const auto node = [&](int i, int j) { return j * (nx + 1) + i + 1; };
  mesh.blocks = {{20, "HEX8", {}}, {10, "HEX8", {}}};
  for (int i = 0; i < nx; ++i) {
    auto& connect = mesh.blocks[i < nx / 2 ? 1 : 0].connect;
    for (const int n : {node(i, 0), node(i + 1, 0), node(i + 1, 1), node(i, 1), node(i, 2), node(i + 1, 2),
                        node(i + 1, 3), node(i, 3)})
      connect.push_back(n);
  }
  for (int j = 0; j < 4; ++j) {
    if (j == 0) mesh.nodeSets.push_back({1, {}});
    mesh.nodeSets[0].nodes.push_back(node(0, j));
  }
  const int last = nx - nx / 2;               // the bar's last cell ends the first block
  mesh.sideSets.push_back({2, {last}, {2}});  // side 2 of a HEX8 lies at its largest x here
  return mesh;
}

/// The whole hand-over. Atrapos counts from 0 and keeps coordinates node by node.
static fem::Mesh handOver(const HostMesh& host) {
  fem::Mesh mesh;
  for (std::size_t n = 0; n < host.x.size(); ++n)
    mesh.coordinates.insert(mesh.coordinates.end(), {host.x[n], host.y[n], host.z[n]});
  for (const auto& b : host.blocks) {
    if (b.type != "HEX8") throw std::invalid_argument("block " + std::to_string(b.id) + ": only HEX8 here");
    fem::Block block;
    block.id = b.id;
    block.topology = fem::Topology::Hex8;
    for (const int n : b.connect) block.nodes.push_back(n - 1);
    mesh.blocks.push_back(block);
  }
  for (const auto& s : host.nodeSets) {
    fem::NodeSet set;
    set.id = s.id;
    for (const int n : s.nodes) set.nodes.push_back(n - 1);
    mesh.nodeSets.push_back(set);
  }
  for (const auto& s : host.sideSets) {
    fem::SideSet set;
    set.id = s.id;
    for (std::size_t i = 0; i < s.elements.size(); ++i)
      set.sides.push_back({s.elements[i] - 1, s.sides[i] - 1});
    mesh.sideSets.push_back(set);
  }
  return mesh;
}

struct Silent : path::Observer {
  bool onStep(const path::StepReport&, const path::Series&) override { return true; }
};

/// Deflection of the node at (10, 0, 0) under a force at the end, held at these nodes and loaded on this side
/// set.
static double deflection(const fem::Mesh& mesh, const std::vector<int>& held, const fem::SideSet& loaded) {
  const auto law = solid::SaintVenantKirchhoff::fromYoung(1000, 0);
  fem::FeModel model;
  model.dofs = fem::DofMap::displacements(mesh.numNodes());
  for (const auto& block : mesh.blocks)
    model.terms.push_back(
        fem::lawTerm(fem::pointLaw(law), fem::volumePoints(mesh, block, fem::tabulate(block.topology))));
  for (const int n : held)
    for (int i = 0; i < 3; ++i) model.prescribe(n, i, 0, 0);
  model.load.assign(3 * mesh.numNodes(), 0.0);
  fem::addSurfaceForce(mesh, loaded, {0, 0, -1}, model.load);
  fem::FeProblem problem(std::move(model));
  const auto solver = linear::makeTangentSolver({});
  path::Options options;
  options.residualBound = 1e-9;
  path::Stops stops;
  stops.loadFactors = {1.0};
  Silent observer;
  const auto outcome =
      path::PathFollower(problem, *solver, options, stops).run({problem.initialState(0.0), 0.0}, observer);
  if (outcome.reason != path::EndReason::stopReached) throw std::runtime_error(outcome.text);
  const auto u = fem::FeProblem::values(*outcome.final.u);
  for (int n = 0; n < mesh.numNodes(); ++n)
    if (mesh.coordinates[3 * n] == 10 && mesh.coordinates[3 * n + 1] == 0 && mesh.coordinates[3 * n + 2] == 0)
      return u[3 * n + 2];
  throw std::logic_error("no node at (10, 0, 0)");
}

int main(int argc, char** argv) {
  const Tpetra::ScopeGuard guard(&argc, &argv);
  constexpr int cells = 20;
  const fem::Mesh mine = handOver(hostBar(cells));
  const double handedOver = deflection(mine, mine.nodeSets[fem::findNodeSet(mine, "1")].nodes,
                                       mine.sideSets[fem::findSideSet(mine, "2")]);
  fem::BoxOptions box;
  box.lengths = {10, 1, 1};
  box.divisions = {cells, 1, 1};
  const fem::Mesh same = fem::boxMesh(box);
  const double expected = deflection(same, same.nodeSets[fem::findNodeSet(same, "x_min")].nodes,
                                     same.sideSets[fem::findSideSet(same, "x_max")]);
  std::printf("deflection %.12f, of the same bar by boxMesh %.12f\n", handedOver, expected);
  // The same equations in another order, each solved to a relative residual of 1e-9.
  return std::abs(handedOver - expected) < 1e-7 * std::abs(expected) && expected < -1 ? 0 : 1;
}
