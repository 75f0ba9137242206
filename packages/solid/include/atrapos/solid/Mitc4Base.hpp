#pragma once

#include "atrapos/solid/TiedPoint.hpp"

/// Algebra of the four-node shell's assumed strains (docs/theory/shell_mitc4.md). An element has seven
/// vectors,
///
///     a = x_,xi and b = x_,eta at the centre, m = x_,xi eta of its middle surface, directors d_1 ... d_4 of
///     its corners,
///
/// of which every point makes fourteen, and thirteen products of these are all its strains.
namespace atrapos::solid {

/// What a law of a four-node shell keeps of a point.
template <class P>
struct Mitc4Place : TiedPlace<P> {
  /// [0..2] xi, eta, zeta; [3], [4] parts of m along a and b at rest, which no hourglass is; [5..7], [8..10]
  /// what a.h and b.h do to E_11, E_22, E_12.
  static constexpr int numData = 11;
};

namespace detail {

/// From the element's seven vectors to the point's fourteen, of one component.
template <class P>
struct Mitc4Spread {
  Mitc4Place<P> at;
  template <class V>
  ATRAPOS_FORCEINLINE void operator()(const V* x, V* v) const {
    const P xi = at.xi(), eta = at.eta(), zeta = at.zeta();
    const V d = 0.25 * (x[3] + x[4] + x[5] + x[6]), dXi = 0.25 * (x[4] + x[5] - x[3] - x[6]),
            dEta = 0.25 * (x[5] + x[6] - x[3] - x[4]), n = 0.25 * (x[3] + x[5] - x[4] - x[6]);
    v[0] = x[0] + eta * x[2] + zeta * (dXi + eta * n);
    v[1] = x[1] + xi * x[2] + zeta * (dEta + xi * n);
    v[2] = x[2] + zeta * n;
    v[3] = dEta;
    v[4] = d + eta * dEta;
    v[5] = d + xi * dXi;
    ATRAPOS_UNROLL
    for (int a = 0; a < 4; ++a) v[6 + a] = x[3 + a];
    v[10] = x[0];
    v[11] = x[1];
    v[12] = x[2] - at.data[3] * x[0] - at.data[4] * x[1];
    v[13] = dXi;
  }
};

/// Its transpose.
template <class P>
struct Mitc4Gather {
  Mitc4Place<P> at;
  template <class V>
  ATRAPOS_FORCEINLINE void operator()(const V* v, V* x) const {
    const P xi = at.xi(), eta = at.eta(), zeta = at.zeta();
    const V d = 0.25 * (v[4] + v[5]), dXi = 0.25 * (zeta * v[0] + xi * v[5] + v[13]),
            dEta = 0.25 * (zeta * v[1] + eta * v[4] + v[3]),
            n = 0.25 * ((zeta * eta) * v[0] + (zeta * xi) * v[1] + zeta * v[2]);
    x[0] = v[0] + v[10] - at.data[3] * v[12];
    x[1] = v[1] + v[11] - at.data[4] * v[12];
    x[2] = eta * v[0] + xi * v[1] + v[2] + v[12];
    x[3] = v[6] + d - dXi - dEta + n;
    x[4] = v[7] + d + dXi - dEta - n;
    x[5] = v[8] + d + dXi + dEta + n;
    x[6] = v[9] + d - dXi + dEta - n;
  }
};

/// Bilinear shape function of a corner.
template <class P>
ATRAPOS_FORCEINLINE P mitc4Shape(const Mitc4Place<P>& at, int corner) {
  const P x = corner == 0 || corner == 3 ? 1.0 - at.xi() : 1.0 + at.xi();
  const P y = corner < 2 ? 1.0 - at.eta() : 1.0 + at.eta();
  return 0.25 * (x * y);
}

/// Convected strains, 11 22 33 12 23 13, from the changes of the products.
template <class P>
struct Mitc4Strain {
  Mitc4Place<P> at;
  template <class V>
  ATRAPOS_FORCEINLINE void operator()(const V* c, V* E) const {
    const P *k = at.data + 5, xi = at.xi(), eta = at.eta();
    E[0] = c[0] + k[0] * c[10] + k[3] * c[11];
    E[1] = c[1] + k[1] * c[10] + k[4] * c[11];
    E[2] = mitc4Shape(at, 0) * c[6] + mitc4Shape(at, 1) * c[7] + mitc4Shape(at, 2) * c[8] +
           mitc4Shape(at, 3) * c[9];
    E[3] = 0.5 * c[2] + k[2] * c[10] + k[5] * c[11];
    E[4] = 0.5 * c[4] + (0.5 - 0.5 * (xi * xi)) * c[12];
    E[5] = 0.5 * c[3] + (0.5 - 0.5 * (eta * eta)) * c[5];
  }
};

/// Its transpose, for stresses whose 33 is halved (ToConvected) and whose mixed components count once.
template <class P>
struct Mitc4Weights {
  Mitc4Place<P> at;
  template <class V>
  ATRAPOS_FORCEINLINE void operator()(const V* s, V* c) const {
    const P *k = at.data + 5, xi = at.xi(), eta = at.eta();
    c[0] = s[0];
    c[1] = s[1];
    c[2] = s[3];
    c[3] = s[5];
    c[4] = s[4];
    c[5] = (1.0 - eta * eta) * s[5];
    ATRAPOS_UNROLL
    for (int a = 0; a < 4; ++a) c[6 + a] = (2.0 * mitc4Shape(at, a)) * s[2];
    c[10] = k[0] * s[0] + k[1] * s[1] + (2.0 * k[2]) * s[3];
    c[11] = k[3] * s[0] + k[4] * s[1] + (2.0 * k[5]) * s[3];
    c[12] = (1.0 - xi * xi) * s[4];
  }
};

/// The forces of TiedForceTerms with passive G in place of the vectors.
template <class P>
struct Mitc4LinearForces {
  const P* G;
  template <class V>
  ATRAPOS_FORCEINLINE void operator()(const V* s, V* f) const {
    f[0] = G[0] * s[0] + G[1] * s[2] + G[4] * s[3];
    f[1] = G[1] * s[1] + G[0] * s[2] + G[5] * s[4];
    f[2] = G[3] * s[5] + G[13] * s[12];
    f[3] = G[2] * s[5];
    f[4] = G[0] * s[3];
    f[5] = G[1] * s[4];
    ATRAPOS_UNROLL
    for (int a = 6; a < 10; ++a) f[a] = G[a] * s[a];
    f[10] = G[12] * s[10];
    f[11] = G[12] * s[11];
    f[12] = G[10] * s[10] + G[11] * s[11];
    f[13] = G[2] * s[12];
  }
};

}  // namespace detail

/// The Element of TiedPoint. Vectors of a point: g_1, g_2, m + zeta d_,xi eta, d_,eta at xi = 0, d at xi = 0,
/// d at eta = 0, d_1 ... d_4, a, b, h (the hourglass part of m), d_,xi at eta = 0.
struct Mitc4 {
  static constexpr int vectors = 7, spread = 14;
  static constexpr int pairs[][2] = {{0, 0}, {1, 1}, {0, 1}, {0, 4},   {1, 5},   {2, 3}, {6, 6},
                                     {7, 7}, {8, 8}, {9, 9}, {10, 12}, {11, 12}, {2, 13}};
  template <class P>
  using Place = Mitc4Place<P>;
  template <class P>
  using Spread = detail::Mitc4Spread<P>;
  template <class P>
  using Gather = detail::Mitc4Gather<P>;
  template <class P>
  using Strain = detail::Mitc4Strain<P>;
  template <class P>
  using Weights = detail::Mitc4Weights<P>;
  template <class P>
  using LinearForces = detail::Mitc4LinearForces<P>;

  /// g_1, g_2 and the director at the point, of one component.
  KOKKOS_INLINE_FUNCTION static void base(const Place<double>& at, const double* v, double* g) {
    g[0] = v[0];
    g[1] = v[1];
    g[2] = 0;
    for (int a = 0; a < 4; ++a) g[2] += detail::mitc4Shape(at, a) * v[6 + a];
  }
};

}  // namespace atrapos::solid
