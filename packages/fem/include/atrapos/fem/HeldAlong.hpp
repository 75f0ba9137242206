#pragma once

#include <array>
#include <vector>

#include "atrapos/fem/Coupling.hpp"
#include "atrapos/fem/FeModel.hpp"

/// Supports along directions that are no axes: planes of symmetry of any orientation, inclined slides
/// (docs/theory/couplings.md, "Held along a direction").
namespace atrapos::fem {

/// direction . u = value + lambda perLoadFactor for the first field of a node, a vector.
struct HeldAlong {
  int node = 0;
  std::array<double, 3> direction{};  ///< of any length but 0; value is along its unit vector
  double value = 0, perLoadFactor = 0;
};

/// Force along the direction with which a condition holds its node, the body's part: a sum over
/// FeProblem::slaveForces. Empty where other supports hold the node in that direction already.
using ForceAlong = std::vector<CoupledDof>;

/// Couples the components of these nodes; other supports must be in the model. The force along each
/// condition, in their order. Throws std::invalid_argument for directions without a finite length, and where
/// a node is held twice along a direction with different values.
std::vector<ForceAlong> holdAlong(FeModel& model, const std::vector<HeldAlong>& conditions);

}  // namespace atrapos::fem
