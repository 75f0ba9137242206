#pragma once

#include "atrapos/solid/ShellBase.hpp"

/// Algebra of the four-node shell's assumed strains (docs/theory/shell_mitc4.md). An element has seven
/// vectors,
///
///     a = x_,xi and b = x_,eta at the centre, m = x_,xi eta of its middle surface, directors d_1 ... d_4 of
///     its corners,
///
/// of which every point makes fourteen, and thirteen products of these are all its strains. Sums over
/// Cartesian components are made one component at a time: more would not stay in registers.
namespace atrapos::solid {

/// What a law of a four-node shell keeps of a point.
template <class P>
struct Mitc4Place {
  /// [0..2] xi, eta, zeta; [3], [4] parts of m along a and b at rest, which no hourglass is; [5..7], [8..10]
  /// what a.h and b.h do to E_11, E_22, E_12.
  static constexpr int numData = 11;
  const P* data;
  KOKKOS_FORCEINLINE_FUNCTION P xi() const { return data[0]; }
  KOKKOS_FORCEINLINE_FUNCTION P eta() const { return data[1]; }
  KOKKOS_FORCEINLINE_FUNCTION P zeta() const { return data[2]; }
};

namespace detail {

// The vectors of a point: g_1, g_2, m + zeta d_,xi eta, d_,eta at xi = 0, d at xi = 0, d at eta = 0,
// d_1 ... d_4, a, b, h (the hourglass part of m), d_,xi at eta = 0.
constexpr int mitc4Vectors = 14, mitc4Products = 13;

/// The pairs whose products strains are made of; equal ones count half.
constexpr int mitc4Pairs[mitc4Products][2] = {{0, 0}, {1, 1}, {0, 1}, {0, 4},   {1, 5},   {2, 3}, {6, 6},
                                              {7, 7}, {8, 8}, {9, 9}, {10, 12}, {11, 12}, {2, 13}};
constexpr bool mitc4Square(int product) { return mitc4Pairs[product][0] == mitc4Pairs[product][1]; }

constexpr auto listMitc4ProductTerms() {
  taylor::detail::TermList<mitc4Products> t;
  for (int m = 0; m < mitc4Products; ++m) t.add(m, mitc4Pairs[m][0], mitc4Pairs[m][1]);
  return t.terms;
}
/// Of one component.
struct Mitc4ProductTerms {
  static constexpr bool ofOneBlock = true;
  static constexpr int numLeft = mitc4Vectors, numRight = mitc4Vectors, numOut = mitc4Products;
  static constexpr bool onlySquares(int out) { return mitc4Square(out); }
  static constexpr auto list = listMitc4ProductTerms();
};

/// sum over the pairs (a, b) of s_m (a_p at b, a_q at a); a square counts once
constexpr auto listMitc4ForceTerms() {
  taylor::detail::TermList<20> t;
  for (int m = 0; m < mitc4Products; ++m) {
    const int a = mitc4Pairs[m][0], b = mitc4Pairs[m][1];
    t.add(a, b, m);
    if (a != b) t.add(b, a, m);
  }
  return t.terms;
}
struct Mitc4ForceTerms {
  static constexpr bool ofOneBlock = false;
  static constexpr int numLeft = mitc4Vectors, numRight = mitc4Products, numOut = mitc4Vectors;
  static constexpr auto list = listMitc4ForceTerms();
};

/// From the element's seven vectors to the point's fourteen, of one component.
template <class P>
struct Mitc4Spread {
  Mitc4Place<P> at;
  template <class V>
  KOKKOS_FORCEINLINE_FUNCTION void operator()(const V* x, V* v) const {
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
  KOKKOS_FORCEINLINE_FUNCTION void operator()(const V* v, V* x) const {
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
KOKKOS_FORCEINLINE_FUNCTION P mitc4Shape(const Mitc4Place<P>& at, int corner) {
  const P x = corner == 0 || corner == 3 ? 1.0 - at.xi() : 1.0 + at.xi();
  const P y = corner < 2 ? 1.0 - at.eta() : 1.0 + at.eta();
  return 0.25 * (x * y);
}

/// Convected strains, 11 22 33 12 23 13, from the changes of the products.
template <class P>
struct Mitc4Strain {
  Mitc4Place<P> at;
  template <class V>
  KOKKOS_FORCEINLINE_FUNCTION void operator()(const V* c, V* E) const {
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
  KOKKOS_FORCEINLINE_FUNCTION void operator()(const V* s, V* c) const {
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

/// What changes of products have that is linear in the changes h of the vectors G at rest.
template <class P>
struct Mitc4LinearProducts {
  const P* G;
  template <class V>
  KOKKOS_FORCEINLINE_FUNCTION void operator()(const V* h, V* c) const {
    ATRAPOS_UNROLL
    for (int m = 0; m < mitc4Products; ++m) {
      const int a = mitc4Pairs[m][0], b = mitc4Pairs[m][1];
      if (a == b)
        c[m] = G[a] * h[a];
      else
        c[m] = G[a] * h[b] + G[b] * h[a];
    }
  }
};

/// The forces of Mitc4ForceTerms with passive G in place of the vectors.
template <class P>
struct Mitc4LinearForces {
  const P* G;
  template <class V>
  KOKKOS_FORCEINLINE_FUNCTION void operator()(const V* s, V* f) const {
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

/// v_i x A^i, by rows, of the vectors (x + zeta d)_,xi, (x + zeta d)_,eta, d at a point: with their changes
/// the displacement gradient, with the vectors the deformation gradient.
KOKKOS_INLINE_FUNCTION void mitc4Gradient(const double* vectors, const double* place, const double* A,
                                          double* gradient) {
  const Mitc4Place<double> at{place};
  for (int i = 0; i < 3; ++i) {
    double v[mitc4Vectors], d = 0;
    Mitc4Spread<double>{at}(vectors + 7 * i, v);
    for (int a = 0; a < 4; ++a) d += mitc4Shape(at, a) * v[6 + a];
    for (int k = 0; k < 3; ++k)
      gradient[3 * i + k] = v[0] * A[3 * k] + v[1] * A[3 * k + 1] + d * A[3 * k + 2];
  }
}

/// Squares count half.
struct Mitc4HalveSquares {
  template <class V>
  KOKKOS_FORCEINLINE_FUNCTION void operator()(const V* linear, const V* products, V* c) const {
    ATRAPOS_UNROLL
    for (int m = 0; m < mitc4Products; ++m) {
      if (mitc4Square(m))
        c[m] = linear[m] + 0.5 * products[m];
      else
        c[m] = linear[m] + products[m];
    }
  }
};

}  // namespace detail

/// The fourteen vectors of a point and what they do.
template <class T>
class Mitc4Point {
  using P = taylor::Passive<T>;
  static constexpr int N = detail::mitc4Vectors, M = detail::mitc4Products;

 public:
  /// change: of the element's seven vectors, which atRest has at rest ([component][vector], 21); place of the
  /// point.
  KOKKOS_FORCEINLINE_FUNCTION Mitc4Point(const T* change, const P* atRest, const P* place) : place_{place} {
    ATRAPOS_UNROLL
    for (int k = 0; k < 3; ++k) {
      const detail::Mitc4Spread<P> spread{place_};
      spread(atRest + 7 * k, rest_[k]);
      taylor::detail::linear(spread, taylor::detail::Tensor<T, 7>(change + 7 * k), h_[k]);
    }
  }

  /// Green-Lagrange strain in the components of the contravariant base A, [axis][direction].
  KOKKOS_FORCEINLINE_FUNCTION taylor::Symmetric3<T> strain(const P* A) const {
    taylor::detail::Tensor<T, M> sums[3];
    ATRAPOS_UNROLL
    for (int k = 0; k < 3; ++k) {
      taylor::detail::Tensor<T, M> linear, products;
      taylor::detail::linear(detail::Mitc4LinearProducts<P>{rest_[k]}, h_[k], linear);
      taylor::detail::bilinear<detail::Mitc4ProductTerms>(h_[k], h_[k], products);
      taylor::detail::linear(detail::Mitc4HalveSquares{}, linear, products, sums[k]);
    }
    taylor::detail::Tensor<T, M> two, changes;
    taylor::detail::linear(taylor::detail::Plus<M>{}, sums[0], sums[1], two);
    taylor::detail::linear(taylor::detail::Plus<M>{}, two, sums[2], changes);
    taylor::Symmetric3<T> convected, E;
    taylor::detail::linear(detail::Mitc4Strain<P>{place_}, changes, convected);
    taylor::detail::linear(detail::ToCartesian<P>{A}, convected, E);
    return E;
  }

  /// Work conjugates of the seven vectors for the second Piola-Kirchhoff stress, to out[21].
  KOKKOS_FORCEINLINE_FUNCTION void forces(const taylor::Symmetric3<T>& S, const P* A, T* out) const {
    taylor::Symmetric3<T> convected;
    taylor::detail::Tensor<T, M> weights;
    taylor::detail::linear(detail::ToConvected<P>{A}, S, convected);
    taylor::detail::linear(detail::Mitc4Weights<P>{place_}, convected, weights);
    ATRAPOS_UNROLL
    for (int k = 0; k < 3; ++k) {
      taylor::detail::Tensor<T, N> constant, product, sum;
      taylor::detail::linear(detail::Mitc4LinearForces<P>{rest_[k]}, weights, constant);
      taylor::detail::bilinear<detail::Mitc4ForceTerms>(h_[k], weights, product);
      taylor::detail::linear(taylor::detail::Plus<N>{}, constant, product, sum);
      taylor::detail::Tensor<T, 7> f;
      taylor::detail::linear(detail::Mitc4Gather<P>{place_}, sum, f);
      f.store(out + 7 * k);
    }
  }

 private:
  Mitc4Place<P> place_;
  P rest_[3][N];
  taylor::detail::Tensor<T, N> h_[3];
};

}  // namespace atrapos::solid
