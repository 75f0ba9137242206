#pragma once

#include "atrapos/solid/TiedPoint.hpp"

/// Algebra of the three-node shell's assumed strains (docs/theory/shell_triangles.md). An element has five
/// vectors,
///
///     a = x_,xi and b = x_,eta of its middle surface, directors d_1, d_2, d_3 of its corners,
///
/// of which every point makes eleven, and nine products of these are all its strains.
namespace atrapos::solid {

/// What a law of a three-node shell keeps of a point.
template <class P>
struct Mitc3Place : TiedPlace<P> {
  /// [0..2] xi, eta, zeta; [3..5], [6..8] parts of the three edges' products, twice their shear strains, in 2
  /// E_13 and 2 E_23.
  static constexpr int numData = 9;
  ATRAPOS_FORCEINLINE P first() const { return 1.0 - this->xi() - this->eta(); }  ///< of the first corner
};

namespace detail {

/// From the element's five vectors to the point's eleven, of one component.
template <class P>
struct Mitc3Spread {
  Mitc3Place<P> at;
  template <class V>
  ATRAPOS_FORCEINLINE void operator()(const V* x, V* v) const {
    const P zeta = at.zeta();
    v[0] = x[0] + zeta * (x[3] - x[2]);
    v[1] = x[1] + zeta * (x[4] - x[2]);
    v[2] = x[0];
    v[3] = x[1];
    v[4] = x[1] - x[0];
    v[5] = x[2] + x[3];
    v[6] = x[2] + x[4];
    v[7] = x[3] + x[4];
    v[8] = x[2];
    v[9] = x[3];
    v[10] = x[4];
  }
};

/// Its transpose.
template <class P>
struct Mitc3Gather {
  Mitc3Place<P> at;
  template <class V>
  ATRAPOS_FORCEINLINE void operator()(const V* v, V* x) const {
    const P zeta = at.zeta();
    x[0] = v[0] + v[2] - v[4];
    x[1] = v[1] + v[3] + v[4];
    x[2] = v[5] + v[6] + v[8] - zeta * (v[0] + v[1]);
    x[3] = v[5] + v[7] + v[9] + zeta * v[0];
    x[4] = v[6] + v[7] + v[10] + zeta * v[1];
  }
};

/// Convected strains, 11 22 33 12 23 13, from the changes of the products.
template <class P>
struct Mitc3Strain {
  Mitc3Place<P> at;
  template <class V>
  ATRAPOS_FORCEINLINE void operator()(const V* c, V* E) const {
    const P *k = at.data, half = 0.5 * at.zeta();
    E[0] = c[0];
    E[1] = c[1];
    E[2] = at.first() * c[6] + at.xi() * c[7] + at.eta() * c[8];
    E[3] = 0.5 * c[2];
    E[4] = 0.5 * (k[6] * c[3] + k[7] * c[4] + k[8] * c[5]) + half * (c[8] - c[6]);
    E[5] = 0.5 * (k[3] * c[3] + k[4] * c[4] + k[5] * c[5]) + half * (c[7] - c[6]);
  }
};

/// Its transpose, for stresses whose 33 is halved (ToConvected) and whose mixed components count once.
template <class P>
struct Mitc3Weights {
  Mitc3Place<P> at;
  template <class V>
  ATRAPOS_FORCEINLINE void operator()(const V* s, V* c) const {
    const P *k = at.data, zeta = at.zeta();
    c[0] = s[0];
    c[1] = s[1];
    c[2] = s[3];
    c[3] = k[3] * s[5] + k[6] * s[4];
    c[4] = k[4] * s[5] + k[7] * s[4];
    c[5] = k[5] * s[5] + k[8] * s[4];
    c[6] = (2.0 * at.first()) * s[2] - zeta * (s[4] + s[5]);
    c[7] = (2.0 * at.xi()) * s[2] + zeta * s[5];
    c[8] = (2.0 * at.eta()) * s[2] + zeta * s[4];
  }
};

/// The forces of TiedForceTerms with passive G in place of the vectors.
template <class P>
struct Mitc3LinearForces {
  const P* G;
  template <class V>
  ATRAPOS_FORCEINLINE void operator()(const V* s, V* f) const {
    f[0] = G[0] * s[0] + G[1] * s[2];
    f[1] = G[1] * s[1] + G[0] * s[2];
    f[2] = G[5] * s[3];
    f[3] = G[6] * s[4];
    f[4] = G[7] * s[5];
    f[5] = G[2] * s[3];
    f[6] = G[3] * s[4];
    f[7] = G[4] * s[5];
    f[8] = G[8] * s[6];
    f[9] = G[9] * s[7];
    f[10] = G[10] * s[8];
  }
};

}  // namespace detail

/// The Element of TiedPoint. Vectors of a point: g_1, g_2; along the edges 1-2, 1-3, 2-3; sums of the
/// directors at their ends; d_1, d_2, d_3.
struct Mitc3 {
  static constexpr int vectors = 5, spread = 11;
  static constexpr int pairs[][2] = {{0, 0}, {1, 1}, {0, 1}, {2, 5},  {3, 6},
                                     {4, 7}, {8, 8}, {9, 9}, {10, 10}};
  template <class P>
  using Place = Mitc3Place<P>;
  template <class P>
  using Spread = detail::Mitc3Spread<P>;
  template <class P>
  using Gather = detail::Mitc3Gather<P>;
  template <class P>
  using Strain = detail::Mitc3Strain<P>;
  template <class P>
  using Weights = detail::Mitc3Weights<P>;
  template <class P>
  using LinearForces = detail::Mitc3LinearForces<P>;

  /// g_1, g_2 and the director at the point, of one component.
  KOKKOS_INLINE_FUNCTION static void base(const Place<double>& at, const double* v, double* g) {
    g[0] = v[0];
    g[1] = v[1];
    g[2] = at.first() * v[8] + at.xi() * v[9] + at.eta() * v[10];
  }
};

}  // namespace atrapos::solid
