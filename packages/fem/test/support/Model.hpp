#pragma once

#include "atrapos/fem/FeProblem.hpp"
#include "atrapos/fem/LawTerm.hpp"
#include "atrapos/fem/PointLawOf.hpp"
#include "support/Laws.hpp"
#include "support/Meshes.hpp"

namespace atrapos::fem::test {

/// Data of a PointSet's points for ExponentialSolid: stiffness from 0.5 to 1.5, different from point to
/// point.
std::vector<double> unevenScale(const PointSet& points, unsigned seed);

/// One ExponentialSolid term for every block.
std::vector<std::unique_ptr<Term>> solidTerms(const Mesh& mesh);

/// ExponentialSolid with supports, driven supports and both kinds of loads: nodes at x < 0.1 held, z of them
/// driven; y driven along the edge of large x and z; forces at every node that has an element.
FeModel busyModel(const Mesh& mesh);

/// HeatedSolid<source> with quadratic displacements (HEX20) and a temperature at corner nodes alone, some of
/// it supported and driven; random loads on both fields. `conductivity`: the law's k.
template <int source>
FeModel heatedModel(const Mesh& mesh, double conductivity = 0.6) {
  const Field temperature{"temperature", {""}, Role::primal};
  std::vector<char> isCorner(mesh.numNodes(), 0);
  for (std::size_t i = 0; i < mesh.blocks[0].nodes.size(); ++i)
    if (i % 20 < 8) isCorner[mesh.blocks[0].nodes[i]] = 1;
  std::vector<int> corners;
  for (int n = 0; n < mesh.numNodes(); ++n)
    if (isCorner[n]) corners.push_back(n);
  FeModel model;
  model.dofs = DofMap(mesh.numNodes(), {{displacementField(), {}}, {temperature, corners}});
  const Tabulation cell = tabulate(Topology::Hex20), shape = tabulateAt(Topology::Hex8, cell.points);
  PointSet points = volumePoints(mesh, mesh.blocks[0], cell);
  points.more = {valuesOf(temperature, points, shape), gradientsOf(temperature, points, shape)};
  HeatedSolid<source> law;
  law.k = conductivity;
  model.terms.push_back(lawTerm(pointLaw(law), points));
  for (int n = 0; n < mesh.numNodes(); ++n)
    if (mesh.coordinates[3 * n] < 0.1) {
      for (int i = 0; i < 3; ++i) model.prescribe(n, i, 0.01 * i, 0.1);
      if (isCorner[n]) model.prescribe(n, 0, 0.1, 0.5, "temperature");
    }
  model.load = randomNumbers(model.dofs.numDofs(), 0.05, 22);
  model.constantLoad = randomNumbers(model.dofs.numDofs(), 0.01, 23);
  return model;
}

}  // namespace atrapos::fem::test
