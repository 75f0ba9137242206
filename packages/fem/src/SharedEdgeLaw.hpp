#pragma once

#include "JointLaws.hpp"

namespace atrapos::fem {

/// mu.g with g = y - Q(h, m) - beta m: the middle y of an edge between its ends, from halfway between them; h
/// from end to end, d_a and d_b the directors there, m = (d_a + d_b)/2. beta = ((d_b - d_a).h - (D_b -
/// D_a).H)/(8 m.m) is what an arc rises over its chord when directors turn, and Q = q_h h + (q_m m + q_c h x
/// m)|M|/|m| where the middle is at rest. Lengths are in units of the edge's, directors in units of their
/// lengths, both at rest.
///
/// in, out: [i][changes of y, h], [i][of d_a, d_b], mu [3]. data: H, D_a, D_b, q_h, q_m, q_c, M.M.
struct SharedEdgeLaw {
  static constexpr int numInputs = 15, numOutputs = 15, numData = 13;
  static constexpr bool symmetric = true;

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* in, const taylor::Passive<T>* data, T* out) const {
    using std::sqrt;
    taylor::Passive<T> M[3], D[3], HM[3];
    T s[3], h[3], change[3], m[3], more[3], turn[3], mu[3];
    for (int i = 0; i < 3; ++i) {
      M[i] = 0.5 * (data[3 + i] + data[6 + i]);
      D[i] = data[6 + i] - data[3 + i];
      s[i] = in[2 * i + 1];
      h[i] = s[i] + data[i];
      change[i] = 0.5 * (in[6 + 2 * i] + in[7 + 2 * i]);
      m[i] = change[i] + M[i];
      more[i] = in[7 + 2 * i] - in[6 + 2 * i];
      turn[i] = more[i] + D[i];
      mu[i] = in[12 + i];
    }
    detail::vectorProduct(data, M, HM);
    const T mm = data[12] + (detail::scalarProduct(change, change) +
                             2.0 * (M[0] * change[0] + M[1] * change[1] + M[2] * change[2]));
    const T rise = detail::scalarProduct(more, h) + (D[0] * s[0] + D[1] * s[1] + D[2] * s[2]);
    const T perSquare = 1.0 / mm;
    const T shorter = sqrt(data[12] * perSquare);  // |M|/|m|
    const T beta = 0.125 * (rise * perSquare);
    T hm[3], mMu[3], muH[3];
    detail::vectorProduct(h, m, hm);
    detail::vectorProduct(m, mu, mMu);
    detail::vectorProduct(mu, h, muH);
    const T P = detail::scalarProduct(mu, m);
    const T U = shorter * (data[10] * P + data[11] * detail::scalarProduct(mu, hm));
    const T perTurn = 0.125 * (P * perSquare);
    const T alongM = (U + 2.0 * (beta * P)) * perSquare;
    for (int i = 0; i < 3; ++i) {
      const T Q = shorter * (data[10] * m[i] + data[11] * hm[i]);
      const auto Q0 = data[10] * M[i] + data[11] * HM[i];
      out[12 + i] = in[2 * i] - data[9] * s[i] - (Q - Q0) - beta * m[i];
      out[2 * i] = mu[i];
      out[2 * i + 1] = -data[9] * mu[i] - data[11] * (shorter * mMu[i]) - perTurn * turn[i];
      const T byM = alongM * m[i] - shorter * (data[10] * mu[i] + data[11] * muH[i]) - beta * mu[i];
      out[6 + 2 * i] = 0.5 * byM + perTurn * h[i];
      out[7 + 2 * i] = 0.5 * byM - perTurn * h[i];
    }
  }
};

}  // namespace atrapos::fem

ATRAPOS_DECLARE_POINT_LAW(atrapos::fem::SharedEdgeLaw)
