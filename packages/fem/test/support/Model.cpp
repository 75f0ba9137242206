#include "support/Model.hpp"

namespace atrapos::fem::test {

std::vector<double> unevenScale(const PointSet& points, unsigned seed) {
  auto data = randomNumbers(points.numPoints(), 0.5, seed);
  for (double& s : data) s += 1.0;
  return data;
}

std::vector<std::unique_ptr<Term>> solidTerms(const Mesh& mesh) {
  std::vector<std::unique_ptr<Term>> terms;
  for (const Block& block : mesh.blocks) {
    const PointSet points = volumePoints(mesh, block, tabulate(block.topology));
    terms.push_back(lawTerm(pointLaw(ExponentialSolid{}), points,
                            unevenScale(points, 11 + static_cast<unsigned>(terms.size()))));
  }
  return terms;
}

FeModel busyModel(const Mesh& mesh) {
  FeModel model;
  model.dofs = DofMap::displacements(mesh.numNodes());
  model.terms = solidTerms(mesh);
  for (int n = 0; n < mesh.numNodes(); ++n) {
    if (mesh.coordinates[3 * n] < 0.1) {
      model.prescribe(n, 0, 0.01, 0.0);
      model.prescribe(n, 1, 0.0, 0.0);
      model.prescribe(n, 2, 0.02, 0.3);
    } else if (mesh.coordinates[3 * n] > 0.9 && mesh.coordinates[3 * n + 2] > 0.9) {
      model.prescribe(n, 1, 0.0, -0.2);
    }
  }
  model.constantLoad = randomNumbers(3 * mesh.numNodes(), 0.01, 21);
  model.load = randomNumbers(3 * mesh.numNodes(), 0.05, 22);
  std::vector<char> used(mesh.numNodes(), 0);
  for (const auto& term : model.terms)
    for (int n : term->nodes()) used[n] = 1;
  for (int d = 0; d < 3 * mesh.numNodes(); ++d)
    if (!used[d / 3]) model.constantLoad[d] = model.load[d] = 0;
  return model;
}

}  // namespace atrapos::fem::test
