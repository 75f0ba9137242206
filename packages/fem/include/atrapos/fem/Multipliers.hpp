#pragma once

#include "atrapos/fem/FeProblem.hpp"
#include "atrapos/fem/PointSet.hpp"

namespace atrapos::fem {

/// Gives the model one more node for every point, which carries a multiplier as its first unknown (the other
/// two are held at zero), and returns the points as entities of their own: the nodes of the point, then that
/// of its multiplier with a shape of 0.
PointSet withMultipliers(FeModel& model, const PointSet& points);

/// Points of faces with one-sided conditions on weighted means over them.
struct UnilateralPoints {
  PointSet points;     ///< the last nodes of every entity are those of the multipliers, with a shape of 0
  int conditions = 1;  ///< of an entity
  /// [entity][point][condition] psi >= 0. Entities that share a multiplier's node share the condition.
  std::vector<double> functions;
};

/// Most conditions of an entity.
constexpr int kMaxConditions = 4;

/// Gives the model one more node for every corner of these faces (withMultipliers: for every point), and the
/// faces' points the linear (triangles) or bilinear (quadrilaterals) functions of their corners. Faces of
/// shells at a distance from the middle surface have their directors behind their nodes (shellFacePoints).
/// Throws std::logic_error for points that are not those of faces.
UnilateralPoints withCornerMultipliers(FeModel& model, const PointSet& faces);

/// The corner nodes of these faces in the order of their multipliers: as the faces come to them.
std::vector<int> cornersOf(const PointSet& faces);

/// Points of withMultipliers with two shape components: the inputs of a law are (u_x, y_x, u_y, y_y, u_z,
/// y_z), displacement at the point and dofs of its multiplier's node.
PointSet withUnknowns(PointSet points);

}  // namespace atrapos::fem
