#pragma once

#include <Kokkos_Macros.hpp>
#include <cmath>

#include "atrapos/contact/Requirements.hpp"
#include "atrapos/taylor/Implicit.hpp"

namespace atrapos::contact {

/// The regularised gap-pressure law, paper (15), multiplied out of its 1/alpha:
///
///     R (c R + h) - eta (Delta - h) = 0,   c = 1/alpha
///
/// with the gap h, the normal pressure R (its positive branch; R < 0 only where h > Delta), the reference gap
/// Delta > 0, the contact stiffness alpha and the regularisation eta > 0. c = 0 is the barrier form.
/// Units: R and eta are pressures and alpha a pressure per length at face points; forces and a force per
/// length at nodes.
struct RegularisedPressure {
  double compliance = 0;  ///< c = 1/alpha >= 0
  double eta = 0;         ///< > 0

  /// x = (h), y = (R), data = (Delta).
  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* x, const T* y, const taylor::Passive<T>* data, T* g) const {
    g[0] = y[0] * (compliance * y[0] + x[0]) - eta * (data[0] - x[0]);
  }

  /// The root itself, written without cancellation on either side of h = 0.
  KOKKOS_INLINE_FUNCTION void start(const double* x, const double* data, double* y) const {
    const double h = x[0], load = eta * (data[0] - h);
    const double root = std::sqrt(h * h + 4 * compliance * load);
    y[0] = h > 0 ? 2 * load / (h + root) : (root - h) / (2 * compliance);
  }

  void validate() const {
    if (!(compliance >= 0) || !std::isfinite(compliance))
      detail::refuse("contact law", "compliance must be >= 0 and finite, got " + detail::shown(compliance));
    detail::requirePositive("contact law", "eta", eta);
  }
};

}  // namespace atrapos::contact
