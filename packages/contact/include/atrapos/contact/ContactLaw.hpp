#pragma once

#include <string>
#include <vector>

#include "atrapos/contact/RegularisedPressure.hpp"
#include "atrapos/contact/Tools.hpp"
#include "atrapos/taylor/Law.hpp"

namespace atrapos::contact {

/// Frictionless contact of a material point with a rigid tool, paper (14), (15) and (25): projection and
/// pressure are local unknowns, condensed at the point.
///
/// in:   current position x = X + u.
/// data: reference gap Delta > 0 of the point.
/// out:  -R n, the work conjugate of x (the tool pushes the body with +R n).
template <class Tool>
struct ContactLaw {
  static constexpr int numInputs = 3, numOutputs = 3, numData = 1;
  static constexpr bool symmetric = Tool::symmetric;

  Tool tool;
  RegularisedPressure pressure;

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
  }

  template <class T>
  KOKKOS_INLINE_FUNCTION void solve(const T* x, const taylor::Passive<T>* data, T* projection, T* gap,
                                    T* R) const {
    for (int i = 0; i < Tool::numUnknowns; ++i) projection[i] = T(0.0);  // Newton's start is the tool's own
    R[0] = T(0.0);
    taylor::solveImplicit<3, Tool::numUnknowns>(tool, x, projection);
    gap[0] = projection[0];
    taylor::solveImplicit<1, 1, 1>(pressure, gap, data, R);
  }
};

}  // namespace atrapos::contact
