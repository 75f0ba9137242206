#pragma once

#include "atrapos/solid/TiedPoint.hpp"

/// Algebra of the six-node shell's assumed strains (docs/theory/shell_triangles.md, "Six nodes"). An element
/// has eleven vectors,
///
///     a = x_,xi and b = x_,eta of its middle surface at corner 1, x_,xi xi, x_,xi eta, x_,eta eta,
///     directors d_1 ... d_6 of its nodes,
///
/// of which every point makes those at the points where strains are tied.
namespace atrapos::solid {

/// Where strains are tied along an edge from 0 to 1: its two Gauss points, and how far inside the third point
/// for strains along it lies.
namespace mitc6 {
constexpr double near = 0.21132486540518711775, far = 1 - near, inside = far - near;
}

/// What a law of a six-node shell keeps of a point.
template <class P>
struct Mitc6Place : TiedPlace<P> {
  /// [0..2] xi, eta, zeta; [3..5], [6..8], [9..11] parts of the three tied strains along edge 1-2, 1-3, 2-3
  /// in the strain along that direction here; [12..19], [20..27] parts of the tied products of shear in 2
  /// E_13 and 2 E_23.
  static constexpr int numData = 28;
};

namespace detail {

/// From the element's eleven vectors to the point's nineteen, of one component.
template <class P>
struct Mitc6Spread {
  Mitc6Place<P> at;
  template <class V>
  ATRAPOS_FORCEINLINE void operator()(const V* x, V* v) const {
    using namespace mitc6;
    const P xi = at.xi(), eta = at.eta(), zeta = at.zeta();
    const V* d = x + 5;
    // First derivatives of x + zeta d at corner 1, and second ones.
    const V a = x[0] + zeta * (4.0 * d[3] - 3.0 * d[0] - d[1]),
            b = x[1] + zeta * (4.0 * d[5] - 3.0 * d[0] - d[2]),
            aa = x[2] + (4.0 * zeta) * (d[0] + d[1] - 2.0 * d[3]),
            ab = x[3] + (4.0 * zeta) * (d[0] + d[4] - d[3] - d[5]),
            bb = x[4] + (4.0 * zeta) * (d[0] + d[2] - 2.0 * d[5]);
    v[0] = a + near * aa;
    v[1] = a + far * aa;
    v[2] = v[0] + inside * ab;
    v[3] = b + near * bb;
    v[4] = b + far * bb;
    v[5] = v[3] + inside * ab;
    const V c = b - a, ca = ab - aa, cb = bb - ab;  // along edge 2-3
    v[6] = c + far * ca + near * cb;
    v[7] = c + near * ca + far * cb;
    v[8] = c + near * ca + near * cb;
    // Quadratic functions on an edge at its points: far inside, near inside, middle.
    constexpr double own = far * (far - near), other = near * (near - far), middle = 4 * near * far;
    v[9] = own * d[0] + other * d[1] + middle * d[3];
    v[10] = other * d[0] + own * d[1] + middle * d[3];
    v[11] = own * d[0] + other * d[2] + middle * d[5];
    v[12] = other * d[0] + own * d[2] + middle * d[5];
    v[13] = own * d[1] + other * d[2] + middle * d[4];
    v[14] = other * d[1] + own * d[2] + middle * d[4];
    constexpr double third = 1.0 / 3;
    v[15] = a + third * (aa + ab);
    v[16] = b + third * (ab + bb);
    v[17] = (4.0 / 9) * (d[3] + d[4] + d[5]) - (1.0 / 9) * (d[0] + d[1] + d[2]);
    const P first = 1.0 - xi - eta;
    v[18] = first * (2.0 * first - 1.0) * d[0] + xi * (2.0 * xi - 1.0) * d[1] +
            eta * (2.0 * eta - 1.0) * d[2] + (4.0 * first) * xi * d[3] + (4.0 * xi) * eta * d[4] +
            (4.0 * eta) * first * d[5];
  }
};

/// Its transpose.
template <class P>
struct Mitc6Gather {
  Mitc6Place<P> at;
  template <class V>
  ATRAPOS_FORCEINLINE void operator()(const V* v, V* x) const {
    using namespace mitc6;
    const P xi = at.xi(), eta = at.eta(), zeta = at.zeta();
    constexpr double third = 1.0 / 3;
    const V alongFirst = v[0] + v[2], alongSecond = v[3] + v[5], c = v[6] + v[7] + v[8],
            ca = far * v[6] + near * (v[7] + v[8]), cb = far * v[7] + near * (v[6] + v[8]),
            innerFirst = third * v[15], innerSecond = third * v[16], mixed = inside * (v[2] + v[5]);
    const V a = alongFirst + v[1] + v[15] - c, b = alongSecond + v[4] + v[16] + c,
            aa = near * alongFirst + far * v[1] + innerFirst - ca,
            ab = mixed + innerFirst + innerSecond + ca - cb,
            bb = near * alongSecond + far * v[4] + innerSecond + cb;
    x[0] = a;
    x[1] = b;
    x[2] = aa;
    x[3] = ab;
    x[4] = bb;
    constexpr double own = far * (far - near), other = near * (near - far), middle = 4 * near * far;
    const P first = 1.0 - xi - eta, four = 4.0 * zeta;
    const V corners = (-1.0 / 9) * v[17], middles = (4.0 / 9) * v[17];
    V* d = x + 5;
    d[0] = own * (v[9] + v[11]) + other * (v[10] + v[12]) + corners + first * (2.0 * first - 1.0) * v[18] +
           zeta * (4.0 * (aa + ab + bb) - 3.0 * (a + b));
    d[1] = own * (v[10] + v[13]) + other * (v[9] + v[14]) + corners + xi * (2.0 * xi - 1.0) * v[18] +
           zeta * (4.0 * aa - a);
    d[2] = own * (v[12] + v[14]) + other * (v[11] + v[13]) + corners + eta * (2.0 * eta - 1.0) * v[18] +
           zeta * (4.0 * bb - b);
    d[3] = middle * (v[9] + v[10]) + middles + (4.0 * first) * xi * v[18] + four * (a - 2.0 * aa - ab);
    d[4] = middle * (v[13] + v[14]) + middles + (4.0 * xi) * eta * v[18] + four * ab;
    d[5] = middle * (v[11] + v[12]) + middles + (4.0 * eta) * first * v[18] + four * (b - ab - 2.0 * bb);
  }
};

/// Convected strains, 11 22 33 12 23 13, from the changes of the products.
template <class P>
struct Mitc6Strain {
  Mitc6Place<P> at;
  template <class V>
  ATRAPOS_FORCEINLINE void operator()(const V* c, V* E) const {
    const P *k = at.data + 3, *first = at.data + 12, *second = at.data + 20;
    const V along = k[6] * c[6] + k[7] * c[7] + k[8] * c[8];
    E[0] = k[0] * c[0] + k[1] * c[1] + k[2] * c[2];
    E[1] = k[3] * c[3] + k[4] * c[4] + k[5] * c[5];
    E[2] = c[17];
    E[3] = 0.5 * (E[0] + E[1] - along);
    V twice13 = first[0] * c[9], twice23 = second[0] * c[9];
    ATRAPOS_UNROLL
    for (int m = 1; m < 8; ++m) {
      twice13 = twice13 + first[m] * c[9 + m];
      twice23 = twice23 + second[m] * c[9 + m];
    }
    E[4] = 0.5 * twice23;
    E[5] = 0.5 * twice13;
  }
};

/// Its transpose, for stresses whose 33 is halved (ToConvected) and whose mixed components count once.
template <class P>
struct Mitc6Weights {
  Mitc6Place<P> at;
  template <class V>
  ATRAPOS_FORCEINLINE void operator()(const V* s, V* c) const {
    const P *k = at.data + 3, *first = at.data + 12, *second = at.data + 20;
    const V byFirst = s[0] + s[3], bySecond = s[1] + s[3];
    ATRAPOS_UNROLL
    for (int m = 0; m < 3; ++m) {
      c[m] = k[m] * byFirst;
      c[3 + m] = k[3 + m] * bySecond;
      c[6 + m] = (-1.0 * k[6 + m]) * s[3];
    }
    ATRAPOS_UNROLL
    for (int m = 0; m < 8; ++m) c[9 + m] = first[m] * s[5] + second[m] * s[4];
    c[17] = 2.0 * s[2];
  }
};

/// The forces of TiedForceTerms with passive G in place of the vectors.
template <class P>
struct Mitc6LinearForces {
  const P* G;
  template <class V>
  ATRAPOS_FORCEINLINE void operator()(const V* s, V* f) const {
    constexpr int onEdges[6] = {0, 1, 3, 4, 6, 7};
    ATRAPOS_UNROLL
    for (int m = 0; m < 9; ++m) f[m] = G[m] * s[m];
    ATRAPOS_UNROLL
    for (int e = 0; e < 6; ++e) {
      f[onEdges[e]] = f[onEdges[e]] + G[9 + e] * s[9 + e];
      f[9 + e] = G[onEdges[e]] * s[9 + e];
    }
    f[15] = G[17] * s[15];
    f[16] = G[17] * s[16];
    f[17] = G[15] * s[15] + G[16] * s[16];
    f[18] = G[18] * s[17];
  }
};

}  // namespace detail

/// The Element of TiedPoint. Vectors of a point, with those of zeta d: along edges 1-2, 1-3, 2-3 at the two
/// Gauss points of each and at its third point; directors at the Gauss points; g_1, g_2 and d at the centre;
/// d at the point itself.
struct Mitc6 {
  static constexpr int vectors = 11, spread = 19;
  static constexpr int pairs[][2] = {{0, 0},  {1, 1},  {2, 2},  {3, 3},   {4, 4},   {5, 5},
                                     {6, 6},  {7, 7},  {8, 8},  {0, 9},   {1, 10},  {3, 11},
                                     {4, 12}, {6, 13}, {7, 14}, {15, 17}, {16, 17}, {18, 18}};
  template <class P>
  using Place = Mitc6Place<P>;
  template <class P>
  using Spread = detail::Mitc6Spread<P>;
  template <class P>
  using Gather = detail::Mitc6Gather<P>;
  template <class P>
  using Strain = detail::Mitc6Strain<P>;
  template <class P>
  using Weights = detail::Mitc6Weights<P>;
  template <class P>
  using LinearForces = detail::Mitc6LinearForces<P>;

  /// g_1, g_2 and the director at the point, of one component: tangents vary linearly, as what three points
  /// give.
  KOKKOS_INLINE_FUNCTION static void base(const Place<double>& at, const double* v, double* g) {
    const double* k = at.data + 3;
    g[0] = k[0] * v[0] + k[1] * v[1] + k[2] * v[2];
    g[1] = k[3] * v[3] + k[4] * v[4] + k[5] * v[5];
    g[2] = v[18];
  }
};

}  // namespace atrapos::solid
