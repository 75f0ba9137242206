#pragma once

#include <vector>

#include "atrapos/fem/Mesh.hpp"

/// Shape functions, cubatures and sides of the reference cells: host-side set-up data, tabulated once.
/// Element loops copy a Tabulation into Kokkos views; nothing here is meant to be called inside a loop.
///
/// Reference domains: hexahedra and quadrilaterals [-1,1]^dim; tetrahedra and triangles the unit simplex
/// (xi, eta, zeta >= 0, sum <= 1); wedges the unit triangle times [-1,1]; shells, as their middle surface,
/// the quadrilateral's [-1,1]^2; lines [-1,1]. Node and side order are those of Exodus II. Every function
/// that tabulates needs Kokkos to be initialised (Intrepid2 allocates views) and throws std::logic_error
/// where it is not.
namespace atrapos::fem {

/// Shape of a side of a cell, with its node count. Lines are the edges of shells and plane cells.
enum class Face { Tri3, Tri6, Quad4, Quad8, Quad9, Line2, Line3 };

/// Whether a side is an edge.
bool isLine(Face face);
/// Ends of an edge, corners of a triangle or quadrilateral: the first nodes of its own.
int numCorners(Face face);

/// Shape functions of one cell or face at a set of reference points.
struct Tabulation {
  int numNodes = 0;
  int numPoints = 0;
  int dim = 0;  ///< of the reference domain: solids 3, shells, plane cells and faces 2, edges and bars 1
  std::vector<double> points;     ///< [point][dim] reference coordinates
  std::vector<double> weights;    ///< [point], sum = volume (area) of the reference domain; empty where the
                                  ///< points are the caller's own
  std::vector<double> values;     ///< [point][node]
  std::vector<double> gradients;  ///< [point][node][dim] derivatives by the reference coordinates
};

/// The cell with its default cubature, the one that stiffness and internal forces use:
///
/// | cell    | points    | why |
/// |---------|-----------|-----|
/// | Hex8    | 2 x 2 x 2 | full |
/// | Hex20   | 2 x 2 x 2 | reduced; one cell alone has 6 zero-energy modes beside the rigid ones |
/// | Hex27   | 3 x 3 x 3 | full |
/// | Tet4    | 1         | full: the strain is constant |
/// | Tet10   | 4         | full: the strain is linear, the tangent of a straight-sided cell quadratic |
/// | Wedge6  | 3 x 2     | full |
/// | Wedge15 | 3 x 3     | reduced in the triangle, but of full rank (6 points would not be) |
/// | Shell4  | 2 x 2     | of the middle surface; the points through the thickness are the element's |
/// | Shell3  | 3         | the same |
/// | Shell6  | 3         | the same, of full rank |
/// | Shell8  | 2 x 2     | the same, reduced |
/// | Shell9  | 3 x 3     | the same, full |
/// | Quad4   | 2 x 2     | full |
/// | Quad8   | 2 x 2     | reduced; one cell alone has one zero-energy mode beside the rigid ones |
/// | Quad9   | 3 x 3     | full |
/// | Tri3    | 1         | full: the strain is constant |
/// | Tri6    | 3         | full: the strain is linear |
/// | Bar2    | 1         | full: the strain is constant |
/// | Bar3    | 2         | full: the strain is linear |
///
/// A straight row of Hex20, one cell wide and one cell thick, keeps one such mode per cell even when clamped:
/// use tabulate(Topology::Hex20, 5), 3 x 3 x 3 points, there. See docs/theory/elements.md. "Full" is meant
/// for an undistorted cell of a homogeneous linear material.
Tabulation tabulate(Topology topology);

/// The cell with a cubature of positive weights that is exact at least for all polynomials of this total
/// degree on the reference domain. Throws std::invalid_argument where there is none: the degree must be
/// within 0 to 20, on tetrahedra 0 to 6.
Tabulation tabulate(Topology topology, int degree);

/// The cell at given reference points, [point][dim]; no weights. Throws
/// std::invalid_argument where the size is not a multiple of the dimension. Points outside the cell are
/// allowed (the polynomials continue there).
Tabulation tabulateAt(Topology topology, const std::vector<double>& points);

/// A face in its own two reference coordinates (an edge in its one), with a cubature as in tabulate(topology,
/// degree).
Tabulation tabulateFace(Face face, int degree);

/// A face at given points, [point][2] (an edge: [point][1]) in its own reference coordinates; no weights.
Tabulation tabulateFaceAt(Face face, const std::vector<double>& points);

/// Reference coordinates of the nodes, [node][dim].
std::vector<double> referenceNodes(Topology topology);
std::vector<double> referenceNodes(Face face);

/// Number of sides of a cell; bars have none.
int numSides(Topology topology);

/// Shape of a side, 0 <= side < numSides; throws std::out_of_range for another number.
Face sideFace(Topology topology, int side);

/// The cell's local nodes on a side, 0-based, in the order that sideFace's shape functions expect; seen from
/// outside they run counter-clockwise, so that x_xi cross x_eta points out of the cell. The two faces of a
/// shell have the nodes of its middle surface, in opposite order; its edges run as the top face does, those
/// of plane cells counter-clockwise. Throws std::out_of_range for a number that is no side.
std::vector<int> sideNodes(Topology topology, int side);

/// Matrix [node][point] that carries values at the cubature points to nodal values (smoothed nodal stresses):
/// the weighted least-squares fit in the shape functions of the cell's vertices (trilinear for hexahedra,
/// bilinear for quadrilaterals, linear for tetrahedra and triangles, linear times linear for wedges),
/// evaluated at all nodes. Exact for linear fields; a single point gives its value to every node. Throws
/// std::invalid_argument where the tabulation has no weights, is not of this cell, or has points that
/// determine no such fit (more than one, but too few or badly placed).
std::vector<double> extrapolation(Topology topology, const Tabulation& tabulation);

}  // namespace atrapos::fem
