#pragma once

#include <Kokkos_Macros.hpp>
#include <cmath>

#include "atrapos/contact/Requirements.hpp"
#include "atrapos/taylor/Implicit.hpp"

namespace atrapos::contact {

/// Linear penalty R = alpha max(-h, 0) with its corner smoothed over the length l:
///
///     R = alpha l (P(h) - P(Delta)),   P = ln(1 + exp(-h/l))
///
/// P solves 2 T - (1 + T) exp(-h/l - P) = 0, T = tanh(P/2), which neither overflows deep in the tool nor
/// cancels far from it (docs/theory/contact.md). Unlike (15) its force away from the tool falls
/// exponentially. Units as in RegularisedPressure; eta has no part.
struct SmoothedPenalty {
  double stiffness = 0;  ///< alpha > 0
  double length = 0;     ///< l > 0

  /// x = (h), y = (R), data = (Delta).
  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* x, const T* y, const taylor::Passive<T>* data, T* g) const {
    using std::exp;
    using std::log;
    using std::tanh;
    const T P = y[0] / (stiffness * length) + log(exp(-data[0] / length) + 1.0);
    const T t = tanh(0.5 * P);
    g[0] = 2.0 * t - (t + 1.0) * exp(-x[0] / length - P);
  }

  KOKKOS_INLINE_FUNCTION void start(const double* x, const double* data, double* y) const {
    y[0] = stiffness * length * (softplus(-x[0] / length) - softplus(-data[0] / length));
  }

  void validate() const {
    detail::requirePositive("smoothed penalty", "stiffness", stiffness);
    detail::requirePositive("smoothed penalty", "length", length);
  }

 private:
  static KOKKOS_INLINE_FUNCTION double softplus(double z) {
    return (z > 0 ? z : 0) + std::log1p(std::exp(-std::fabs(z)));
  }
};

}  // namespace atrapos::contact
