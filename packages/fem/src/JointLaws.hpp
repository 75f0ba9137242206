#pragma once

#include "atrapos/fem/PointLaw.hpp"
#include "atrapos/taylor/Tensor.hpp"

/// What keeps the directors of a rigid joint to each other (docs/theory/shell_joints.md). Directors are in
/// units of their length at rest: d_i = E_i + x_i with |E_i| = 1, and only their directions count.
namespace atrapos::fem {

namespace detail {
template <class T>
KOKKOS_INLINE_FUNCTION T scalarProduct(const T* a, const T* b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <class T>
KOKKOS_INLINE_FUNCTION void vectorProduct(const T* a, const T* b, T* c) {
  c[0] = a[1] * b[2] - a[2] * b[1];
  c[1] = a[2] * b[0] - a[0] * b[2];
  c[2] = a[0] * b[1] - a[1] * b[0];
}
}  // namespace detail

/// mu g with g = (d_1.d_2 - cos |d_1||d_2|)/sin: two directors keep the angle between them.
///
/// in, out: [i][x_1i, x_2i], mu; dimensionless. data: E_1, E_2, cos, 1/sin of their angle.
struct JointAngle {
  static constexpr int numInputs = 7, numOutputs = 7, numData = 8;
  static constexpr bool symmetric = true;

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* in, const taylor::Passive<T>* data, T* out) const {
    using std::sqrt;
    T a[3], b[3];
    for (int i = 0; i < 3; ++i) {
      a[i] = in[2 * i] + data[i];
      b[i] = in[2 * i + 1] + data[3 + i];
    }
    const T aa = detail::scalarProduct(a, a), bb = detail::scalarProduct(b, b);
    const T lengths = sqrt(aa * bb);
    const T mu = data[7] * in[6];
    const T alongA = data[6] * (mu * bb / lengths), alongB = data[6] * (mu * aa / lengths);
    for (int i = 0; i < 3; ++i) {
      out[2 * i] = mu * b[i] - alongA * a[i];
      out[2 * i + 1] = mu * a[i] - alongB * b[i];
    }
    const T dot = detail::scalarProduct(a, b);
    out[6] = data[7] * (dot - data[6] * lengths);
  }
};

/// mu g with g = d.(p_1 e_1 + p_2 e_2 + p_3 e_1 x e_2), e_i = d_i/|d_i|: a third director stays normal to a
/// direction that turns with the first two.
///
/// in, out: [i][x_1i, x_2i, x_i], mu; dimensionless. data: E_1, E_2, E, p.
struct JointDirection {
  static constexpr int numInputs = 10, numOutputs = 10, numData = 12;
  static constexpr bool symmetric = true;

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* in, const taylor::Passive<T>* data, T* out) const {
    using std::sqrt;
    T a[3], b[3], d[3], ab[3], bd[3], da[3];
    for (int i = 0; i < 3; ++i) {
      a[i] = in[3 * i] + data[i];
      b[i] = in[3 * i + 1] + data[3 + i];
      d[i] = in[3 * i + 2] + data[6 + i];
    }
    detail::vectorProduct(a, b, ab);
    detail::vectorProduct(b, d, bd);
    detail::vectorProduct(d, a, da);
    const T aa = detail::scalarProduct(a, a), bb = detail::scalarProduct(b, b);
    const T perA = 1.0 / sqrt(aa), perB = 1.0 / sqrt(bb);
    // Coefficients of d.a, d.b and d.(a x b) in g.
    const T p1 = data[9] * perA, p2 = data[10] * perB, p3 = data[11] * (perA * perB);
    const T alongD1 = detail::scalarProduct(a, d), alongD2 = detail::scalarProduct(b, d),
            volume = detail::scalarProduct(d, ab);
    const T mu = in[9];
    const T partA = p1 * alongD1, partB = p2 * alongD2, partV = p3 * volume;
    // What shortens as a or b grows.
    const T alongA = mu * ((partA + partV) / aa), alongB = mu * ((partB + partV) / bb);
    const T m1 = mu * p1, m2 = mu * p2, m3 = mu * p3;
    for (int i = 0; i < 3; ++i) {
      out[3 * i] = m1 * d[i] + m3 * bd[i] - alongA * a[i];
      out[3 * i + 1] = m2 * d[i] + m3 * da[i] - alongB * b[i];
      out[3 * i + 2] = m1 * a[i] + m2 * b[i] + m3 * ab[i];
    }
    out[9] = partA + partB + partV;
  }
};

}  // namespace atrapos::fem

ATRAPOS_DECLARE_POINT_LAW(atrapos::fem::JointAngle)
ATRAPOS_DECLARE_POINT_LAW(atrapos::fem::JointDirection)
