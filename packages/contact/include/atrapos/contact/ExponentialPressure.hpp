#pragma once

#include <Kokkos_Macros.hpp>
#include <cmath>

#include "atrapos/contact/Requirements.hpp"
#include "atrapos/taylor/Implicit.hpp"

namespace atrapos::contact {

/// Exponential law:
///
///     R = R_0 (exp(-h/l) - exp(-Delta/l))
///
/// entire in h. R_0 is the pressure of touching, l the length over which it grows by e: pressed by R the body
/// goes l ln(R/R_0) into the tool. Units as in RegularisedPressure.
struct ExponentialPressure {
  double touching = 0;  ///< R_0 > 0
  double length = 0;    ///< l > 0

  /// x = (h), y = (R), data = (Delta).
  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* x, const T* y, const taylor::Passive<T>* data, T* g) const {
    using std::exp;
    g[0] = y[0] - touching * (exp(-x[0] / length) - exp(-data[0] / length));
  }

  KOKKOS_INLINE_FUNCTION void start(const double* x, const double* data, double* y) const {
    y[0] = touching * std::exp(-data[0] / length) * std::expm1((data[0] - x[0]) / length);
    // Where the two factors under- and overflow the difference is its first term.
    if (!std::isfinite(y[0])) y[0] = touching * std::exp(-x[0] / length);
  }

  void validate() const {
    detail::requirePositive("exponential law", "pressure of touching", touching);
    detail::requirePositive("exponential law", "length", length);
  }
};

}  // namespace atrapos::contact
