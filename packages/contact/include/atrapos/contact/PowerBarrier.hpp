#pragma once

#include <Kokkos_Macros.hpp>
#include <algorithm>
#include <cmath>

#include "atrapos/contact/Requirements.hpp"
#include "atrapos/taylor/Implicit.hpp"

namespace atrapos::contact {

/// Power law:
///
///     (R + eta) ((h + c R)/Delta)^m - eta = 0,   c = 1/alpha,   m >= 1
///
/// c = 0: R = eta ((Delta/h)^m - 1), a barrier; m = 1, c = 0 is paper (15) with 1/alpha = 0. The branch is
/// the one with R > -eta and h + c R > 0. Units as in RegularisedPressure.
struct PowerBarrier {
  double compliance = 0;  ///< c >= 0
  double eta = 0;         ///< > 0
  double exponent = 2;    ///< m

  /// x = (h), y = (R), data = (Delta).
  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* x, const T* y, const taylor::Passive<T>* data, T* g) const {
    using std::pow;
    const T opening = (x[0] + compliance * y[0]) / data[0];
    g[0] = (y[0] + eta) * pow(opening, exponent) - eta;
  }

  /// Newton from above on an increasing convex function, near enough for the iteration that follows.
  KOKKOS_INLINE_FUNCTION void start(const double* x, const double* data, double* y) const {
    const double h = x[0], Delta = data[0];
    if (compliance == 0) {
      y[0] = eta * (std::pow(Delta / h, exponent) - 1);  // NaN or useless at h <= 0: there is no value
      if (!(h > 0)) y[0] = std::nan("");
      return;
    }
    // There h + c R = 2 Delta at least and R + eta > eta, so that the function is positive.
    double R = std::fmax(2 * Delta - h, 0.0) / compliance + eta;
    if (h > 0 && h < Delta) R = std::fmin(R, eta * (std::pow(Delta / h, exponent) - 1));  // that of c = 0
    for (int i = 0; i < 100; ++i) {
      const double opening = (h + compliance * R) / Delta, power = std::pow(opening, exponent);
      const double f = (R + eta) * power - eta;
      const double slope = power + (R + eta) * exponent * compliance * power / (opening * Delta);
      const double step = f / slope;
      R -= step;
      if (std::fabs(step) <= 1e-6 * (R + eta)) break;
    }
    y[0] = R;
  }

  void validate() const {
    const char* who = "power law";
    if (!(compliance >= 0) || !std::isfinite(compliance))
      detail::refuse(who, "compliance must be >= 0 and finite, got " + detail::shown(compliance));
    detail::requirePositive(who, "eta", eta);
    if (!(exponent >= 1 && exponent <= 16))
      detail::refuse(who, "exponent must be between 1 and 16, got " + detail::shown(exponent));
  }
};

}  // namespace atrapos::contact
