#pragma once

#include "atrapos/taylor/Tensor.hpp"

/// Algebra of the shell's convected components (docs/theory/shell.md, "Assumed transverse shear"). The four
/// vectors of a point are the columns of a 3 x 4 matrix by rows: g_1, g_2 tangents, d_1, d_2 the directors
/// that the shear strains E_13, E_23 see. Symmetric components are in the order 11 22 33 12 23 13.
namespace atrapos::solid {

/// Four vectors of a point by their Cartesian components, [component][vector].
template <class T>
struct ShellBase : taylor::detail::Tensor<T, 12> {
  ShellBase() = default;
  ATRAPOS_FORCEINLINE explicit ShellBase(const T* rows) : taylor::detail::Tensor<T, 12>(rows) {}
};

namespace detail {

/// The two vectors whose product is a component: E_11 = (g_1.g_1 - ...)/2, ..., E_33 from d_1.d_2.
constexpr int shellPairs[6][2] = {{0, 0}, {1, 1}, {2, 3}, {0, 1}, {1, 3}, {0, 2}};

/// a_i . a_j of the six pairs
constexpr auto listShellProductTerms() {
  taylor::detail::TermList<18> t;
  for (int k = 0; k < 3; ++k)
    for (int m = 0; m < 6; ++m) t.add(m, 4 * k + shellPairs[m][0], 4 * k + shellPairs[m][1]);
  return t.terms;
}
struct ShellProductTerms {
  static constexpr bool ofOneBlock = true;
  static constexpr int numLeft = 12, numRight = 12, numOut = 6;
  static constexpr bool onlySquares(int out) { return out < 2; }
  static constexpr auto list = listShellProductTerms();
};

/// sum over the pairs (a, b) of s_m (a_p at b, a_q at a); a square counts once
constexpr auto listShellForceTerms() {
  taylor::detail::TermList<30> t;
  for (int k = 0; k < 3; ++k)
    for (int m = 0; m < 6; ++m) {
      const int a = shellPairs[m][0], b = shellPairs[m][1];
      t.add(4 * k + a, 4 * k + b, m);
      if (a != b) t.add(4 * k + b, 4 * k + a, m);
    }
  return t.terms;
}
struct ShellForceTerms {
  static constexpr bool ofOneBlock = false;
  static constexpr int numLeft = 12, numRight = 6, numOut = 12;
  static constexpr auto list = listShellForceTerms();
};

// Written out, entry by entry: only then does everything stay in registers.

/// E_m = (G_a.h_b + h_a.G_b)/2 for passive G
template <class S>
struct ShellLinearStrain {
  const S* G;
  template <class V>
  ATRAPOS_FORCEINLINE void operator()(const V* h, V* out) const {
    out[0] = G[0] * h[0] + G[4] * h[4] + G[8] * h[8];
    out[1] = G[1] * h[1] + G[5] * h[5] + G[9] * h[9];
    out[2] = 0.5 * (G[2] * h[3] + G[3] * h[2] + G[6] * h[7] + G[7] * h[6] + G[10] * h[11] + G[11] * h[10]);
    out[3] = 0.5 * (G[0] * h[1] + G[1] * h[0] + G[4] * h[5] + G[5] * h[4] + G[8] * h[9] + G[9] * h[8]);
    out[4] = 0.5 * (G[1] * h[3] + G[3] * h[1] + G[5] * h[7] + G[7] * h[5] + G[9] * h[11] + G[11] * h[9]);
    out[5] = 0.5 * (G[0] * h[2] + G[2] * h[0] + G[4] * h[6] + G[6] * h[4] + G[8] * h[10] + G[10] * h[8]);
  }
};

/// The forces of ShellForceTerms with passive G in place of a
template <class S>
struct ShellLinearForce {
  const S* G;
  template <class V>
  ATRAPOS_FORCEINLINE void operator()(const V* s, V* out) const {
    out[0] = G[0] * s[0] + G[1] * s[3] + G[2] * s[5];
    out[1] = G[0] * s[3] + G[1] * s[1] + G[3] * s[4];
    out[2] = G[0] * s[5] + G[3] * s[2];
    out[3] = G[1] * s[4] + G[2] * s[2];
    out[4] = G[4] * s[0] + G[5] * s[3] + G[6] * s[5];
    out[5] = G[4] * s[3] + G[5] * s[1] + G[7] * s[4];
    out[6] = G[4] * s[5] + G[7] * s[2];
    out[7] = G[5] * s[4] + G[6] * s[2];
    out[8] = G[8] * s[0] + G[9] * s[3] + G[10] * s[5];
    out[9] = G[8] * s[3] + G[9] * s[1] + G[11] * s[4];
    out[10] = G[8] * s[5] + G[11] * s[2];
    out[11] = G[9] * s[4] + G[10] * s[2];
  }
};

/// A E A^T, A by rows
template <class S>
struct ToCartesian {
  const S* A;
  template <class V>
  ATRAPOS_FORCEINLINE void operator()(const V* E, V* out) const {
    const V m00 = A[0] * E[0] + A[1] * E[3] + A[2] * E[5];
    const V m01 = A[0] * E[3] + A[1] * E[1] + A[2] * E[4];
    const V m02 = A[0] * E[5] + A[1] * E[4] + A[2] * E[2];
    const V m10 = A[3] * E[0] + A[4] * E[3] + A[5] * E[5];
    const V m11 = A[3] * E[3] + A[4] * E[1] + A[5] * E[4];
    const V m12 = A[3] * E[5] + A[4] * E[4] + A[5] * E[2];
    const V m20 = A[6] * E[0] + A[7] * E[3] + A[8] * E[5];
    const V m21 = A[6] * E[3] + A[7] * E[1] + A[8] * E[4];
    const V m22 = A[6] * E[5] + A[7] * E[4] + A[8] * E[2];
    out[0] = A[0] * m00 + A[1] * m01 + A[2] * m02;
    out[1] = A[3] * m10 + A[4] * m11 + A[5] * m12;
    out[2] = A[6] * m20 + A[7] * m21 + A[8] * m22;
    out[3] = A[3] * m00 + A[4] * m01 + A[5] * m02;
    out[4] = A[6] * m10 + A[7] * m11 + A[8] * m12;
    out[5] = A[0] * m20 + A[1] * m21 + A[2] * m22;
  }
};

/// A^T S A, its 33 component halved: what ShellForceTerms take
template <class S>
struct ToConvected {
  const S* A;
  template <class V>
  ATRAPOS_FORCEINLINE void operator()(const V* s, V* out) const {
    const V m00 = A[0] * s[0] + A[3] * s[3] + A[6] * s[5];
    const V m01 = A[1] * s[0] + A[4] * s[3] + A[7] * s[5];
    const V m02 = A[2] * s[0] + A[5] * s[3] + A[8] * s[5];
    const V m10 = A[0] * s[3] + A[3] * s[1] + A[6] * s[4];
    const V m11 = A[1] * s[3] + A[4] * s[1] + A[7] * s[4];
    const V m12 = A[2] * s[3] + A[5] * s[1] + A[8] * s[4];
    const V m20 = A[0] * s[5] + A[3] * s[4] + A[6] * s[2];
    const V m21 = A[1] * s[5] + A[4] * s[4] + A[7] * s[2];
    const V m22 = A[2] * s[5] + A[5] * s[4] + A[8] * s[2];
    out[0] = A[0] * m00 + A[3] * m10 + A[6] * m20;
    out[1] = A[1] * m01 + A[4] * m11 + A[7] * m21;
    out[2] = 0.5 * (A[2] * m02 + A[5] * m12 + A[8] * m22);
    out[3] = A[0] * m01 + A[3] * m11 + A[6] * m21;
    out[4] = A[1] * m02 + A[4] * m12 + A[7] * m22;
    out[5] = A[0] * m02 + A[3] * m12 + A[6] * m22;
  }
};

}  // namespace detail

/// Green-Lagrange strain in Cartesian components, from the changes h of the vectors, the vectors G at rest
/// ([component][vector]) and the contravariant base A ([component][direction]).
template <class T>
ATRAPOS_FORCEINLINE taylor::Symmetric3<T> shellStrain(const ShellBase<T>& h, const taylor::Passive<T>* G,
                                                      const taylor::Passive<T>* A) {
  taylor::Symmetric3<T> linear, products, E;
  taylor::detail::linear(detail::ShellLinearStrain<taylor::Passive<T>>{G}, h, linear);
  taylor::detail::bilinear<detail::ShellProductTerms>(h, h, products);
  const taylor::Symmetric3<T> convected = linear + 0.5 * products;
  taylor::detail::linear(detail::ToCartesian<taylor::Passive<T>>{A}, convected, E);
  return E;
}

/// Work conjugates of h for the second Piola-Kirchhoff stress S (Cartesian).
template <class T>
ATRAPOS_FORCEINLINE ShellBase<T> shellForces(const ShellBase<T>& h, const taylor::Symmetric3<T>& S,
                                             const taylor::Passive<T>* G, const taylor::Passive<T>* A) {
  taylor::Symmetric3<T> convected;
  taylor::detail::linear(detail::ToConvected<taylor::Passive<T>>{A}, S, convected);
  ShellBase<T> constant, product, f;
  taylor::detail::linear(detail::ShellLinearForce<taylor::Passive<T>>{G}, convected, constant);
  taylor::detail::bilinear<detail::ShellForceTerms>(h, convected, product);
  taylor::detail::linear(taylor::detail::Plus<12>{}, constant, product, f);
  return f;
}

}  // namespace atrapos::solid
