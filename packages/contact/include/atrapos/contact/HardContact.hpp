#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "atrapos/contact/HardContactLaw.hpp"
#include "atrapos/contact/PatchSearch.hpp"
#include "atrapos/fem/PointLawOf.hpp"
#include "atrapos/fem/UnilateralTerm.hpp"

namespace atrapos::contact {

/// Adds hard contact of these points with a tool to a model: a multiplier each, and the term. The term is the
/// model's last. Points of weight 1 show forces, others pressures.
template <class Tool>
void addHardContact(fem::FeModel& model, const fem::PointSet& points, const Tool& tool) {
  tool.validate();
  using Law = HardContactLaw<Tool>;
  const fem::UnilateralPoints own = fem::withMultipliers(model, points);
  model.terms.push_back(fem::unilateralTerm(fem::pointLaw(Law{tool}), own));
}

/// Adds hard contact of faces with a tool: the mean gap around every corner, weighted by its (bi)linear
/// function, is >= 0, and the pressure is interpolated between the corners. The term is the model's last.
template <class Tool>
void addHardFaceContact(fem::FeModel& model, const fem::PointSet& faces, const Tool& tool) {
  tool.validate();
  using Law = HardContactLaw<Tool>;
  const fem::UnilateralPoints own = fem::withCornerMultipliers(model, faces);
  model.terms.push_back(fem::unilateralTerm(fem::pointLaw(Law{tool}), own));
}

/// Hard contact of points with a set of patches, at rest (PatchTool) or moving (MovingTool<PatchTool>).
template <class Tool>
void addHardContact(fem::FeModel& model, const fem::PointSet& points, const PatchSearch<Tool>& search) {
  search.tool.validate();
  using Law = HardContactLaw<Tool>;
  const fem::UnilateralPoints own = fem::withMultipliers(model, points);
  model.terms.push_back(fem::unilateralTerm(fem::pointLaw(Law{search.tool}), own,
                                            search.overNothing(own.points.numPoints()), search.pieces(0)));
}

/// The same of faces: the mean gap around a corner is that of the points that are over a patch.
template <class Tool>
void addHardFaceContact(fem::FeModel& model, const fem::PointSet& faces, const PatchSearch<Tool>& search) {
  search.tool.validate();
  using Law = HardContactLaw<Tool>;
  const fem::UnilateralPoints own = fem::withCornerMultipliers(model, faces);
  model.terms.push_back(fem::unilateralTerm(fem::pointLaw(Law{search.tool}), own,
                                            search.overNothing(own.points.numPoints()), search.pieces(0)));
}

}  // namespace atrapos::contact
