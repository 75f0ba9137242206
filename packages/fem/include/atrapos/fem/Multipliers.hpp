#pragma once

#include "atrapos/fem/FeProblem.hpp"
#include "atrapos/fem/PointSet.hpp"

namespace atrapos::fem {

/// Gives the model one more node for every point, which carries a multiplier as its first unknown (the other
/// two are held at zero), and returns the points as entities of their own: the nodes of the point, then that
/// of its multiplier with a shape of 0.
PointSet withMultipliers(FeModel& model, const PointSet& points);

/// Law input (u_x, y_x, u_y, y_y, u_z, y_z): displacement at the point and the dofs of its multiplier's node.
struct DisplacementAndUnknown {
  static constexpr int components = 2;
  static constexpr int numInputs = 6;
};

/// Points of withMultipliers with the shape components of DisplacementAndUnknown.
PointSet withUnknowns(PointSet points);

}  // namespace atrapos::fem
