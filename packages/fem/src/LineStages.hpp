#pragma once

#include <Kokkos_Macros.hpp>

#include "atrapos/fem/PointLaw.hpp"
#include "atrapos/taylor/Functions.hpp"

/// What integrals over a part of a line are made of (docs/theory/moving_edges.md): laws that stand behind
/// each other, for lines of degree P in a plane.
///
/// A line is x(xi) = sum_k c_k xi^k, k = 0..P, xi in [-1, 1]; its coefficients are [k][component].
namespace atrapos::fem {

/// xi, c -> x (2), dx/dxi (2).
template <int P>
struct CurveStage {
  static constexpr bool stage = true, symmetric = false;
  static constexpr int numInputs = 1 + 2 * (P + 1), numOutputs = 4, numData = 0;

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* in, const taylor::Passive<T>*, T* out) const {
    const T* c = in + 1;
    for (int i = 0; i < 2; ++i) {
      if constexpr (P == 1) {
        out[i] = c[i] + in[0] * c[2 + i];
        out[2 + i] = c[2 + i];
      } else {
        const T bend = in[0] * c[4 + i];
        const T chord = c[2 + i] + bend;
        out[i] = c[i] + in[0] * chord;
        out[2 + i] = c[2 + i] + 2.0 * bend;
      }
    }
  }
};

/// n (2), dx/dxi (2) -> dh/dxi = n . dx/dxi, of surfaces whose normal is the gradient of the gap.
struct SlopeStage {
  static constexpr bool stage = true, symmetric = false;
  static constexpr int numInputs = 4, numOutputs = 1, numData = 0;

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* in, const taylor::Passive<T>*, T* out) const {
    out[0] = in[0] * in[2] + in[1] * in[3];
  }
};

/// xi_1, xi_2, c -> the cubature point xi = xi_1 + t (xi_2 - xi_1): x (2), xi, and its weight in the
/// undeformed body, w (xi_2 - xi_1) |dX/dxi| depth. data: t, w in [0, 1], depth = d_0 + d_1 X, C.
template <int P>
struct CubatureStage {
  static constexpr bool stage = true, symmetric = false;
  static constexpr int numInputs = 2 + 2 * (P + 1), numOutputs = 4, numData = 4 + 2 * (P + 1);

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* in, const taylor::Passive<T>* data, T* out) const {
    using std::sqrt;
    const T* c = in + 2;
    const taylor::Passive<T>* C = data + 4;
    const T width = in[1] - in[0];
    const T xi = in[0] + data[0] * width;
    T along[2];
    for (int i = 0; i < 2; ++i) {
      if constexpr (P == 1) {
        out[i] = c[i] + xi * c[2 + i];
        along[i] = T(0.0) + C[2 + i];
      } else {
        const T chord = c[2 + i] + xi * c[4 + i];
        out[i] = c[i] + xi * chord;
        along[i] = C[2 + i] + 2.0 * (C[4 + i] * xi);
      }
    }
    T X;
    if constexpr (P == 1) {
      X = C[0] + C[2] * xi;
    } else {
      const T chord = C[2] + C[4] * xi;
      X = C[0] + xi * chord;
    }
    const T square = along[0] * along[0] + along[1] * along[1];
    const T length = sqrt(square);
    const T area = length * (data[2] + data[3] * X);
    out[2] = xi;
    out[3] = data[1] * (width * area);
  }
};

/// p, n (2), xi, weight -> what -p n does on the coefficients: F_k = -p n xi^k weight.
template <int P>
struct ForceStage {
  static constexpr bool stage = true, symmetric = false;
  static constexpr int numInputs = 5, numOutputs = 2 * (P + 1), numData = 0;

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* in, const taylor::Passive<T>*, T* out) const {
    T share = -(in[0] * in[4]);
    for (int k = 0; k <= P; ++k) {
      for (int i = 0; i < 2; ++i) out[2 * k + i] = share * in[1 + i];
      if (k < P) {
        const T next = share * in[3];
        share = next;
      }
    }
  }
};

}  // namespace atrapos::fem

ATRAPOS_DECLARE_POINT_LAW(atrapos::fem::CurveStage<1>)
ATRAPOS_DECLARE_POINT_LAW(atrapos::fem::CurveStage<2>)
ATRAPOS_DECLARE_POINT_LAW(atrapos::fem::SlopeStage)
ATRAPOS_DECLARE_POINT_LAW(atrapos::fem::CubatureStage<1>)
ATRAPOS_DECLARE_POINT_LAW(atrapos::fem::CubatureStage<2>)
ATRAPOS_DECLARE_POINT_LAW(atrapos::fem::ForceStage<1>)
ATRAPOS_DECLARE_POINT_LAW(atrapos::fem::ForceStage<2>)
