#include "scene/ShellFields.hpp"

#include <cmath>

#include "atrapos/solid/ShellResults.hpp"

namespace atrapos {

std::vector<double> meansOverPoints(const std::vector<double>& values, std::size_t points, std::size_t each) {
  std::vector<double> result(values.size() / points, 0.0);
  for (std::size_t i = 0; i < values.size(); ++i)
    result[i / (points * each) * each + i % each] += values[i] / static_cast<double>(points);
  return result;
}

std::vector<std::vector<double>> directorFields(const SceneShells& shells, const std::vector<double>& u) {
  const fem::ShellGeometry& g = shells.geometry;
  std::vector<std::vector<double>> fields(4, std::vector<double>(g.numMeshNodes, 0.0));
  for (int d = 0; d < g.numDirectors(); ++d) {
    const int node = g.meshNode[d];
    const double part = 1.0 / (g.firstDirector[node + 1] - g.firstDirector[node]);
    for (int i = 0; i < 3; ++i)
      fields[i][node] += part * (g.directors[3 * static_cast<std::size_t>(d) + i] +
                                 u[3 * static_cast<std::size_t>(g.numMeshNodes + d) + i]);
  }
  std::vector<int> elementsAt(g.numMeshNodes, 0);
  for (const solid::ShellElements& elements : shells.elements) {
    const auto change = solid::thicknessChange(elements, u);
    for (std::size_t i = 0; i < change.size(); ++i) {
      const int N = elements.nodesPerElement, node = elements.node(static_cast<int>(i) / N, i % N);
      fields[3][node] += change[i];
      ++elementsAt[node];
    }
  }
  for (int n = 0; n < g.numMeshNodes; ++n)
    if (elementsAt[n] > 0) fields[3][n] /= elementsAt[n];
  return fields;
}

std::vector<double> meanSurfaceStress(const solid::ShellElements& elements, const fem::PointValues& observed,
                                      const solid::ShellCubature& cubature, double zeta) {
  return meansOverPoints(solid::surfaceStress(observed, cubature, zeta),
                         static_cast<std::size_t>(solid::pointsInPlane(cubature, elements.nodesPerElement)),
                         6);
}

std::vector<double> meanResultants(const solid::ShellElements& elements, const fem::PointValues& observed,
                                   const solid::ShellCubature& cubature, const std::vector<double>& u) {
  solid::ShellResultOptions options;
  options.cubature = cubature;
  return meansOverPoints(solid::shellResultants(elements, observed, u, options).values,
                         static_cast<std::size_t>(solid::pointsInPlane(cubature, elements.nodesPerElement)),
                         solid::ShellResultants::names().size());
}

}  // namespace atrapos
