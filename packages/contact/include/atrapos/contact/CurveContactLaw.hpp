#pragma once

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "atrapos/contact/ContactLaw.hpp"

namespace atrapos::contact {

/// Law (15) with the place t on its curve as an unknown of the problem (docs/theory/contact.md, The contact
/// curve as unknown):
///
///     h = Delta e^-t - c eta (e^t + e^-t - 2),   R = eta (e^t - 1),   c = 1/alpha
///
/// Both are entire in t, t = 0 is h = Delta, and dh/dt < 0 everywhere; c = 0 is the barrier form. Needs Delta
/// > c eta.
///
/// in:   (x, t); with a tool that moves also the load factor.
/// data: Delta, then the tool's own.
/// out:  (-R n, -R'(t) (h - h(t))), the derivatives of one potential where n = grad h. A point that is over
/// no part of the tool has h = Delta and feels no force.
template <class Tool>
struct CurveContactLaw {
  static constexpr int numPlace = detail::PlaceInputs<Tool>::value;
  static constexpr int numToolData = detail::ToolData<Tool>::value, toolData = 1;  // and where they begin
  static constexpr int numInputs = 1 + numPlace, numOutputs = 4, numData = toolData + numToolData;
  static constexpr bool symmetric = Tool::symmetric;

  Tool tool;
  RegularisedPressure pressure;

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* in, const taylor::Passive<T>* data, T* out) const {
    using std::exp;
    T projection[Tool::numUnknowns];
    project(in, data, projection);
    const T up = exp(in[3]), down = exp(-in[3]);
    const T R = pressure.eta * (up - 1.0);
    for (int i = 0; i < 3; ++i)
      if constexpr (numToolData > 0)
        out[i] = -(R * projection[1 + i]) * tool.carries(data + toolData);
      else
        out[i] = -(R * projection[1 + i]);
    const T mismatch =
        projection[0] - data[0] * down + (pressure.compliance * pressure.eta) * (up + down - 2.0);
    out[3] = -(pressure.eta * (up * mismatch));
  }

  static constexpr int numObserved = 2;
  static std::vector<std::string> observedNames() { return {"contact_gap", "contact_pressure"}; }
  KOKKOS_INLINE_FUNCTION void observe(const double* in, const double* data, double* observed) const {
    double projection[Tool::numUnknowns];
    project(in, data, projection);
    observed[0] = projection[0];
    observed[1] = pressure.eta * std::expm1(in[3]);
    if constexpr (numToolData > 0)
      if (tool.carries(data + toolData) == 0) {
        observed[0] = std::numeric_limits<double>::infinity();
        observed[1] = 0;
      }
  }

  /// The place (x), or (x, load factor), of a point with these inputs.
  template <class T>
  KOKKOS_INLINE_FUNCTION static void placeOf(const T* in, T* place) {
    for (int i = 0; i < 3; ++i) place[i] = in[i];
    if constexpr (numPlace == 4) place[3] = in[4];
  }

  void validate() const {
    tool.validate();
    pressure.validate();
  }

 private:
  template <class T>
  KOKKOS_INLINE_FUNCTION void project(const T* in, const taylor::Passive<T>* data, T* projection) const {
    T place[numPlace];
    placeOf(in, place);
    for (int i = 0; i < Tool::numUnknowns; ++i) projection[i] = T(0.0);
    if constexpr (numToolData > 0) {
      taylor::solveImplicit<numPlace, Tool::numUnknowns, numToolData>(tool, static_cast<const T*>(place),
                                                                      data + toolData, projection);
      const taylor::Passive<T> on = tool.carries(data + toolData);
      projection[0] = projection[0] * on + (1.0 - on) * data[0];
    } else {
      taylor::solveImplicit<numPlace, Tool::numUnknowns>(tool, place, projection);
    }
  }
};

}  // namespace atrapos::contact
