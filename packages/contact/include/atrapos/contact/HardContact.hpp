#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "atrapos/contact/ContactLaw.hpp"
#include "atrapos/fem/UnilateralTerm.hpp"

namespace atrapos::contact {

/// Hard frictionless contact of a material point with a rigid tool, as a law of fem::UnilateralTerm: the gap
/// h
/// >= 0, and the force along n that keeps it so (docs/theory/contact.md, Hard contact).
///
/// in:  current position x = X + u, multiplier r (a length), with a tool that moves also the load factor.
/// out: -r n, h.
template <class Tool>
struct HardContactLaw {
  static_assert(
      detail::ToolData<Tool>::value == 0,
      "hard contact is for tools without data of their own: a point that leaves a patch is no event");
  static constexpr int numPlace = detail::PlaceInputs<Tool>::value;
  static constexpr int numInputs = numPlace + 1, numOutputs = 4, numData = 0;
  static constexpr bool symmetric = Tool::symmetric;

  Tool tool;

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* in, const taylor::Passive<T>*, T* out) const {
    T place[numPlace], projection[Tool::numUnknowns];
    for (int i = 0; i < 3; ++i) place[i] = in[i];
    if constexpr (numPlace == 4) place[3] = in[4];
    for (int i = 0; i < Tool::numUnknowns; ++i) projection[i] = T(0.0);
    taylor::solveImplicit<numPlace, Tool::numUnknowns>(tool, place, projection);
    for (int i = 0; i < 3; ++i) out[i] = -(in[3] * projection[1 + i]);
    out[3] = projection[0];
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

}  // namespace atrapos::contact
