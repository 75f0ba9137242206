#pragma once

#include <string>
#include <vector>

#include "atrapos/fem/DofMap.hpp"
#include "atrapos/fem/Mesh.hpp"
#include "atrapos/fem/ReferenceCell.hpp"

namespace atrapos::fem {

/// A linear map from the unknowns of a field at the nodes of entities to inputs of a law at their points: the
/// sums over nodes of u_i N_c, [i][c], i the component of the field, c that of the shape functions.
struct Interpolation {
  /// Which field of the nodes; empty: the first one that each of them has (at nodes of a mesh the
  /// displacement, at those of directors their change).
  std::string field;
  int components = 3;  ///< of the field
  int nodesPerEntity = 0;
  int shapeComponents = 0;    ///< gradients dN/dX: the dimension of the cell; values N: 1
  std::vector<int> nodes;     ///< [entity][node]
  std::vector<double> shape;  ///< [entity][point][node][component]; with `maps` [point][node][direction]
  /// Of gradients whose cells differ by their maps alone: dxi_d/dX_i, [entity][point][d][i]; `shape` has
  /// dN/dxi_d then, once for all entities. Empty: `shape` is all.
  std::vector<double> maps;

  int inputs() const { return components * shapeComponents; }  ///< of the law, at a point
};

/// The points at which a law acts, and the linear maps between dofs and its inputs: what an element loop
/// needs to know of a mesh. An entity is an element, a face or a single node.
struct PointSet : Interpolation {
  int numEntities = 0;
  int pointsPerEntity = 0;
  /// Whether one shape function a node is its value, so that inputs of displacements are places X + u; else
  /// it is a derivative.
  bool ofPlaces = true;
  /// [entity][point] cubature weight times Jacobian (volume, area; 1 at a node)
  std::vector<double> weights;
  std::vector<double> positions;  ///< [entity][point][3] in the reference configuration
  std::vector<double> normals;    ///< faces only: outward unit normals [entity][point][3]
  /// Further fields at the same points, whose inputs come after those of the first.
  std::vector<Interpolation> more;

  int numPoints() const { return numEntities * pointsPerEntity; }
  /// Inputs of a law from all fields.
  int allInputs() const;
  /// A component of a node's shape function; points are counted over all entities.
  double shapeAt(std::size_t point, int node, int component) const;
};

/// Volume points of one block: gradients with respect to the reference configuration.
/// Throws std::runtime_error naming the element where the Jacobian is not positive, and for shells.
PointSet volumePoints(const Mesh& mesh, const Block& block, const Tabulation& cell);

/// Volume points of one block with shape *values* (body forces).
PointSet volumeValuePoints(const Mesh& mesh, const Block& block, const Tabulation& cell);

/// A further field at the same points, by shape functions that are tabulated there (tabulateAt): those of the
/// first nodes of every entity, all of them or the corners. Its values,
Interpolation valuesOf(const Field& field, const PointSet& points, const Tabulation& shape);
/// and its gradients with respect to the reference configuration. Throws std::logic_error for points without
/// maps.
Interpolation gradientsOf(const Field& field, const PointSet& points, const Tabulation& shape);

/// Face points of a side set, one PointSet for each face shape in it; cubature exact to `degree`. The faces
/// of a shell are taken on its middle surface. Throws std::runtime_error for edges of shells and faces
/// without area.
std::vector<PointSet> facePoints(const Mesh& mesh, const SideSet& set, int degree);

/// One point at each node of a list, weight 1.
PointSet nodePoints(const Mesh& mesh, const std::vector<int>& nodes);

/// The distinct nodes of a side set, ascending.
std::vector<int> nodesOf(const Mesh& mesh, const SideSet& set);

/// The block that holds an element counted over all blocks, and the element's position in it.
struct ElementAddress {
  int block = 0, element = 0;
};
ElementAddress addressOf(const Mesh& mesh, int element);

}  // namespace atrapos::fem
