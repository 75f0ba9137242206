#pragma once

#include <string>
#include <vector>

#include "atrapos/contact/ContactLaw.hpp"

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

}  // namespace atrapos::contact
