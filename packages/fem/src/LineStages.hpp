#pragma once

#include "atrapos/fem/PointLaw.hpp"
#include "atrapos/taylor/FunctionMarks.hpp"
#include "atrapos/taylor/Functions.hpp"

/// What integrals over a part of a line are made of (docs/theory/moving_edges.md): laws that stand behind
/// each other, for lines of degree P in space.
///
/// A line is x(xi) = sum_k c_k xi^k, k = 0..P, xi in [-1, 1]; its coefficients are [k][component].
namespace atrapos::fem {

/// sum_k c_k xi^k of component i.
template <int P, class T, class C>
KOKKOS_INLINE_FUNCTION T onLine(const T& xi, const C* c, int i) {
  if constexpr (P == 1) {
    return c[i] + xi * c[3 + i];
  } else {
    const T chord = c[3 + i] + xi * c[6 + i];
    return c[i] + xi * chord;
  }
}

/// xi, c -> x (3), dx/dxi (3).
template <int P>
struct CurveStage {
  static constexpr bool stage = true, symmetric = false;
  static constexpr int numInputs = 1 + 3 * (P + 1), numOutputs = 6, numData = 0;

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* in, const taylor::Passive<T>*, T* out) const {
    const T* c = in + 1;
    for (int i = 0; i < 3; ++i) {
      if constexpr (P == 1) {
        out[i] = c[i] + in[0] * c[3 + i];
        out[3 + i] = c[3 + i];
      } else {
        const T bend = in[0] * c[6 + i];
        const T chord = c[3 + i] + bend;
        out[i] = c[i] + in[0] * chord;
        out[3 + i] = chord + bend;
      }
    }
  }
};

/// n (3), dx/dxi (3) -> dh/dxi = n . dx/dxi, of surfaces whose normal is the gradient of the gap.
struct SlopeStage {
  static constexpr bool stage = true, symmetric = false;
  static constexpr int numInputs = 6, numOutputs = 1, numData = 0;

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* in, const taylor::Passive<T>*, T* out) const {
    out[0] = in[0] * in[3] + in[1] * in[4] + in[2] * in[5];
  }
};

/// xi_1, xi_2, c -> the cubature point xi = xi_1 + t (xi_2 - xi_1): x (3), xi, and its weight in the
/// undeformed body, w (xi_2 - xi_1) |dX/dxi x A|. data: t, w in [0, 1], the coefficients of X and of A.
template <int P>
struct CubatureStage {
  static constexpr int numCoefficients = 3 * (P + 1);
  static constexpr bool stage = true, symmetric = false;
  static constexpr int numInputs = 2 + numCoefficients, numOutputs = 5, numData = 2 + 2 * numCoefficients;

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* in, const taylor::Passive<T>* data, T* out) const {
    using std::sqrt;
    const taylor::Passive<T>* X = data + 2;
    const T width = in[1] - in[0];
    const T xi = in[0] + data[0] * width;
    T along[3], across[3];
    for (int i = 0; i < 3; ++i) {
      out[i] = onLine<P>(xi, in + 2, i);
      across[i] = onLine<P>(xi, X + numCoefficients, i);
      if constexpr (P == 1)
        along[i] = T(0.0) + X[3 + i];
      else
        along[i] = X[3 + i] + 2.0 * (X[6 + i] * xi);
    }
    T square = T(0.0);
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      const T normal = along[j] * across[k] - along[k] * across[j];
      square = square + normal * normal;
    }
    const T area = sqrt(square);
    out[3] = xi;
    out[4] = data[1] * (width * area);
  }
};

/// p, n (3), xi, weight -> what -p n does on the coefficients: F_k = -p n xi^k weight.
template <int P>
struct ForceStage {
  static constexpr bool stage = true, symmetric = false;
  static constexpr int numInputs = 6, numOutputs = 3 * (P + 1), numData = 0;

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* in, const taylor::Passive<T>*, T* out) const {
    T share = -(in[0] * in[5]);
    for (int k = 0; k <= P; ++k) {
      for (int i = 0; i < 3; ++i) out[3 * k + i] = share * in[1 + i];
      if (k < P) {
        const T next = share * in[4];
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
