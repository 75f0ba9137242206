#include "atrapos/fem/Multipliers.hpp"

#include <stdexcept>

namespace atrapos::fem {

PointSet withMultipliers(FeModel& model, const PointSet& points) {
  if (points.shapeComponents != 1) throw std::logic_error("withMultipliers: points with shape values only");
  const int N = points.nodesPerEntity, Q = points.pointsPerEntity;
  PointSet result;
  result.numEntities = points.numPoints();
  result.nodesPerEntity = N + 1;
  result.pointsPerEntity = result.shapeComponents = 1;
  result.weights = points.weights;
  result.positions = points.positions;
  result.normals = points.normals;
  const int first = model.numNodes;
  for (int e = 0; e < points.numEntities; ++e)
    for (int q = 0; q < Q; ++q) {
      for (int n = 0; n < N; ++n) {
        result.nodes.push_back(points.nodes[e * N + n]);
        result.shape.push_back(points.shape[(e * Q + q) * N + n]);
      }
      result.nodes.push_back(model.numNodes++);
      result.shape.push_back(0);
    }
  model.supports.addNodes(model.numNodes - first);
  for (int m = first; m < model.numNodes; ++m)
    for (int i = 1; i < 3; ++i) model.supports.prescribe(m, i, 0, 0);
  return result;
}

PointSet withUnknowns(PointSet points) {
  std::vector<double> shape;
  const int N = points.nodesPerEntity;
  for (std::size_t n = 0; n < points.shape.size(); ++n) {
    shape.push_back(points.shape[n]);
    shape.push_back(n % N == static_cast<std::size_t>(N - 1) ? 1.0 : 0.0);
  }
  points.shape = std::move(shape);
  points.shapeComponents = 2;
  return points;
}

}  // namespace atrapos::fem
