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

/// Appends a face, an entity with these points. Throws std::runtime_error where it has no area.
void appendFace(const Mesh& mesh, const SideSet& set, const Tabulation& points, const SurfaceFace& face,
                PointSet& p);

/// One PointSet for each shape of faces; cubature exact to `degree`. Throws as appendFace does.
std::vector<PointSet> pointsOf(const Mesh& mesh, const SideSet& set, const std::vector<SurfaceFace>& faces,
                               int degree);

/// Throws std::runtime_error: the side is no `needed`.
[[noreturn]] void wrongSide(const Mesh& mesh, const SideSet& set, const Side& side, const char* needed);

}  // namespace atrapos::fem
