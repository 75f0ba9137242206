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
/// |E + x|^2 - 1 for a unit vector E.
template <class T>
KOKKOS_INLINE_FUNCTION T squareChange(const T* x, const taylor::Passive<T>* E) {
  return scalarProduct(x, x) + 2.0 * (E[0] * x[0] + E[1] * x[1] + E[2] * x[2]);
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
    T x[3], y[3], a[3], b[3];
    for (int i = 0; i < 3; ++i) {
      x[i] = in[2 * i];
      y[i] = in[2 * i + 1];
      a[i] = x[i] + data[i];
      b[i] = y[i] + data[3 + i];
    }
    // In what changes from rest, where g is 0 and not the rounding of numbers of size 1.
    const T p = detail::squareChange(x, data), q = detail::squareChange(y, data + 3);
    const T aa = 1.0 + p, bb = 1.0 + q;
    const T lengths = sqrt(aa * bb);
    const T stretch = (p + q + p * q) / (1.0 + lengths);
    const T turn = data[0] * y[0] + data[1] * y[1] + data[2] * y[2] + detail::scalarProduct(x, b);
    out[6] = data[7] * (turn - data[6] * stretch);
    const T mu = data[7] * in[6];
    const T perLength = mu / lengths;
    const T alongA = data[6] * (perLength * bb), alongB = data[6] * (perLength * aa);
    for (int i = 0; i < 3; ++i) {
      out[2 * i] = mu * b[i] - alongA * a[i];
      out[2 * i + 1] = mu * a[i] - alongB * b[i];
    }
  }
};

/// mu g with g = d.(p_1 e_1 + p_2 e_2 + p_3 e_1 x e_2), e_i = d_i/|d_i|: a third director stays normal to a
/// direction that turns with the first two.
///
/// in, out: [i][x_1i, x_2i, x_i], mu; dimensionless. data: E_1, E_2, E, p, E.E_1, E.E_2, E.(E_1 x E_2).
struct JointDirection {
  static constexpr int numInputs = 10, numOutputs = 10, numData = 15;
  static constexpr bool symmetric = true;

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* in, const taylor::Passive<T>* data, T* out) const {
    using std::sqrt;
    T x[3], y[3], z[3], a[3], b[3], d[3], ab[3], bd[3], da[3];
    for (int i = 0; i < 3; ++i) {
      x[i] = in[3 * i];
      y[i] = in[3 * i + 1];
      z[i] = in[3 * i + 2];
      a[i] = x[i] + data[i];
      b[i] = y[i] + data[3 + i];
      d[i] = z[i] + data[6 + i];
    }
    detail::vectorProduct(a, b, ab);
    detail::vectorProduct(b, d, bd);
    detail::vectorProduct(d, a, da);
    // Changes of 1/|a| and 1/|b|, d.a, d.b and d.(a x b) from rest, where g is 0.
    const T p = detail::squareChange(x, data), q = detail::squareChange(y, data + 3);
    const T aa = 1.0 + p, bb = 1.0 + q;
    const T sizeA = sqrt(aa), sizeB = sqrt(bb);
    const T perA = 1.0 / sizeA, perB = 1.0 / sizeB;
    const T perAB = perA * perB;
    const T shortA = p * perA / (1.0 + sizeA), shortB = q * perB / (1.0 + sizeB);
    const T shortAB = shortA + perA * shortB;
    const T onA = data[0] * z[0] + data[1] * z[1] + data[2] * z[2] + detail::scalarProduct(x, d);
    const T onB = data[3] * z[0] + data[4] * z[1] + data[5] * z[2] + detail::scalarProduct(y, d);
    // d.(a x b) - E.(E_1 x E_2) = z.(a x b) + x.(b x E) + y.(E x E_1), with b x E and E x E_1 in what is
    // there.
    T bE[3];
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      bE[i] = b[j] * data[6 + k] - b[k] * data[6 + j];
    }
    const T volume = detail::scalarProduct(z, ab) + detail::scalarProduct(x, bE) +
                     y[0] * (data[7] * data[2] - data[8] * data[1]) +
                     y[1] * (data[8] * data[0] - data[6] * data[2]) +
                     y[2] * (data[6] * data[1] - data[7] * data[0]);
    out[9] = data[9] * (onA * perA - data[12] * shortA) + data[10] * (onB * perB - data[13] * shortB) +
             data[11] * (volume * perAB - data[14] * shortAB);
    const T mu = in[9];
    const T m1 = data[9] * (mu * perA), m2 = data[10] * (mu * perB), m3 = data[11] * (mu * perAB);
    const T whole = m3 * (volume + data[14]);
    // What shortens as a or b grows.
    const T alongA = (m1 * (onA + data[12]) + whole) / aa, alongB = (m2 * (onB + data[13]) + whole) / bb;
    for (int i = 0; i < 3; ++i) {
      out[3 * i] = m1 * d[i] + m3 * bd[i] - alongA * a[i];
      out[3 * i + 1] = m2 * d[i] + m3 * da[i] - alongB * b[i];
      out[3 * i + 2] = m1 * a[i] + m2 * b[i] + m3 * ab[i];
    }
  }
};

}  // namespace atrapos::fem

ATRAPOS_DECLARE_POINT_LAW(atrapos::fem::JointAngle)
ATRAPOS_DECLARE_POINT_LAW(atrapos::fem::JointDirection)
