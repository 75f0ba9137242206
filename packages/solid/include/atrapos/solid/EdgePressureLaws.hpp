#pragma once

#include "atrapos/solid/ShellLoadLaws.hpp"

/// Laws of pressures that follow the edges of plane bodies (docs/theory/solid.md, "Pressures that follow");
/// their terms are made by PlaneBody.hpp.
namespace atrapos::solid {

/// A pressure on a deformed edge x(xi), counter-clockwise about the body, per d(xi) and per thickness, of
/// rings per 2 pi: a positive amount pushes on the body. in: values and slopes by xi of u_x, then of u_y, and
/// the load factor. data: undeformed X, X_xi, Y_xi, and the c of the potential.
///
/// ring: x is a radius. conservative: derivative of amount times the area (of rings the volume) to the left
/// of the edge, int (x - c) dy (rings: int (x^2 - c^2)/2 dy). It differs from the force per area by forces at
/// the ends of the loaded edges, which vanish where y is held or x is held at c.
template <bool ring, bool conservative>
struct EdgePressure {
  static constexpr int numInputs = 5, numOutputs = 4, numData = 4;
  static constexpr bool symmetric = conservative;

  LoadAmount pressure;  ///< force per deformed area

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* in, const taylor::Passive<T>* data, T* out) const {
    const T x = in[0] + data[0], xSlope = in[1] + data[1], ySlope = in[3] + data[2];
    const T p = pressure.at(in[4]);
    T force;
    if constexpr (ring)
      force = p * x;
    else
      force = p;
    out[0] = force * ySlope;
    out[1] = 0.0;
    if constexpr (conservative) {
      out[2] = 0.0;
      if constexpr (ring)
        out[3] = 0.5 * (force * x) - (0.5 * data[3] * data[3]) * p;
      else
        out[3] = p * x - data[3] * p;
    } else {
      out[2] = -(force * xSlope);
      out[3] = 0.0;
    }
  }
};

}  // namespace atrapos::solid

ATRAPOS_DECLARE_POINT_LAW(atrapos::solid::EdgePressure<false, false>)
ATRAPOS_DECLARE_POINT_LAW(atrapos::solid::EdgePressure<false, true>)
ATRAPOS_DECLARE_POINT_LAW(atrapos::solid::EdgePressure<true, false>)
ATRAPOS_DECLARE_POINT_LAW(atrapos::solid::EdgePressure<true, true>)
