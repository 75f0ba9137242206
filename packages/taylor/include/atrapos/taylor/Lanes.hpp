#pragma once

#include <Kokkos_Macros.hpp>
#include <cmath>

// Requests to the compiler: unroll a short loop over the entries of a local array (left to itself it keeps
// the array in memory), and inline all calls of a function.
#if defined(__clang__)
#define ATRAPOS_UNROLL _Pragma("unroll")
#define ATRAPOS_FLATTEN __attribute__((flatten))
#elif defined(__GNUC__)
#define ATRAPOS_UNROLL _Pragma("GCC unroll 16")
#define ATRAPOS_FLATTEN __attribute__((flatten))
#else
#define ATRAPOS_UNROLL
#define ATRAPOS_FLATTEN
#endif

namespace atrapos::taylor {

namespace detail {

// GCC's and Clang's vector types keep L doubles in registers whatever the width of the instruction set;
// loops over an array are at the mercy of the unroller.
#if defined(__GNUC__) && !defined(__CUDACC__) && !defined(__HIPCC__)
template <int L>
struct VectorOf {
  typedef double Type __attribute__((vector_size(8 * L)));
  typedef double Memory __attribute__((vector_size(8 * L), aligned(8), may_alias));
  typedef double Entry __attribute__((may_alias));  ///< one lane within a vector
};
#else
template <int L>
struct VectorOf {
  struct Type {
    double e[L];
  };
  using Memory = Type;
  using Entry = double;
};

#define ATRAPOS_VECTOR_OPERATOR(OP)                                                      \
  template <class V>                                                                     \
  KOKKOS_FORCEINLINE_FUNCTION auto operator OP(V a, const V& b)->decltype(a.e[0], V()) { \
    for (unsigned l = 0; l < sizeof(V) / 8; ++l) a.e[l] = a.e[l] OP b.e[l];              \
    return a;                                                                            \
  }
ATRAPOS_VECTOR_OPERATOR(+)
ATRAPOS_VECTOR_OPERATOR(-)
ATRAPOS_VECTOR_OPERATOR(*)
ATRAPOS_VECTOR_OPERATOR(/)
#undef ATRAPOS_VECTOR_OPERATOR
template <class V>
KOKKOS_FORCEINLINE_FUNCTION auto operator-(double s, V a) -> decltype(a.e[0], V()) {
  for (unsigned l = 0; l < sizeof(V) / 8; ++l) a.e[l] = s - a.e[l];
  return a;
}
template <class V>
KOKKOS_FORCEINLINE_FUNCTION auto operator-(V a) -> decltype(a.e[0], V()) {
  for (unsigned l = 0; l < sizeof(V) / 8; ++l) a.e[l] = -a.e[l];
  return a;
}
#endif

}  // namespace detail

/// One double per point for L points that are computed together in a SIMD register.
/// All operations act lane by lane; L is a power of two.
template <int L>
struct Lanes {
  static_assert(L > 0 && (L & (L - 1)) == 0, "the number of lanes is a power of two");
  static constexpr int size = L;
  using Vector = typename detail::VectorOf<L>::Type;
  using Entry = typename detail::VectorOf<L>::Entry;

  alignas(8 * L) Vector v;

  Lanes() = default;  ///< uninitialised, like a double; Lanes<L>{} is zero
  KOKKOS_FORCEINLINE_FUNCTION Lanes(double s) : v(s - Vector{}) {}
  KOKKOS_FORCEINLINE_FUNCTION explicit Lanes(const Vector& a) : v(a) {}
  KOKKOS_FORCEINLINE_FUNCTION Entry& operator[](int l) { return reinterpret_cast<Entry*>(&v)[l]; }
  KOKKOS_FORCEINLINE_FUNCTION const Entry& operator[](int l) const {
    return reinterpret_cast<const Entry*>(&v)[l];
  }

  /// L consecutive doubles; any alignment of a double will do.
  static KOKKOS_FORCEINLINE_FUNCTION Lanes load(const double* p) {
    return Lanes(Vector(*reinterpret_cast<const typename detail::VectorOf<L>::Memory*>(p)));
  }
  KOKKOS_FORCEINLINE_FUNCTION void store(double* p) const {
    *reinterpret_cast<typename detail::VectorOf<L>::Memory*>(p) = v;
  }
};

#define ATRAPOS_LANES_OPERATOR(OP)                                                         \
  template <int L>                                                                         \
  KOKKOS_FORCEINLINE_FUNCTION Lanes<L> operator OP(const Lanes<L>& a, const Lanes<L>& b) { \
    return Lanes<L>(a.v OP b.v);                                                           \
  }                                                                                        \
  template <int L>                                                                         \
  KOKKOS_FORCEINLINE_FUNCTION Lanes<L> operator OP(const Lanes<L>& a, double b) {          \
    return a OP Lanes<L>(b);                                                               \
  }                                                                                        \
  template <int L>                                                                         \
  KOKKOS_FORCEINLINE_FUNCTION Lanes<L> operator OP(double a, const Lanes<L>& b) {          \
    return Lanes<L>(a) OP b;                                                               \
  }                                                                                        \
  template <int L>                                                                         \
  KOKKOS_FORCEINLINE_FUNCTION Lanes<L>& operator OP##=(Lanes<L>& a, const Lanes<L>& b) {   \
    return a = a OP b;                                                                     \
  }                                                                                        \
  template <int L>                                                                         \
  KOKKOS_FORCEINLINE_FUNCTION Lanes<L>& operator OP##=(Lanes<L>& a, double b) {            \
    return a = a OP b;                                                                     \
  }

ATRAPOS_LANES_OPERATOR(+)
ATRAPOS_LANES_OPERATOR(-)
ATRAPOS_LANES_OPERATOR(*)
ATRAPOS_LANES_OPERATOR(/)
#undef ATRAPOS_LANES_OPERATOR

template <int L>
KOKKOS_FORCEINLINE_FUNCTION Lanes<L> operator+(const Lanes<L>& a) {
  return a;
}

template <int L>
KOKKOS_FORCEINLINE_FUNCTION Lanes<L> operator-(const Lanes<L>& a) {
  return Lanes<L>(-a.v);
}

#define ATRAPOS_LANES_FUNCTION(NAME)                        \
  template <int L>                                          \
  KOKKOS_INLINE_FUNCTION Lanes<L> NAME(const Lanes<L>& a) { \
    Lanes<L> r;                                             \
    for (int l = 0; l < L; ++l) r[l] = std::NAME(a[l]);     \
    return r;                                               \
  }

ATRAPOS_LANES_FUNCTION(sqrt)
ATRAPOS_LANES_FUNCTION(cbrt)
ATRAPOS_LANES_FUNCTION(exp)
ATRAPOS_LANES_FUNCTION(expm1)
ATRAPOS_LANES_FUNCTION(log)
ATRAPOS_LANES_FUNCTION(log10)
ATRAPOS_LANES_FUNCTION(log1p)
ATRAPOS_LANES_FUNCTION(sin)
ATRAPOS_LANES_FUNCTION(cos)
ATRAPOS_LANES_FUNCTION(tan)
ATRAPOS_LANES_FUNCTION(asin)
ATRAPOS_LANES_FUNCTION(acos)
ATRAPOS_LANES_FUNCTION(atan)
ATRAPOS_LANES_FUNCTION(sinh)
ATRAPOS_LANES_FUNCTION(cosh)
ATRAPOS_LANES_FUNCTION(tanh)
ATRAPOS_LANES_FUNCTION(asinh)
ATRAPOS_LANES_FUNCTION(acosh)
ATRAPOS_LANES_FUNCTION(atanh)
ATRAPOS_LANES_FUNCTION(erf)
ATRAPOS_LANES_FUNCTION(fabs)
#undef ATRAPOS_LANES_FUNCTION

#define ATRAPOS_LANES_FUNCTION(NAME)                                           \
  template <int L>                                                             \
  KOKKOS_INLINE_FUNCTION Lanes<L> NAME(const Lanes<L>& a, const Lanes<L>& b) { \
    Lanes<L> r;                                                                \
    for (int l = 0; l < L; ++l) r[l] = std::NAME(a[l], b[l]);                  \
    return r;                                                                  \
  }

ATRAPOS_LANES_FUNCTION(pow)
ATRAPOS_LANES_FUNCTION(atan2)
ATRAPOS_LANES_FUNCTION(hypot)
ATRAPOS_LANES_FUNCTION(fmin)
ATRAPOS_LANES_FUNCTION(fmax)
#undef ATRAPOS_LANES_FUNCTION

}  // namespace atrapos::taylor
