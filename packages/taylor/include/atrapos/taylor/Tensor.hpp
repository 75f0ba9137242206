#pragma once

#include "atrapos/taylor/Bilinear.hpp"
#include "atrapos/taylor/TensorTerms.hpp"

/// Second-order tensors in three dimensions for laws, over double, Sacado Fad types and Sweep. A product of
/// tensors is evaluated in one loop over the orders for all its entries, and the entries keep their histories
/// side by side: the way to write a material law. Entries are read by (i, j) and written by set.
namespace atrapos::taylor {

namespace detail {

/// N entries of a scalar that is not Sweep.
template <class T, int N>
struct Values {
  T v[N];
  Values() = default;
  ATRAPOS_FORCEINLINE explicit Values(const T* a) {
    for (int n = 0; n < N; ++n) v[n] = a[n];
  }
  ATRAPOS_FORCEINLINE const T& entry(int n) const { return v[n]; }
  ATRAPOS_FORCEINLINE void set(int n, const T& a) { v[n] = a; }
};

template <class T, int N>
struct StorageOf {
  using Type = Values<T, N>;
};
template <class X, int N>
struct StorageOf<Sweep<X>, N> {
  using Type = Block<X, N>;
};

template <class T, int N>
struct Tensor : StorageOf<T, N>::Type {
  using Storage = typename StorageOf<T, N>::Type;
  Tensor() = default;
  ATRAPOS_FORCEINLINE explicit Tensor(const T* a) : Storage(a) {}

  /// The entries as variables: a law's outputs.
  ATRAPOS_FORCEINLINE void store(T* out) const {
    ATRAPOS_UNROLL
    for (int n = 0; n < N; ++n) out[n] = this->entry(n);
  }
};

}  // namespace detail

/// 3 x 3 entries by rows.
template <class T>
struct Matrix3 : detail::Tensor<T, 9> {
  using Base = detail::Tensor<T, 9>;
  Matrix3() = default;
  /// From nine variables by rows.
  ATRAPOS_FORCEINLINE explicit Matrix3(const T* rows) : Base(rows) {}
  using Base::set;
  ATRAPOS_FORCEINLINE T operator()(int i, int j) const { return this->entry(3 * i + j); }
  ATRAPOS_FORCEINLINE void set(int i, int j, const T& a) { Base::set(3 * i + j, a); }
};

/// Symmetric, six entries: xx yy zz xy yz zx.
template <class T>
struct Symmetric3 : detail::Tensor<T, 6> {
  using Base = detail::Tensor<T, 6>;
  Symmetric3() = default;
  /// From six variables, xx yy zz xy yz zx.
  ATRAPOS_FORCEINLINE explicit Symmetric3(const T* entries) : Base(entries) {}
  using Base::set;
  ATRAPOS_FORCEINLINE T operator()(int i, int j) const { return this->entry(symmetricIndex(i, j)); }
  ATRAPOS_FORCEINLINE void set(int i, int j, const T& a) { Base::set(symmetricIndex(i, j), a); }
};

namespace detail {

// Linear maps of the entries, the same for values of any scalar and for coefficients.

struct SymmetricPart {
  template <class V>
  ATRAPOS_FORCEINLINE void operator()(const V* a, V* out) const {
    out[0] = a[0];
    out[1] = a[4];
    out[2] = a[8];
    out[3] = 0.5 * (a[1] + a[3]);
    out[4] = 0.5 * (a[5] + a[7]);
    out[5] = 0.5 * (a[2] + a[6]);
  }
};

struct Full {
  template <class V>
  ATRAPOS_FORCEINLINE void operator()(const V* a, V* out) const {
    ATRAPOS_UNROLL
    for (int m = 0; m < 9; ++m) out[m] = a[symmetricIndex(m / 3, m % 3)];
  }
};

struct Transpose {
  template <class V>
  ATRAPOS_FORCEINLINE void operator()(const V* a, V* out) const {
    ATRAPOS_UNROLL
    for (int m = 0; m < 9; ++m) out[m] = a[3 * (m % 3) + m / 3];
  }
};

/// Diagonal entries lie Step apart: 1 in a symmetric tensor, 4 in a matrix.
template <int Step>
struct Trace {
  template <class V>
  ATRAPOS_FORCEINLINE void operator()(const V* a, V* out) const {
    out[0] = a[0] + a[Step] + a[2 * Step];
  }
};

template <class S, int N>
struct Scale {
  S factor;
  template <class V>
  ATRAPOS_FORCEINLINE void operator()(const V* a, V* out) const {
    ATRAPOS_UNROLL
    for (int n = 0; n < N; ++n) out[n] = factor * a[n];
  }
};

template <int N>
struct Plus {
  template <class V>
  ATRAPOS_FORCEINLINE void operator()(const V* a, const V* b, V* out) const {
    ATRAPOS_UNROLL
    for (int n = 0; n < N; ++n) out[n] = a[n] + b[n];
  }
};

template <int N>
struct Minus {
  template <class V>
  ATRAPOS_FORCEINLINE void operator()(const V* a, const V* b, V* out) const {
    ATRAPOS_UNROLL
    for (int n = 0; n < N; ++n) out[n] = a[n] - b[n];
  }
};

template <int Step, int N>
struct PlusIdentity {
  template <class V>
  ATRAPOS_FORCEINLINE void operator()(const V* a, const V* s, V* out) const {
    ATRAPOS_UNROLL
    for (int n = 0; n < N; ++n) {
      if (n % Step == 0 && n <= 2 * Step)
        out[n] = a[n] + s[0];
      else
        out[n] = a[n];
    }
  }
};

/// g (x) g times a scalar, for a passive vector g
template <class S>
struct Dyad {
  S g[3];
  template <class V>
  ATRAPOS_FORCEINLINE void operator()(const V* a, const V* s, V* out) const {
    ATRAPOS_UNROLL
    for (int i = 0; i < 3; ++i) {
      out[i] = a[i] + (g[i] * g[i]) * s[0];
      out[3 + i] = a[3 + i] + (g[i] * g[(i + 1) % 3]) * s[0];
    }
  }
};

/// g . A g
template <class S>
struct Projection {
  S g[3];
  template <class V>
  ATRAPOS_FORCEINLINE void operator()(const V* a, V* out) const {
    out[0] = (g[0] * g[0]) * a[0] + (g[1] * g[1]) * a[1] + (g[2] * g[2]) * a[2] +
             (2.0 * (g[0] * g[1])) * a[3] + (2.0 * (g[1] * g[2])) * a[4] + (2.0 * (g[2] * g[0])) * a[5];
  }
};

template <class Map, class T, int M, int N>
ATRAPOS_FORCEINLINE void linear(const Map& map, const Values<T, M>& a, Values<T, N>& out) {
  map(a.v, out.v);
}
template <class Map, class T, int M, int K, int N>
ATRAPOS_FORCEINLINE void linear(const Map& map, const Values<T, M>& a, const Values<T, K>& b,
                                Values<T, N>& out) {
  map(a.v, b.v, out.v);
}
template <class Map, class X, int M, int N>
ATRAPOS_FORCEINLINE void linear(const Map& map, const Block<X, M>& a, Block<X, N>& out) {
  map(a.v, out.v);
  out.context = a.context;
  out.zero = a.zero;
}
template <class Map, class X, int M, int K, int N>
ATRAPOS_FORCEINLINE void linear(const Map& map, const Block<X, M>& a, const Block<X, K>& b,
                                Block<X, N>& out) {
  out.context = a.context != nullptr ? a.context : b.context;
  if (out.context == nullptr || (a.counts() && b.counts())) {
    map(a.v, b.v, out.v);
    return;
  }
  Block<X, M> x;
  Block<X, K> y;
  ATRAPOS_UNROLL
  for (int n = 0; n < M; ++n) x.v[n] = a.counts() ? a.v[n] : LanesOf<X>(0.0);
  ATRAPOS_UNROLL
  for (int n = 0; n < K; ++n) y.v[n] = b.counts() ? b.v[n] : LanesOf<X>(0.0);
  map(x.v, y.v, out.v);
}

template <class Terms, class T, int M, int N>
ATRAPOS_FORCEINLINE void bilinear(const Values<T, M>& a, const Values<T, N>& b,
                                  Values<T, Terms::numOut>& out) {
  ATRAPOS_UNROLL
  for (int n = 0; n < Terms::numOut; ++n) out.v[n] = T(0.0);
  addTerms<Terms>(a.v, b.v, out.v, TermIndices<Terms>());
}

template <class T>
using Scalar = Tensor<T, 1>;

}  // namespace detail

#define ATRAPOS_TENSORS(TENSOR, N)                                                   \
  template <class T>                                                                 \
  ATRAPOS_FORCEINLINE TENSOR<T> operator+(const TENSOR<T>& A, const TENSOR<T>& B) {  \
    TENSOR<T> C;                                                                     \
    detail::linear(detail::Plus<N>{}, A, B, C);                                      \
    return C;                                                                        \
  }                                                                                  \
  template <class T>                                                                 \
  ATRAPOS_FORCEINLINE TENSOR<T> operator-(const TENSOR<T>& A, const TENSOR<T>& B) {  \
    TENSOR<T> C;                                                                     \
    detail::linear(detail::Minus<N>{}, A, B, C);                                     \
    return C;                                                                        \
  }                                                                                  \
  template <class T>                                                                 \
  ATRAPOS_FORCEINLINE TENSOR<T> operator*(const Passive<T>& s, const TENSOR<T>& A) { \
    TENSOR<T> C;                                                                     \
    detail::linear(detail::Scale<Passive<T>, N>{s}, A, C);                           \
    return C;                                                                        \
  }                                                                                  \
  template <class T>                                                                 \
  ATRAPOS_FORCEINLINE TENSOR<T> scaled(const TENSOR<T>& A, const T& s) {             \
    TENSOR<T> C;                                                                     \
    detail::bilinear<detail::ScaledTerms<N>>(A, detail::Scalar<T>(&s), C);           \
    return C;                                                                        \
  }

/// Sums, differences, a passive factor, and scaled(A, s): every entry times one variable.
ATRAPOS_TENSORS(Matrix3, 9)
ATRAPOS_TENSORS(Symmetric3, 6)
#undef ATRAPOS_TENSORS

/// (A + A^T)/2
template <class T>
ATRAPOS_FORCEINLINE Symmetric3<T> symmetricPart(const Matrix3<T>& A) {
  Symmetric3<T> S;
  detail::linear(detail::SymmetricPart{}, A, S);
  return S;
}

/// The same entries as a full matrix.
template <class T>
ATRAPOS_FORCEINLINE Matrix3<T> full(const Symmetric3<T>& S) {
  Matrix3<T> A;
  detail::linear(detail::Full{}, S, A);
  return A;
}

template <class T>
ATRAPOS_FORCEINLINE T trace(const Symmetric3<T>& S) {
  detail::Scalar<T> t;
  detail::linear(detail::Trace<1>{}, S, t);
  return t.entry(0);
}
template <class T>
ATRAPOS_FORCEINLINE T trace(const Matrix3<T>& A) {
  detail::Scalar<T> t;
  detail::linear(detail::Trace<4>{}, A, t);
  return t.entry(0);
}

template <class T>
ATRAPOS_FORCEINLINE Matrix3<T> transpose(const Matrix3<T>& A) {
  Matrix3<T> B;
  detail::linear(detail::Transpose{}, A, B);
  return B;
}

/// The tensor plus s I.
template <class T>
ATRAPOS_FORCEINLINE Symmetric3<T> plusIdentity(const Symmetric3<T>& S, const T& s) {
  Symmetric3<T> C;
  detail::linear(detail::PlusIdentity<1, 6>{}, S, detail::Scalar<T>(&s), C);
  return C;
}
template <class T>
ATRAPOS_FORCEINLINE Matrix3<T> plusIdentity(const Matrix3<T>& A, const T& s) {
  Matrix3<T> C;
  detail::linear(detail::PlusIdentity<4, 9>{}, A, detail::Scalar<T>(&s), C);
  return C;
}

/// S + s g (x) g with a passive vector g[3].
template <class T>
ATRAPOS_FORCEINLINE Symmetric3<T> plusDyad(const Symmetric3<T>& S, const T& s, const Passive<T>* g) {
  Symmetric3<T> C;
  detail::linear(detail::Dyad<Passive<T>>{{g[0], g[1], g[2]}}, S, detail::Scalar<T>(&s), C);
  return C;
}

/// g . S g with a passive vector g[3].
template <class T>
ATRAPOS_FORCEINLINE T projection(const Symmetric3<T>& S, const Passive<T>* g) {
  detail::Scalar<T> s;
  detail::linear(detail::Projection<Passive<T>>{{g[0], g[1], g[2]}}, S, s);
  return s.entry(0);
}

/// A^T A
template <class T>
ATRAPOS_FORCEINLINE Symmetric3<T> gramian(const Matrix3<T>& A) {
  Symmetric3<T> G;
  detail::bilinear<detail::GramianTerms>(A, A, G);
  return G;
}

template <class T>
ATRAPOS_FORCEINLINE Matrix3<T> operator*(const Matrix3<T>& A, const Matrix3<T>& B) {
  Matrix3<T> C;
  detail::bilinear<detail::ProductTerms>(A, B, C);
  return C;
}

template <class T>
ATRAPOS_FORCEINLINE Matrix3<T> operator*(const Matrix3<T>& A, const Symmetric3<T>& S) {
  Matrix3<T> C;
  detail::bilinear<detail::SymmetricProductTerms>(A, S, C);
  return C;
}

/// det(A) A^-T
template <class T>
ATRAPOS_FORCEINLINE Matrix3<T> cofactor(const Matrix3<T>& A) {
  Matrix3<T> C;
  detail::bilinear<detail::CofactorTerms>(A, A, C);
  return C;
}

/// det(S) S^-1
template <class T>
ATRAPOS_FORCEINLINE Symmetric3<T> cofactor(const Symmetric3<T>& S) {
  Symmetric3<T> C;
  detail::bilinear<detail::SymmetricCofactorTerms>(S, S, C);
  return C;
}

/// det(A) from A and its cofactor.
template <class T>
ATRAPOS_FORCEINLINE T determinant(const Matrix3<T>& A, const Matrix3<T>& cof) {
  detail::Scalar<T> d;
  detail::bilinear<detail::DeterminantTerms>(A, cof, d);
  return d.entry(0);
}
template <class T>
ATRAPOS_FORCEINLINE T determinant(const Symmetric3<T>& S, const Symmetric3<T>& cof) {
  detail::Scalar<T> d;
  detail::bilinear<detail::SymmetricDeterminantTerms>(S, cof, d);
  return d.entry(0);
}

/// A : B
template <class T>
ATRAPOS_FORCEINLINE T contraction(const Symmetric3<T>& A, const Symmetric3<T>& B) {
  detail::Scalar<T> d;
  detail::bilinear<detail::ContractionTerms>(A, B, d);
  return d.entry(0);
}

}  // namespace atrapos::taylor
