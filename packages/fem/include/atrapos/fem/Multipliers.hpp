#pragma once

#include "atrapos/fem/FeModel.hpp"
#include "atrapos/fem/PointSet.hpp"

namespace atrapos::fem {

/// Every point as an entity of its own: the nodes of its entity. Throws std::logic_error for points without
/// shape values.
PointSet eachPoint(const PointSet& points);

/// Points of faces with one-sided conditions on weighted means over them.
struct UnilateralPoints {
  PointSet points;
  int conditions = 1;            ///< of an entity
  std::vector<int> multipliers;  ///< [entity][condition] node of its multiplier
  /// [entity][point][condition] psi >= 0. Entities that share a multiplier's node share the condition.
  std::vector<double> functions;
};

/// Most conditions of an entity.
constexpr int kMaxConditions = 4;

/// Gives the model a multiplier (Role::oneSided) for every point, with the condition of that point alone.
UnilateralPoints withMultipliers(FeModel& model, const PointSet& points);

/// Gives the model a multiplier for every corner of these faces, and the faces' points the linear (lines,
/// triangles) or bilinear (quadrilaterals) functions of their corners. Faces of shells at a distance from the
/// middle surface have their directors behind their nodes (shellFacePoints). Throws std::logic_error for
/// points that are not those of faces.
UnilateralPoints withCornerMultipliers(FeModel& model, const PointSet& faces);

/// The corner nodes of these faces in the order of their multipliers: as the faces come to them.
std::vector<int> cornersOf(const PointSet& faces);

/// Every point as an entity of its own (eachPoint) with one unknown more, a scalar of this field at a node of
/// its own: the last input of a law.
PointSet withParameter(FeModel& model, const PointSet& points, const Field& field);

}  // namespace atrapos::fem
