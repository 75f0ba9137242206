#pragma once

#include <memory>
#include <vector>

#include "atrapos/fem/PointLaw.hpp"
#include "atrapos/fem/PointSet.hpp"
#include "atrapos/fem/ZoneTerm.hpp"

/// Bodies whose displacements are those of a plane (docs/theory/solid.md, "Plane bodies").
namespace atrapos::solid {

/// A plane mesh (x, y) as a body.
struct PlaneSection {
  enum class Kind {
    strain,       ///< of a thickness that stays
    stress,       ///< sigma_zz = 0
    axisymmetric  ///< about the y axis, x the radius; forces are those of the whole body
  };
  Kind kind = Kind::strain;
  double thickness = 1;  ///< length, > 0; no part in axisymmetry
};

/// Points of a block of plane cells for planeLaw: displacement gradients with respect to the reference
/// configuration, in axisymmetry with u_r/r and u_z/r behind those of u_r and u_z.
/// Throws std::runtime_error naming the element where the Jacobian, or a radius, is not positive, and for
/// other cells.
fem::PointSet planePoints(const fem::Mesh& mesh, const fem::Block& block, const fem::Tabulation& cell,
                          const PlaneSection& section);

/// The same with shape values (body forces).
fem::PointSet planeValuePoints(const fem::Mesh& mesh, const fem::Block& block, const fem::Tabulation& cell,
                               const PlaneSection& section);

/// The edges of a side set with shape values, one PointSet for each shape; cubature exact to `degree`.
/// Weights are areas, normals point outwards. Throws std::runtime_error for sides of other cells and edges
/// without length.
std::vector<fem::PointSet> planeEdgePoints(const fem::Mesh& mesh, const fem::SideSet& set,
                                           const PlaneSection& section, int degree);

/// The same edges as lines; `shown`: the points of that cubature.
std::vector<fem::LineSet> planeEdgeLines(const fem::Mesh& mesh, const fem::SideSet& set,
                                         const PlaneSection& section, int degree);

/// A material of solids (H to P, 9 each; what comes behind them, in and out, stays, a load factor too) at
/// planePoints.
/// `across`: one of those behind that vanishes in the plane, a gradient's along z; -1: none.
std::unique_ptr<fem::PointLaw> planeLaw(std::unique_ptr<fem::PointLaw> material, PlaneSection::Kind kind,
                                        int across = -1);

}  // namespace atrapos::solid
