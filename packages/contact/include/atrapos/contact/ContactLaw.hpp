#pragma once

#include <limits>
#include <string>
#include <type_traits>
#include <vector>

#include "atrapos/contact/RegularisedPressure.hpp"
#include "atrapos/contact/Tools.hpp"
#include "atrapos/taylor/Law.hpp"

namespace atrapos::contact {

namespace detail {
/// Passive data of the tool at one point (Tool::numToolData; none where the tool does not say so).
template <class Tool, class = void>
struct ToolData : std::integral_constant<int, 0> {};
template <class Tool>
struct ToolData<Tool, std::void_t<decltype(Tool::numToolData)>>
    : std::integral_constant<int, Tool::numToolData> {};

/// Inputs of the tool: the place (3), or place and load factor (Tool::numPlaceInputs = 4).
template <class Tool, class = void>
struct PlaceInputs : std::integral_constant<int, 3> {};
template <class Tool>
struct PlaceInputs<Tool, std::void_t<decltype(Tool::numPlaceInputs)>>
    : std::integral_constant<int, Tool::numPlaceInputs> {};
}  // namespace detail

/// Frictionless contact of a material point with a rigid tool, paper (14), (15) and (25): projection and
/// pressure are local unknowns, condensed at the point.
///
/// in:   current position x = X + u; with a tool that moves also the load factor, in[3].
/// data: reference gap Delta > 0 of the point, then the tool's own data.
/// out:  -R n, the work conjugate of x (the tool pushes the body with +R n).
///
/// Pressure: a law R(h), one struct like RegularisedPressure: templated operator()(x = (h), y = (R), data =
/// (Delta), g) with g = 0 the law, start(x, data, y), validate(); R = 0 at h = Delta.
template <class Tool, class Pressure = RegularisedPressure>
struct ContactLaw {
  static constexpr int numToolData = detail::ToolData<Tool>::value;
  static constexpr int numInputs = detail::PlaceInputs<Tool>::value, numOutputs = 3;
  static constexpr int numData = 1 + numToolData;
  static constexpr bool symmetric = Tool::symmetric;

  Tool tool;
  Pressure pressure;

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* x, const taylor::Passive<T>* data, T* out) const {
    T projection[Tool::numUnknowns], gap[1], R[1];
    solve(x, data, projection, gap, R);
    for (int i = 0; i < 3; ++i) out[i] = -(R[0] * projection[1 + i]);
  }

  static constexpr int numObserved = 2;
  static std::vector<std::string> observedNames() { return {"contact_gap", "contact_pressure"}; }
  KOKKOS_INLINE_FUNCTION void observe(const double* x, const double* data, double* observed) const {
    double projection[Tool::numUnknowns];
    solve(x, data, projection, observed, observed + 1);
    if constexpr (numToolData > 0) {
      if (tool.carries(data + 1) == 0) observed[0] = std::numeric_limits<double>::infinity();
    }
  }

  template <class T>
  KOKKOS_INLINE_FUNCTION void solve(const T* x, const taylor::Passive<T>* data, T* projection, T* gap,
                                    T* R) const {
    for (int i = 0; i < Tool::numUnknowns; ++i) projection[i] = T(0.0);  // Newton's start is the tool's own
    R[0] = T(0.0);
    if constexpr (numToolData > 0) {
      taylor::solveImplicit<numInputs, Tool::numUnknowns, numToolData>(tool, x, data + 1, projection);
      // A point that is over no part of the tool is held at h = Delta, where R = 0 at all orders.
      const taylor::Passive<T> on = tool.carries(data + 1);
      gap[0] = projection[0] * on + (1.0 - on) * data[0];
    } else {
      taylor::solveImplicit<numInputs, Tool::numUnknowns>(tool, x, projection);
      gap[0] = projection[0];
    }
    taylor::solveImplicit<1, 1, 1>(pressure, gap, data, R);
  }

  void validate() const {
    tool.validate();
    pressure.validate();
  }
};

}  // namespace atrapos::contact
