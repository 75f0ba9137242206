#pragma once

#include <cmath>

#include "atrapos/fem/PointLaw.hpp"
#include "atrapos/taylor/Law.hpp"

namespace atrapos::physics {

/// Momentum and volume of an incompressible fluid at a point (docs/theory/flow.md):
///
///     rho v_j dv_i/dx_j - d/dx_j (mu dv_i/dx_j - p delta_ij) = 0,    dv_j/dx_j = 0
///
/// in:  gradients of the components of the velocity v, then these, then the pressure p
/// out: mu grad v - p I, rho v . grad v, div v
///
/// Gradients: 2 in the plane and around an axis with v_r/r behind them, 3 in space; Ring says which.
template <int Components, bool Ring>
struct FlowLaw {
  static constexpr int gradients = Ring ? 3 : Components;
  static constexpr int firstValue = Components * gradients, pressure = firstValue + Components;
  static constexpr int numInputs = pressure + 1, numOutputs = numInputs, numData = 0;
  static constexpr bool symmetric = false;
  double viscosity = 0, density = 0;

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* in, const taylor::Passive<T>*, T* out) const {
    const T& p = in[pressure];
    T divergence = in[0];
    for (int i = 0; i < Components; ++i) {
      const T* gradient = in + i * gradients;
      T carried = in[firstValue] * gradient[0];
      for (int j = 1; j < Components; ++j) carried = carried + in[firstValue + j] * gradient[j];
      for (int j = 0; j < gradients; ++j) {
        const bool around = Ring && j == 2;  // v_r/r alone is a strain there
        if (around && i > 0)
          out[i * gradients + j] = T(0.0);
        else if (i == j || around)
          out[i * gradients + j] = viscosity * gradient[j] - p;
        else
          out[i * gradients + j] = viscosity * gradient[j];
      }
      out[firstValue + i] = density * carried;
      if (i > 0) divergence = divergence + gradient[i];
    }
    if constexpr (Ring) divergence = divergence + in[2];
    out[pressure] = divergence;
  }

  /// What these are the sums of.
  void sizes(const double* in, const double*, double* out) const {
    const double p = std::abs(in[pressure]);
    double sum = Ring ? std::abs(in[2]) : 0;
    for (int i = 0; i < Components; ++i) {
      const double* gradient = in + i * gradients;
      double carried = 0;
      for (int j = 0; j < Components; ++j) carried += std::abs(in[firstValue + j] * gradient[j]);
      for (int j = 0; j < gradients; ++j)
        out[i * gradients + j] = viscosity * std::abs(gradient[j]) + (i == j ? p : 0);
      out[firstValue + i] = density * carried;
      sum += std::abs(gradient[i]);
    }
    // A fluid at rest under its weight has velocities of rounding: those that its pressures would give.
    constexpr double rounding = 1e-8;
    out[pressure] = sum + rounding * p / viscosity;
  }
};

}  // namespace atrapos::physics

ATRAPOS_DECLARE_POINT_LAW(atrapos::physics::FlowLaw<2, false>)
ATRAPOS_DECLARE_POINT_LAW(atrapos::physics::FlowLaw<2, true>)
ATRAPOS_DECLARE_POINT_LAW(atrapos::physics::FlowLaw<3, false>)
