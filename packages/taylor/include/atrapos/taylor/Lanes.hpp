#pragma once

#include <cmath>

#include "atrapos/taylor/FunctionMarks.hpp"

// Requests to the compiler: unroll a short loop over the entries of a local array (left to itself it keeps
// the array in memory), inline all calls of a function, and never inline a function, not even into one that
// inlines all calls.
#if defined(__clang__)
#define ATRAPOS_UNROLL _Pragma("unroll")
#elif defined(__GNUC__)
#define ATRAPOS_UNROLL _Pragma("GCC unroll 64")
#else
#define ATRAPOS_UNROLL
#endif
#if defined(__GNUC__)
#define ATRAPOS_FLATTEN __attribute__((flatten))
#define ATRAPOS_NOINLINE __attribute__((noinline))
#else
#define ATRAPOS_FLATTEN
#define ATRAPOS_NOINLINE
#endif

namespace atrapos::taylor {

/// Doubles in the widest SIMD register of the instruction set that is compiled for; 1 where none is known.
#if !defined(__GNUC__) || defined(__CUDACC__) || defined(__HIPCC__)
constexpr int nativeLanes = 1;
#elif defined(__AVX512F__)
constexpr int nativeLanes = 8;
#elif defined(__AVX__)
constexpr int nativeLanes = 4;
#else
constexpr int nativeLanes = 2;
#endif

namespace detail {

/// L doubles. Up to nativeLanes of them are one GCC or Clang vector, which stays in a register; more are two
/// halves: a vector wider than the registers would be worked on in memory.
template <int L, bool Fits = (L <= nativeLanes)>
struct VectorOf {
  struct Type {
    typename VectorOf<L / 2>::Type low, high;
  };
};
template <>
struct VectorOf<1, true> {
  using Type = double;
};
#if defined(__GNUC__)
template <int L>
struct VectorOf<L, true> {
  typedef double Type __attribute__((vector_size(8 * L)));
  // SSE's instructions read aligned operands from memory by themselves; wider ones do not mind.
  typedef double Memory __attribute__((vector_size(8 * L), aligned(16), may_alias));
};
typedef double Entry __attribute__((may_alias));  ///< one lane within a vector
#else
using Entry = double;
#endif

#define ATRAPOS_HALVES_OPERATOR(OP)                                                          \
  template <class V>                                                                         \
  ATRAPOS_FORCEINLINE auto operator OP(const V& a, const V& b)->decltype(V{a.low, b.high}) { \
    return {a.low OP b.low, a.high OP b.high};                                               \
  }
ATRAPOS_HALVES_OPERATOR(+)
ATRAPOS_HALVES_OPERATOR(-)
ATRAPOS_HALVES_OPERATOR(*)
ATRAPOS_HALVES_OPERATOR(/)
#undef ATRAPOS_HALVES_OPERATOR
template <class V>
ATRAPOS_FORCEINLINE auto operator-(const V& a) -> decltype(V{a.low, a.high}) {
  return {-a.low, -a.high};
}

/// What has no operator: by halves, down to registers.
template <int L>
struct Register {
  using Vector = typename VectorOf<L>::Type;
  using Half = Register<L / 2>;
  static constexpr bool fits = L <= nativeLanes;

  static ATRAPOS_FORCEINLINE Vector broadcast(double s) {
    if constexpr (fits)
      return s - Vector{};
    else
      return {Half::broadcast(s), Half::broadcast(s)};
  }
  static ATRAPOS_FORCEINLINE Vector load(const double* p) {
    if constexpr (L == 1)
      return *p;
    else if constexpr (fits)
      return *reinterpret_cast<const typename VectorOf<L>::Memory*>(p);
    else
      return {Half::load(p), Half::load(p + L / 2)};
  }
  static ATRAPOS_FORCEINLINE void store(const Vector& v, double* p) {
    if constexpr (L == 1) {
      *p = v;
    } else if constexpr (fits) {
      *reinterpret_cast<typename VectorOf<L>::Memory*>(p) = v;
    } else {
      Half::store(v.low, p);
      Half::store(v.high, p + L / 2);
    }
  }
  /// 1 where holds(a, b), 0 elsewhere; `holds` takes two doubles or two native vectors.
  template <class Compare>
  static ATRAPOS_FORCEINLINE Vector compare(const Vector& a, const Vector& b, const Compare& holds) {
    if constexpr (fits)
      return holds(a, b) ? broadcast(1.0) : broadcast(0.0);
    else
      return {Half::compare(a.low, b.low, holds), Half::compare(a.high, b.high, holds)};
  }
  /// yes where mask is not 0, no elsewhere.
  static ATRAPOS_FORCEINLINE Vector select(const Vector& mask, const Vector& yes, const Vector& no) {
    if constexpr (fits)
      return mask != broadcast(0.0) ? yes : no;
    else
      return {Half::select(mask.low, yes.low, no.low), Half::select(mask.high, yes.high, no.high)};
  }
  /// The value in a register: the compiler would load it again for each of its uses, which pays only where
  /// registers are scarce.
  static ATRAPOS_FORCEINLINE void hold([[maybe_unused]] Vector& v) {
#if defined(__AVX512F__) && !defined(__clang__)
    if constexpr (L == 8) asm("" : "+v"(v));
#endif
  }
};

}  // namespace detail

/// One double per point for L points that are computed together in SIMD registers.
/// All operations act lane by lane; L is a power of two. Native is part of the type so that programs may be
/// linked from parts that were compiled for different instruction sets.
template <int L, int Native = nativeLanes>
struct Lanes {
  static_assert(L > 0 && (L & (L - 1)) == 0, "the number of lanes is a power of two");
  static constexpr int size = L;
  using Register = detail::Register<L>;
  using Vector = typename Register::Vector;

  alignas(8 * L) Vector v;

  Lanes() = default;  ///< uninitialised, like a double; Lanes<L>{} is zero
  ATRAPOS_FORCEINLINE Lanes(double s) : v(Register::broadcast(s)) {}
  // Not a constructor: the vector of one lane is a double.
  static ATRAPOS_FORCEINLINE Lanes of(const Vector& a) {
    Lanes r;
    r.v = a;
    return r;
  }
  ATRAPOS_FORCEINLINE detail::Entry& operator[](int l) { return reinterpret_cast<detail::Entry*>(&v)[l]; }
  ATRAPOS_FORCEINLINE const detail::Entry& operator[](int l) const {
    return reinterpret_cast<const detail::Entry*>(&v)[l];
  }

  /// L consecutive doubles, aligned to 16 bytes where L > 1 (as malloc and new give them); to 8 L is fastest.
  static ATRAPOS_FORCEINLINE Lanes load(const double* p) { return of(Register::load(p)); }
  ATRAPOS_FORCEINLINE void store(double* p) const { Register::store(v, p); }
};

#define ATRAPOS_LANES_OPERATOR(OP)                                                 \
  template <int L>                                                                 \
  ATRAPOS_FORCEINLINE Lanes<L> operator OP(const Lanes<L>& a, const Lanes<L>& b) { \
    return Lanes<L>::of(a.v OP b.v);                                               \
  }                                                                                \
  template <int L>                                                                 \
  ATRAPOS_FORCEINLINE Lanes<L> operator OP(const Lanes<L>& a, double b) {          \
    return a OP Lanes<L>(b);                                                       \
  }                                                                                \
  template <int L>                                                                 \
  ATRAPOS_FORCEINLINE Lanes<L> operator OP(double a, const Lanes<L>& b) {          \
    return Lanes<L>(a) OP b;                                                       \
  }                                                                                \
  template <int L>                                                                 \
  ATRAPOS_FORCEINLINE Lanes<L>& operator OP##=(Lanes<L>& a, const Lanes<L>& b) {   \
    return a = a OP b;                                                             \
  }                                                                                \
  template <int L>                                                                 \
  ATRAPOS_FORCEINLINE Lanes<L>& operator OP##=(Lanes<L>& a, double b) {            \
    return a = a OP b;                                                             \
  }

ATRAPOS_LANES_OPERATOR(+)
ATRAPOS_LANES_OPERATOR(-)
ATRAPOS_LANES_OPERATOR(*)
ATRAPOS_LANES_OPERATOR(/)
#undef ATRAPOS_LANES_OPERATOR

template <int L>
ATRAPOS_FORCEINLINE Lanes<L> operator+(const Lanes<L>& a) {
  return a;
}

template <int L>
ATRAPOS_FORCEINLINE Lanes<L> operator-(const Lanes<L>& a) {
  return Lanes<L>::of(-a.v);
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
