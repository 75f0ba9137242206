#include "scene/Extents.hpp"

#include <algorithm>
#include <limits>

namespace atrapos {

Extents extentsOf(const fem::Mesh& mesh, const fem::Block& block) {
  constexpr double far = std::numeric_limits<double>::infinity();
  const auto perCell = static_cast<std::size_t>(fem::nodesPerElement(block.topology));
  Extents extents;
  for (int axis = 0; axis < mesh.dimension; ++axis) {
    double low = far, high = -far;
    for (std::size_t first = 0; first < block.nodes.size(); first += perCell) {
      double cellLow = far, cellHigh = -far;
      for (std::size_t n = first; n < first + perCell; ++n) {
        const double x =
            mesh.coordinates[3 * static_cast<std::size_t>(block.nodes[n]) + static_cast<std::size_t>(axis)];
        cellLow = std::min(cellLow, x);
        cellHigh = std::max(cellHigh, x);
      }
      extents.cell[axis] = std::max(extents.cell[axis], cellHigh - cellLow);
      low = std::min(low, cellLow);
      high = std::max(high, cellHigh);
    }
    extents.body[axis] = high - low;
  }
  return extents;
}

std::pair<double, double> rangeAlong(const fem::Mesh& mesh, int axis) {
  if (mesh.numNodes() == 0) return {0, 0};
  double low = mesh.coordinates[static_cast<std::size_t>(axis)], high = low;
  for (auto i = static_cast<std::size_t>(axis); i < mesh.coordinates.size(); i += 3) {
    low = std::min(low, mesh.coordinates[i]);
    high = std::max(high, mesh.coordinates[i]);
  }
  return {low, high};
}

double longestSide(const fem::Mesh& mesh) {
  double size = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto [low, high] = rangeAlong(mesh, axis);
    size = std::max(size, high - low);
  }
  return size;
}

}  // namespace atrapos
