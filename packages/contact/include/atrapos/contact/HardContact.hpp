#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "atrapos/contact/ContactLaw.hpp"
#include "atrapos/contact/PatchSearch.hpp"
#include "atrapos/fem/UnilateralTerm.hpp"

namespace atrapos::contact {

/// Hard frictionless contact of a material point with a rigid tool, as a law of fem::UnilateralTerm: the gap
/// h >= 0, and the force along n that keeps it so (docs/theory/contact.md, Hard contact).
///
/// in:   current position x = X + u, multiplier r (a length), with a tool that moves also the load factor.
/// data: the tool's own.
/// out:  -r n, h; zeros for a point that is over no part of the tool.
template <class Tool>
struct HardContactLaw {
  static constexpr int numPlace = detail::PlaceInputs<Tool>::value;
  static constexpr int numInputs = numPlace + 1, numOutputs = 4, numData = detail::ToolData<Tool>::value;
  static constexpr bool symmetric = Tool::symmetric;

  Tool tool;

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* in, const taylor::Passive<T>* data, T* out) const {
    T place[numPlace], projection[Tool::numUnknowns];
    for (int i = 0; i < 3; ++i) place[i] = in[i];
    if constexpr (numPlace == 4) place[3] = in[4];
    for (int i = 0; i < Tool::numUnknowns; ++i) projection[i] = T(0.0);
    if constexpr (numData > 0) {
      taylor::solveImplicit<numPlace, Tool::numUnknowns, numData>(tool, static_cast<const T*>(place), data,
                                                                  projection);
      const taylor::Passive<T> on = tool.carries(data);
      for (int i = 0; i < 3; ++i) out[i] = -(in[3] * projection[1 + i]) * on;
      out[3] = projection[0] * on;
    } else {
      taylor::solveImplicit<numPlace, Tool::numUnknowns>(tool, place, projection);
      for (int i = 0; i < 3; ++i) out[i] = -(in[3] * projection[1 + i]);
      out[3] = projection[0];
    }
  }

  KOKKOS_INLINE_FUNCTION bool exists(const double* data) const {
    if constexpr (numData > 0)
      return tool.carries(data) != 0;
    else
      return true;
  }

  static std::vector<std::string> observedNames() { return {"contact_gap", "contact_pressure"}; }

  void validate() const { tool.validate(); }
};

/// Adds hard contact of these points with a tool to a model: a multiplier each, and the term. The term is the
/// model's last. Points of weight 1 show forces, others pressures.
template <class Tool>
void addHardContact(fem::FeModel& model, const fem::PointSet& points, const Tool& tool) {
  tool.validate();
  using Law = HardContactLaw<Tool>;
  const fem::PointSet own = fem::withMultipliers(model, points);
  model.terms.push_back(std::make_unique<fem::UnilateralTerm<Law>>(Law{tool}, own));
}

/// Adds hard contact of faces with a tool: the mean gap around every corner, weighted by its (bi)linear
/// function, is >= 0, and the pressure is interpolated between the corners. The term is the model's last.
template <class Tool>
void addHardFaceContact(fem::FeModel& model, const fem::PointSet& faces, const Tool& tool) {
  tool.validate();
  using Law = HardContactLaw<Tool>;
  const fem::UnilateralPoints own = fem::withCornerMultipliers(model, faces);
  model.terms.push_back(std::make_unique<fem::UnilateralTerm<Law>>(Law{tool}, own));
}

/// Hard contact of points with a set of patches, at rest (PatchTool) or moving (MovingTool<PatchTool>).
template <class Tool>
void addHardContact(fem::FeModel& model, const fem::PointSet& points, const PatchSearch<Tool>& search) {
  search.tool.validate();
  using Law = HardContactLaw<Tool>;
  const fem::PointSet own = fem::withMultipliers(model, points);
  model.terms.push_back(std::make_unique<fem::UnilateralTerm<Law>>(
      Law{search.tool}, own, search.overNothing(own.numPoints()), search.pieces(0)));
}

/// The same of faces: the mean gap around a corner is that of the points that are over a patch.
template <class Tool>
void addHardFaceContact(fem::FeModel& model, const fem::PointSet& faces, const PatchSearch<Tool>& search) {
  search.tool.validate();
  using Law = HardContactLaw<Tool>;
  const fem::UnilateralPoints own = fem::withCornerMultipliers(model, faces);
  model.terms.push_back(std::make_unique<fem::UnilateralTerm<Law>>(
      Law{search.tool}, own, search.overNothing(own.points.numPoints()), search.pieces(0)));
}

}  // namespace atrapos::contact
