#pragma once

#include <functional>
#include <vector>

#include "atrapos/fem/Mesh.hpp"
#include "atrapos/fem/PointSet.hpp"
#include "atrapos/fem/ShellGeometry.hpp"

namespace atrapos::fem {

/// Lines on the surface of a body: the edges of plane cells, or lines across the faces of cells and shells.
/// x(xi) = sum over nodes of x_n N_n(xi), xi in [-1, 1], N_n a polynomial; its coefficients are [k][3].
struct LineSet {
  int degree = 1;      ///< 1 or 2: of x in xi
  int components = 3;  ///< of the displacement: 2 in a plane
  int nodesPerLine = 0;
  std::vector<int> nodes;            ///< [line][node]
  std::vector<double> shape;         ///< [line][node][k] of N_n
  std::vector<double> coefficients;  ///< [line][k][3] of the undeformed place
  /// [line][k][3] of A(xi): what the line stands for has the area |dX/dxi x A| dxi in the undeformed body. In
  /// a plane A is the depth along z, on a face dX/deta times the weight of the line.
  std::vector<double> across;
  std::vector<int> ends;         ///< [line][2] numbers from 0: lines that go on in each other share an end
  std::vector<int> endNodes;     ///< [end] the node there, or next to it
  std::vector<int> middleNodes;  ///< [line] the same
  std::vector<double> shown;     ///< [point] xi where gaps and pressures are shown, ascending
  std::vector<double> weights;   ///< [line][point] of these points: area

  int numLines() const { return static_cast<int>(middleNodes.size()); }
  int numEnds() const { return static_cast<int>(endNodes.size()); }
};

/// Lines across faces, and the points at which they show gaps and pressures: [face][line, point].
struct FaceLines {
  LineSet lines;
  PointSet points;
};

/// Lines across the faces of a side set, one FaceLines for each shape: at the points of Gauss' rule that is
/// exact to `degree` in one direction of a face, along the other. On quadrilaterals that is, of the two
/// directions that go through a whole set of faces which hang together, the one in which `gap`, of places (3)
/// of the undeformed body, changes more; on each triangle the edge, of three, along which it changes most.
/// Lines of faces that share an edge and both cross it go on in each other. Shells: shellFacePoints says
/// where.
///
/// Throws std::runtime_error for faces without area.
std::vector<FaceLines> faceLines(const Mesh& mesh, const ShellGeometry& shells, const SideSet& set,
                                 double zeta, int degree, const std::function<double(const double*)>& gap);

}  // namespace atrapos::fem
