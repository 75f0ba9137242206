#pragma once

#include <string>
#include <vector>

#include "atrapos/fem/PointLaw.hpp"
#include "atrapos/taylor/FunctionMarks.hpp"
#include "atrapos/taylor/Law.hpp"

/// Laws of loads that follow a shell; their terms are made by ShellLoads.hpp (docs/theory/shell.md, "Loads").
/// Loads grow with the load factor lambda, their last input: amount = constant + lambda rate.
namespace atrapos::solid {

/// constant + lambda rate.
struct LoadAmount {
  double constant = 0;
  double rate = 0;

  template <class T>
  KOKKOS_INLINE_FUNCTION T at(const T& lambda) const {
    return rate * lambda + constant;
  }
};

namespace detail {
template <class T>
KOKKOS_INLINE_FUNCTION void cross(const T* a, const T* b, T* c) {
  c[0] = a[1] * b[2] - a[2] * b[1];
  c[1] = a[2] * b[0] - a[0] * b[2];
  c[2] = a[0] * b[1] - a[1] * b[0];
}
template <class T>
KOKKOS_INLINE_FUNCTION T dot(const T* a, const T* b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
}  // namespace detail

/// A pressure on the deformed surface zeta = const: -amount x_xi cross x_eta per reference d(xi) d(eta), so a
/// positive amount pushes against the normal. data: undeformed x_xi (3), x_eta (3).
struct FollowerPressure {
  static constexpr int numInputs = 10, numOutputs = 9, numData = 6;
  static constexpr bool symmetric = false;

  LoadAmount pressure;  ///< force per deformed area

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* in, const taylor::Passive<T>* data, T* out) const {
    T g1[3], g2[3], n[3];
    for (int i = 0; i < 3; ++i) {
      g1[i] = in[3 * i + 1] + data[i];
      g2[i] = in[3 * i + 2] + data[3 + i];
    }
    detail::cross(g1, g2, n);
    const T p = pressure.at(in[9]);
    for (int i = 0; i < 3; ++i) {
      out[3 * i] = p * n[i];  // the residual has loads with a minus sign
      for (int c = 1; c < 3; ++c) out[3 * i + c] = 0.0;
    }
  }
};

/// Forces and a moment per undeformed length of an edge that turn with it. Frame: tangent t of the deformed
/// edge (in the sense of the element's nodes, counter-clockwise seen from the side the normal points to),
/// director d, outward t x d. The moment acts about t as a couple on the director, (t x d)/(d.d) per unit:
/// its work on a turn dphi of the director is dphi.t. data: undeformed director D (3), undeformed x_s (3).
struct FollowerEdgeLoad {
  static constexpr int numInputs = 10, numOutputs = 9, numData = 6;
  static constexpr bool symmetric = false;

  LoadAmount along, director, outward;  ///< force per length
  LoadAmount moment;                    ///< about t

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* in, const taylor::Passive<T>* data, T* out) const {
    using std::sqrt;
    T d[3], t[3], b[3];
    for (int i = 0; i < 3; ++i) {
      d[i] = in[3 * i + 2] + data[i];
      t[i] = in[3 * i + 1] + data[3 + i];
    }
    const T tangentSize = sqrt(detail::dot(t, t)), d2 = detail::dot(d, d);
    const T directorSize = sqrt(d2);
    for (int i = 0; i < 3; ++i) t[i] = t[i] / tangentSize;
    detail::cross(t, d, b);
    const T lambda = in[9];
    const T alongT = along.at(lambda), perD = director.at(lambda) / directorSize,
            perB = outward.at(lambda) / sqrt(detail::dot(b, b)), couple = moment.at(lambda) / d2;
    for (int i = 0; i < 3; ++i) {
      out[3 * i] = -(alongT * t[i] + perD * d[i] + perB * b[i]);
      out[3 * i + 1] = 0.0;
      out[3 * i + 2] = -(couple * b[i]);
    }
  }
};

/// A moment vector per undeformed length of an edge that keeps its direction: the couple (m x d)/(d.d) on the
/// director. Not conservative in space, as no such moment is; conservative where the directors turn about m
/// only. data: undeformed director D (3), undeformed x_s (3).
struct DeadEdgeMoment {
  static constexpr int numInputs = 10, numOutputs = 9, numData = 6;
  static constexpr bool symmetric = false;

  LoadAmount x, y, z;

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* in, const taylor::Passive<T>* data, T* out) const {
    T d[3], c[3];
    for (int i = 0; i < 3; ++i) d[i] = in[3 * i + 2] + data[i];
    const T lambda = in[9];
    const T m[3] = {x.at(lambda), y.at(lambda), z.at(lambda)};
    const T d2 = detail::dot(d, d);
    detail::cross(m, d, c);
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 2; ++k) out[3 * i + k] = 0.0;
      out[3 * i + 2] = -(c[i] / d2);
    }
  }
};

}  // namespace atrapos::solid

ATRAPOS_DECLARE_POINT_LAW(atrapos::solid::FollowerPressure)
ATRAPOS_DECLARE_POINT_LAW(atrapos::solid::FollowerEdgeLoad)
ATRAPOS_DECLARE_POINT_LAW(atrapos::solid::DeadEdgeMoment)
