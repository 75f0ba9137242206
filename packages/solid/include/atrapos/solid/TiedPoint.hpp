#pragma once

#include "atrapos/solid/ShellBase.hpp"

/// Strains of shells whose products of vectors are tied between points of an element
/// (docs/theory/shell_mitc4.md, shell_triangles.md). An Element says
///
///     vectors     how many vectors it has, linear in the unknowns
///     spread      how many vectors a point makes of them
///     pairs       whose products are all its strains, [product][2]; equal ones count half
///     Place<P>    what a point keeps of itself, a TiedPlace of `numData` numbers
///
/// and in Spread, Gather, Strain, Weights, LinearForces how these hang together. Sums over Cartesian
/// components are made one component at a time: more would not stay in registers.
namespace atrapos::solid {

/// Where a point is, and what stands behind it.
template <class P>
struct TiedPlace {
  const P* data;  ///< [0..2] xi, eta, zeta
  ATRAPOS_FORCEINLINE P xi() const { return data[0]; }
  ATRAPOS_FORCEINLINE P eta() const { return data[1]; }
  ATRAPOS_FORCEINLINE P zeta() const { return data[2]; }
};

namespace detail {

template <class Element>
constexpr int tiedProducts = static_cast<int>(sizeof(Element::pairs) / sizeof(Element::pairs[0]));

template <class Element>
constexpr bool tiedSquare(int product) {
  return Element::pairs[product][0] == Element::pairs[product][1];
}

/// The products of one component.
template <class Element>
struct TiedProductTerms {
  static constexpr bool ofOneBlock = true;
  static constexpr int numLeft = Element::spread, numRight = Element::spread, numOut = tiedProducts<Element>;
  static constexpr bool onlySquares(int out) { return tiedSquare<Element>(out); }
  static constexpr auto make() {
    taylor::detail::TermList<numOut> t;
    for (int m = 0; m < numOut; ++m) t.add(m, Element::pairs[m][0], Element::pairs[m][1]);
    return t.terms;
  }
  static constexpr auto list = make();
};

/// sum over the pairs (a, b) of s_m (a_p at b, a_q at a); a square counts once
template <class Element>
struct TiedForceTerms {
  static constexpr bool ofOneBlock = false;
  static constexpr int numLeft = Element::spread, numRight = tiedProducts<Element>, numOut = Element::spread;
  static constexpr int count() {
    int terms = 0;
    for (int m = 0; m < numRight; ++m) terms += tiedSquare<Element>(m) ? 1 : 2;
    return terms;
  }
  static constexpr auto make() {
    taylor::detail::TermList<count()> t;
    for (int m = 0; m < numRight; ++m) {
      const int a = Element::pairs[m][0], b = Element::pairs[m][1];
      t.add(a, b, m);
      if (a != b) t.add(b, a, m);
    }
    return t.terms;
  }
  static constexpr auto list = make();
};

/// What changes of products have that is linear in the changes h of the vectors G at rest.
template <class Element, class P>
struct TiedLinearProducts {
  const P* G;
  template <class V>
  ATRAPOS_FORCEINLINE void operator()(const V* h, V* c) const {
    ATRAPOS_UNROLL
    for (int m = 0; m < tiedProducts<Element>; ++m) {
      const int a = Element::pairs[m][0], b = Element::pairs[m][1];
      if (a == b)
        c[m] = G[a] * h[a];
      else
        c[m] = G[a] * h[b] + G[b] * h[a];
    }
  }
};

/// Squares count half.
template <class Element>
struct TiedHalveSquares {
  template <class V>
  ATRAPOS_FORCEINLINE void operator()(const V* linear, const V* products, V* c) const {
    ATRAPOS_UNROLL
    for (int m = 0; m < tiedProducts<Element>; ++m) {
      if (tiedSquare<Element>(m))
        c[m] = linear[m] + 0.5 * products[m];
      else
        c[m] = linear[m] + products[m];
    }
  }
};

/// g_i x A^i, by rows, of the vectors (x + zeta d)_,xi, (x + zeta d)_,eta, d at a point: with the changes of
/// the element's vectors the displacement gradient, with the vectors the deformation gradient.
template <class Element>
KOKKOS_INLINE_FUNCTION void tiedGradient(const double* vectors, const double* place, const double* A,
                                         double* gradient) {
  const typename Element::template Place<double> at{place};
  for (int i = 0; i < 3; ++i) {
    double v[Element::spread];
    typename Element::template Spread<double>{at}(vectors + Element::vectors * i, v);
    double g[3];
    Element::base(at, v, g);
    for (int k = 0; k < 3; ++k)
      gradient[3 * i + k] = g[0] * A[3 * k] + g[1] * A[3 * k + 1] + g[2] * A[3 * k + 2];
  }
}

}  // namespace detail

/// The vectors of a point and what they do.
template <class Element, class T>
class TiedPoint {
  using P = taylor::Passive<T>;
  static constexpr int E_ = Element::vectors, N = Element::spread, M = detail::tiedProducts<Element>;

 public:
  /// change: of the element's vectors, which atRest has at rest ([component][vector]); place of the point.
  ATRAPOS_FORCEINLINE TiedPoint(const T* change, const P* atRest, const P* place) : place_{place} {
    ATRAPOS_UNROLL
    for (int k = 0; k < 3; ++k) {
      const typename Element::template Spread<P> spread{place_};
      spread(atRest + E_ * k, rest_[k]);
      taylor::detail::linear(spread, taylor::detail::Tensor<T, E_>(change + E_ * k), h_[k]);
    }
  }

  /// Green-Lagrange strain in the components of the contravariant base A, [axis][direction].
  ATRAPOS_FORCEINLINE taylor::Symmetric3<T> strain(const P* A) const {
    taylor::detail::Tensor<T, M> sums[3];
    ATRAPOS_UNROLL
    for (int k = 0; k < 3; ++k) {
      taylor::detail::Tensor<T, M> linear, products;
      taylor::detail::linear(detail::TiedLinearProducts<Element, P>{rest_[k]}, h_[k], linear);
      taylor::detail::bilinear<detail::TiedProductTerms<Element>>(h_[k], h_[k], products);
      taylor::detail::linear(detail::TiedHalveSquares<Element>{}, linear, products, sums[k]);
    }
    taylor::detail::Tensor<T, M> two, changes;
    taylor::detail::linear(taylor::detail::Plus<M>{}, sums[0], sums[1], two);
    taylor::detail::linear(taylor::detail::Plus<M>{}, two, sums[2], changes);
    taylor::Symmetric3<T> convected, E;
    taylor::detail::linear(typename Element::template Strain<P>{place_}, changes, convected);
    taylor::detail::linear(detail::ToCartesian<P>{A}, convected, E);
    return E;
  }

  /// Work conjugates of the element's vectors for the second Piola-Kirchhoff stress.
  ATRAPOS_FORCEINLINE void forces(const taylor::Symmetric3<T>& S, const P* A, T* out) const {
    taylor::Symmetric3<T> convected;
    taylor::detail::Tensor<T, M> weights;
    taylor::detail::linear(detail::ToConvected<P>{A}, S, convected);
    taylor::detail::linear(typename Element::template Weights<P>{place_}, convected, weights);
    ATRAPOS_UNROLL
    for (int k = 0; k < 3; ++k) {
      taylor::detail::Tensor<T, N> constant, product, sum;
      taylor::detail::linear(typename Element::template LinearForces<P>{rest_[k]}, weights, constant);
      taylor::detail::bilinear<detail::TiedForceTerms<Element>>(h_[k], weights, product);
      taylor::detail::linear(taylor::detail::Plus<N>{}, constant, product, sum);
      taylor::detail::Tensor<T, E_> f;
      taylor::detail::linear(typename Element::template Gather<P>{place_}, sum, f);
      f.store(out + E_ * k);
    }
  }

 private:
  typename Element::template Place<P> place_;
  P rest_[3][N];
  taylor::detail::Tensor<T, N> h_[3];
};

}  // namespace atrapos::solid
