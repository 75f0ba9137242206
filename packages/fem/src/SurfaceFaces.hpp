#pragma once

#include <vector>

#include "Vec3.hpp"
#include "atrapos/fem/Mesh.hpp"
#include "atrapos/fem/PointSet.hpp"
#include "atrapos/fem/ReferenceCell.hpp"
#include "atrapos/fem/ShellGeometry.hpp"

namespace atrapos::fem {

/// A side of a side set as a surface: places are sums of N_a `places`, displacements of N_a `factors` times
/// those of the nodes.
struct SurfaceFace {
  Side side;
  Face face;
  std::vector<int> nodes;       ///< those of N_a; on a shell off its middle surface its directors behind them
  std::vector<double> factors;  ///< [node]
  std::vector<Vec3> places;     ///< [a] in the undeformed body
};

/// Faces of solids and, at zeta, of shells. Throws std::runtime_error for edges and, where zeta is not 0,
/// faces of solids.
std::vector<SurfaceFace> surfaceFaces(const Mesh& mesh, const ShellGeometry& shells, const SideSet& set,
                                      double zeta);

/// Appends a face, an entity with these points.
void appendFace(const Tabulation& points, const SurfaceFace& face, PointSet& p);

}  // namespace atrapos::fem
