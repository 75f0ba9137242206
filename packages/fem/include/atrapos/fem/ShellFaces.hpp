#pragma once

#include <array>
#include <vector>

#include "atrapos/fem/Mesh.hpp"
#include "atrapos/fem/PointSet.hpp"
#include "atrapos/fem/ShellGeometry.hpp"

/// Points on the faces, at the nodes and along the edges of shells, for laws and loads that act there.
namespace atrapos::fem {

/// Points at X = R + zeta D on the shells of a side set (zeta = 1: top face, 0: middle, -1: bottom), one
/// PointSet for each face shape; cubature exact to `degree` on a plane face. An entity has the N nodes of v
/// and the N of w, with shape values {N_a, zeta s_a N_a}; weights and unit normals are those of the surface
/// at zeta, the normal to the outer side of the set's sides (side 1: along the director, side 2: against it).
/// With zeta = 0 an entity has the nodes of v only.
///
/// Throws std::runtime_error naming the side set and element where a side is no face of a shell.
std::vector<PointSet> shellFacePoints(const Mesh& mesh, const ShellGeometry& shells, const SideSet& set,
                                      double zeta, int degree);

/// One point X = R + zeta D at each node of a list, weight 1, with the nodes {v, w} and the shape values {1,
/// zeta}.
///
/// Throws std::runtime_error naming the node where no shell is, or more than one director (a fold).
PointSet shellNodePoints(const Mesh& mesh, const ShellGeometry& shells, const std::vector<int>& nodes,
                         double zeta);

/// Points along the edges of shells in a side set, on the middle surface: shape values of v, weights a
/// length, `normals` the unit normals of the edge that are tangent to the surface and point out of the
/// element. One PointSet for each edge shape; cubature exact to `degree` on a straight edge.
///
/// Throws std::runtime_error naming the side set and element where a side is no edge of a shell.
std::vector<PointSet> shellEdgePoints(const Mesh& mesh, const SideSet& set, int degree);

/// Dead force per reference length along the edges of shells in a side set; adds to `force`, [3 node +
/// component].
void addEdgeForce(const Mesh& mesh, const SideSet& set, const std::array<double, 3>& perLength,
                  std::vector<double>& force);

/// Reference length of the edges of shells in a side set.
double edgeLength(const Mesh& mesh, const SideSet& set);

}  // namespace atrapos::fem
