#include "atrapos/fem/Multipliers.hpp"

#include <map>
#include <set>
#include <stdexcept>
#include <utility>

#include "atrapos/fem/ReferenceCell.hpp"

namespace atrapos::fem {
namespace {

/// The faces of these points, and those of their corners alone.
std::pair<Face, Face> facesOf(const PointSet& points) {
  const bool edges = points.components == 2;
  switch (points.nodesPerEntity) {
    case 2:
      return {Face::Line2, Face::Line2};
    case 3:
      return edges ? std::pair(Face::Line3, Face::Line2) : std::pair(Face::Tri3, Face::Tri3);
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

const Field& contactForce() {
  static const Field field{"contact force", {""}, Role::oneSided};
  return field;
}

}  // namespace

PointSet eachPoint(const PointSet& points) {
  if (points.shapeComponents != 1) throw std::logic_error("eachPoint: points with shape values only");
  const std::size_t N = points.nodesPerEntity, Q = points.pointsPerEntity;
  PointSet result = points;
  result.numEntities = points.numPoints();
  result.pointsPerEntity = 1;
  result.nodes.clear();
  for (std::size_t p = 0; p < static_cast<std::size_t>(points.numPoints()); ++p)
    result.nodes.insert(result.nodes.end(), &points.nodes[p / Q * N], &points.nodes[p / Q * N] + N);
  return result;
}

UnilateralPoints withMultipliers(FeModel& model, const PointSet& points) {
  UnilateralPoints result;
  result.points = eachPoint(points);
  const int count = points.numPoints(), first = model.dofs.addNodes(count, contactForce());
  for (int p = 0; p < count; ++p) result.multipliers.push_back(first + p);
  result.functions.assign(count, 1.0);
  return result;
}

PointSet withParameter(FeModel& model, const PointSet& points, const Field& field) {
  PointSet result = eachPoint(points);
  Interpolation own;
  own.field = field.name;
  own.components = own.nodesPerEntity = own.shapeComponents = 1;
  const int count = points.numPoints(), first = model.dofs.addNodes(count, field);
  for (int p = 0; p < count; ++p) own.nodes.push_back(first + p);
  own.shape.assign(count, 1.0);
  result.more.push_back(std::move(own));
  return result;
}

std::vector<int> cornersOf(const PointSet& faces) {
  const int N = faces.nodesPerEntity, M = numCorners(facesOf(faces).second);
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
  const auto [face, cornerFace] = facesOf(faces);
  const std::vector<double> reference = referenceNodes(face);
  const int dim = isLine(face) ? 1 : 2, own = static_cast<int>(reference.size()) / dim,
            M = numCorners(cornerFace);
  UnilateralPoints result;
  result.conditions = M;
  result.points = faces;
  const std::vector<int> corners = cornersOf(faces);
  std::map<int, int> multiplierAt;  // corner node -> node of its multiplier
  for (const int corner : corners) multiplierAt[corner] = model.dofs.addNodes(1, contactForce());
  std::vector<double> places;  // reference coordinates of all points
  for (int e = 0; e < faces.numEntities; ++e) {
    for (int m = 0; m < M; ++m)
      result.multipliers.push_back(multiplierAt.at(faces.nodes[static_cast<std::size_t>(e) * N + m]));
    for (int q = 0; q < Q; ++q) {
      const double* shape = &faces.shape[(static_cast<std::size_t>(e) * Q + q) * N];
      // The shape functions reproduce the reference coordinates.
      for (int i = 0; i < dim; ++i) {
        double x = 0;
        for (int n = 0; n < own; ++n) x += shape[n] * reference[dim * n + i];
        places.push_back(x);
      }
    }
  }
  result.functions = tabulateFaceAt(cornerFace, places).values;
  return result;
}

}  // namespace atrapos::fem
