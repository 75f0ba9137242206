#include "atrapos/fem/Multipliers.hpp"

#include <map>
#include <set>
#include <stdexcept>
#include <utility>

#include "atrapos/fem/ReferenceCell.hpp"

namespace atrapos::fem {
namespace {

/// The face with this number of nodes, and the one of its corners alone.
std::pair<Face, Face> facesOf(int numNodes) {
  switch (numNodes) {
    case 3:
      return {Face::Tri3, Face::Tri3};
    case 6:
      return {Face::Tri6, Face::Tri3};
    case 4:
      return {Face::Quad4, Face::Quad4};
    case 8:
    case 16:  // with directors
      return {Face::Quad8, Face::Quad4};
    case 9:
    case 18:
      return {Face::Quad9, Face::Quad4};
    default:
      throw std::logic_error("withCornerMultipliers: not the points of faces");
  }
}

int numCorners(Face cornerFace) { return cornerFace == Face::Tri3 ? 3 : 4; }

/// Multipliers use the first dof of their nodes.
void holdOtherDofs(FeModel& model, int first) {
  model.supports.addNodes(model.numNodes - first);
  for (int m = first; m < model.numNodes; ++m)
    for (int i = 1; i < 3; ++i) model.supports.prescribe(m, i, 0, 0);
}

}  // namespace

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
  holdOtherDofs(model, first);
  return result;
}

std::vector<int> cornersOf(const PointSet& faces) {
  const int N = faces.nodesPerEntity, M = numCorners(facesOf(N).second);
  std::vector<int> corners;
  std::set<int> known;
  for (int e = 0; e < faces.numEntities; ++e)
    for (int m = 0; m < M; ++m)
      if (const int node = faces.nodes[static_cast<std::size_t>(e) * N + m]; known.insert(node).second)
        corners.push_back(node);
  return corners;
}

UnilateralPoints withCornerMultipliers(FeModel& model, const PointSet& faces) {
  if (faces.shapeComponents != 1)
    throw std::logic_error("withCornerMultipliers: points with shape values only");
  const int N = faces.nodesPerEntity, Q = faces.pointsPerEntity;
  const auto [face, cornerFace] = facesOf(N);
  const std::vector<double> reference = referenceNodes(face);
  const int own = static_cast<int>(reference.size()) / 2, M = numCorners(cornerFace);
  UnilateralPoints result;
  result.conditions = M;
  PointSet& points = result.points;
  points = faces;
  points.nodesPerEntity = N + M;
  points.nodes.clear();
  points.shape.clear();
  const int first = model.numNodes;
  std::map<int, int> multiplierAt;  // corner node -> node of its multiplier
  for (const int corner : cornersOf(faces)) multiplierAt[corner] = model.numNodes++;
  std::vector<double> places;  // reference coordinates of all points
  for (int e = 0; e < faces.numEntities; ++e) {
    const int* nodes = &faces.nodes[static_cast<std::size_t>(e) * N];
    points.nodes.insert(points.nodes.end(), nodes, nodes + N);
    for (int m = 0; m < M; ++m) points.nodes.push_back(multiplierAt.at(nodes[m]));
    for (int q = 0; q < Q; ++q) {
      const double* shape = &faces.shape[(static_cast<std::size_t>(e) * Q + q) * N];
      points.shape.insert(points.shape.end(), shape, shape + N);
      points.shape.insert(points.shape.end(), M, 0.0);
      // The shape functions reproduce the reference coordinates.
      for (int i = 0; i < 2; ++i) {
        double x = 0;
        for (int n = 0; n < own; ++n) x += shape[n] * reference[2 * n + i];
        places.push_back(x);
      }
    }
  }
  result.functions = tabulateFaceAt(cornerFace, places).values;
  holdOtherDofs(model, first);
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
