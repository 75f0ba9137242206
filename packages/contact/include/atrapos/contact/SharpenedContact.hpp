#pragma once

#include <Kokkos_Macros.hpp>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "atrapos/contact/ContactLaw.hpp"

namespace atrapos::contact {

/// Paper (15) with a regularisation that is an unknown of the path, on the way to hard contact:
///
///     R (c R + h) - eta exp(-s) (Delta - h) = 0,   c = 1/alpha
///
/// Inputs (h, s); otherwise as RegularisedPressure.
struct SharpenedPressure {
  double compliance = 0;  ///< c = 1/alpha >= 0
  double eta = 0;         ///< > 0, where s = 0

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* x, const T* y, const taylor::Passive<T>* data, T* g) const {
    using std::exp;
    g[0] = y[0] * (compliance * y[0] + x[0]) - eta * (exp(-x[1]) * (data[0] - x[0]));
  }

  KOKKOS_INLINE_FUNCTION void start(const double* x, const double* data, double* y) const {
    RegularisedPressure{compliance, eta * std::exp(-x[1])}.start(x, data, y);
  }
};

/// Contact with a tool that stands still at a load factor, while eta falls to eta exp(-s).
///
/// in: current position x (3), s. data: as ContactLaw. out: -R n.
template <class Tool>
struct SharpenedContact {
  static constexpr int placeInputs = detail::PlaceInputs<Tool>::value;
  static constexpr int numToolData = detail::ToolData<Tool>::value;
  static constexpr int numInputs = 4, numOutputs = 3, numData = 1 + numToolData;
  static constexpr bool symmetric = Tool::symmetric;

  Tool tool;
  SharpenedPressure pressure;
  double loadFactor = 0;  ///< of a tool that moves

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* in, const taylor::Passive<T>* data, T* out) const {
    T projection[Tool::numUnknowns], gap[1], R[1];
    solve(in, data, projection, gap, R);
    for (int i = 0; i < 3; ++i) out[i] = -(R[0] * projection[1 + i]);
  }

  static constexpr int numObserved = 2;
  static std::vector<std::string> observedNames() { return {"contact_gap", "contact_pressure"}; }
  KOKKOS_INLINE_FUNCTION void observe(const double* in, const double* data, double* observed) const {
    double projection[Tool::numUnknowns];
    solve(in, data, projection, observed, observed + 1);
    if constexpr (numToolData > 0) {
      if (tool.carries(data + 1) == 0) observed[0] = std::numeric_limits<double>::infinity();
    }
  }

 private:
  template <class T>
  KOKKOS_INLINE_FUNCTION void solve(const T* in, const taylor::Passive<T>* data, T* projection, T* gap,
                                    T* R) const {
    T place[4], hs[2];
    for (int i = 0; i < 3; ++i) place[i] = in[i];
    place[3] = T(loadFactor);
    for (int i = 0; i < Tool::numUnknowns; ++i) projection[i] = T(0.0);
    R[0] = T(0.0);
    if constexpr (numToolData > 0) {
      taylor::solveImplicit<placeInputs, Tool::numUnknowns, numToolData>(tool, static_cast<const T*>(place),
                                                                         data + 1, projection);
      const taylor::Passive<T> on = tool.carries(data + 1);
      gap[0] = projection[0] * on + (1.0 - on) * data[0];
    } else {
      taylor::solveImplicit<placeInputs, Tool::numUnknowns>(tool, static_cast<const T*>(place), projection);
      gap[0] = projection[0];
    }
    hs[0] = gap[0];
    hs[1] = in[3];
    taylor::solveImplicit<2, 1, 1>(pressure, static_cast<const T*>(hs), data, R);
  }
};

}  // namespace atrapos::contact
