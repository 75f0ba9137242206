#pragma once

#include "atrapos/solid/ShellLoadLaws.hpp"

/// Laws of pressures that follow the edges of plane bodies (docs/theory/solid.md, "Pressures that follow");
/// their terms are made by EdgePressure.hpp.
namespace atrapos::solid {

/// A pressure on a deformed edge x(xi), counter-clockwise about the body, per d(xi) and per thickness, of
/// rings (x is a radius) per 2 pi: a positive amount pushes on the body. in: values and slopes by xi of u_x,
/// then of u_y, and the load factor. data: undeformed X, X_xi, Y_xi.
template <bool ring>
struct EdgePressure {
  static constexpr int numInputs = 5, numOutputs = 4, numData = 3;
  static constexpr bool symmetric = false;

  LoadAmount pressure;  ///< force per deformed area

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* in, const taylor::Passive<T>* data, T* out) const {
    const T xSlope = in[1] + data[1], ySlope = in[3] + data[2];
    T force = pressure.at(in[4]);
    if constexpr (ring) {
      const T x = in[0] + data[0];
      force = force * x;
    }
    out[0] = force * ySlope;  // the residual has loads with a minus sign
    out[1] = 0.0;
    out[2] = -(force * xSlope);
    out[3] = 0.0;
  }
};

}  // namespace atrapos::solid

ATRAPOS_DECLARE_POINT_LAW(atrapos::solid::EdgePressure<false>)
ATRAPOS_DECLARE_POINT_LAW(atrapos::solid::EdgePressure<true>)
