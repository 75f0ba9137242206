#pragma once

#include <cstddef>

#include "atrapos/fem/FeModel.hpp"
#include "atrapos/fem/PointSet.hpp"

namespace atrapos::fem {

/// New nodes of a multiplier's field in a model, one for each of the entities that have one point, as inputs
/// of a law there.
inline Interpolation newMultipliers(FeModel& model, const Field& field, int entities) {
  Interpolation mu;
  mu.field = field.name;
  mu.components = field.numComponents();
  mu.nodesPerEntity = mu.shapeComponents = 1;
  const int first = model.dofs.addNodes(entities, field);
  for (int e = 0; e < entities; ++e) mu.nodes.push_back(first + e);
  mu.shape.assign(static_cast<std::size_t>(entities), 1.0);
  return mu;
}

}  // namespace atrapos::fem
