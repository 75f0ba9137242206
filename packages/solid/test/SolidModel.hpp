#pragma once

#include "atrapos/fem/FeProblem.hpp"
#include "atrapos/fem/LawTerm.hpp"
#include "atrapos/solid/SaintVenantKirchhoff.hpp"
#include "support/Meshes.hpp"
#include "support/Vectors.hpp"

namespace atrapos::solid::test {

using fem::test::Numbers;

/// Saint Venant-Kirchhoff everywhere, no supports and no loads yet; the cells' default cubature, or `cell`
/// (meshes of one block).
inline fem::FeModel solidModel(const fem::Mesh& mesh, const SaintVenantKirchhoff& law,
                               const fem::Tabulation* cell = nullptr) {
  fem::FeModel model;
  model.dofs = fem::DofMap::displacements(mesh.numNodes());
  for (const fem::Block& block : mesh.blocks)
    model.terms.push_back(fem::lawTerm(
        fem::pointLaw(law), fem::volumePoints(mesh, block, cell ? *cell : fem::tabulate(block.topology))));
  model.constantLoad.assign(3 * mesh.numNodes(), 0.0);
  model.load.assign(3 * mesh.numNodes(), 0.0);
  return model;
}

/// Nodes on the six faces of the box that the mesh was before its nodes were moved.
inline std::vector<int> boundaryNodes(const fem::Mesh& mesh) {
  std::vector<int> nodes;
  for (const fem::SideSet& set : mesh.sideSets)
    for (int n : fem::nodesOf(mesh, set)) nodes.push_back(n);
  return nodes;
}

}  // namespace atrapos::solid::test
