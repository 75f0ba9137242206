#pragma once

#include <Kokkos_Macros.hpp>
#include <cmath>

namespace atrapos::taylor {

/// One double per point for L points that are computed together in a SIMD register.
/// All operations act lane by lane; L is a power of two.
template <int L>
struct alignas(8 * L) Lanes {
  static_assert(L > 0 && (L & (L - 1)) == 0, "the number of lanes is a power of two");
  static constexpr int size = L;

  double v[L];

  Lanes() = default;  ///< uninitialised, like a double; Lanes<L>{} is zero
  KOKKOS_FORCEINLINE_FUNCTION Lanes(double s) {
    for (int l = 0; l < L; ++l) v[l] = s;
  }
  KOKKOS_FORCEINLINE_FUNCTION double& operator[](int l) { return v[l]; }
  KOKKOS_FORCEINLINE_FUNCTION const double& operator[](int l) const { return v[l]; }
};

namespace detail {

// GCC's and Clang's vector types keep a value of L doubles in registers whatever the width of the
// instruction set; loops over v[l] are at the mercy of the unroller.
#if defined(__GNUC__) && !defined(__CUDACC__) && !defined(__HIPCC__)
template <int L>
struct Register {
  typedef double Type __attribute__((vector_size(8 * L)));
  typedef double Memory __attribute__((vector_size(8 * L), aligned(8), may_alias));

  Type r;

  static KOKKOS_FORCEINLINE_FUNCTION Register load(const double* p) {
    return {*reinterpret_cast<const Memory*>(p)};
  }
  static KOKKOS_FORCEINLINE_FUNCTION Register fill(double s) { return {s - Type{}}; }
  KOKKOS_FORCEINLINE_FUNCTION void store(double* p) const { *reinterpret_cast<Memory*>(p) = r; }
  KOKKOS_FORCEINLINE_FUNCTION Register operator+(const Register& b) const { return {r + b.r}; }
  KOKKOS_FORCEINLINE_FUNCTION Register operator-(const Register& b) const { return {r - b.r}; }
  KOKKOS_FORCEINLINE_FUNCTION Register operator*(const Register& b) const { return {r * b.r}; }
  KOKKOS_FORCEINLINE_FUNCTION Register operator/(const Register& b) const { return {r / b.r}; }
  KOKKOS_FORCEINLINE_FUNCTION Register operator-() const { return {-r}; }
};
#else
template <int L>
struct Register {
  double r[L];

  static KOKKOS_FORCEINLINE_FUNCTION Register load(const double* p) {
    Register a;
    for (int l = 0; l < L; ++l) a.r[l] = p[l];
    return a;
  }
  static KOKKOS_FORCEINLINE_FUNCTION Register fill(double s) {
    Register a;
    for (int l = 0; l < L; ++l) a.r[l] = s;
    return a;
  }
  KOKKOS_FORCEINLINE_FUNCTION void store(double* p) const {
    for (int l = 0; l < L; ++l) p[l] = r[l];
  }
  KOKKOS_FORCEINLINE_FUNCTION Register operator+(const Register& b) const {
    Register c;
    for (int l = 0; l < L; ++l) c.r[l] = r[l] + b.r[l];
    return c;
  }
  KOKKOS_FORCEINLINE_FUNCTION Register operator-(const Register& b) const {
    Register c;
    for (int l = 0; l < L; ++l) c.r[l] = r[l] - b.r[l];
    return c;
  }
  KOKKOS_FORCEINLINE_FUNCTION Register operator*(const Register& b) const {
    Register c;
    for (int l = 0; l < L; ++l) c.r[l] = r[l] * b.r[l];
    return c;
  }
  KOKKOS_FORCEINLINE_FUNCTION Register operator/(const Register& b) const {
    Register c;
    for (int l = 0; l < L; ++l) c.r[l] = r[l] / b.r[l];
    return c;
  }
  KOKKOS_FORCEINLINE_FUNCTION Register operator-() const {
    Register b;
    for (int l = 0; l < L; ++l) b.r[l] = -r[l];
    return b;
  }
};
#endif

template <int L>
KOKKOS_FORCEINLINE_FUNCTION Register<L> toRegister(const Lanes<L>& a) {
  return Register<L>::load(a.v);
}

template <int L>
KOKKOS_FORCEINLINE_FUNCTION Lanes<L> toLanes(const Register<L>& a) {
  Lanes<L> r;
  a.store(r.v);
  return r;
}

template <int L>
KOKKOS_FORCEINLINE_FUNCTION Lanes<L> load(const double* p) {
  return toLanes(Register<L>::load(p));
}

template <int L>
KOKKOS_FORCEINLINE_FUNCTION void store(double* p, const Lanes<L>& a) {
  toRegister(a).store(p);
}

}  // namespace detail

#define ATRAPOS_LANES_OPERATOR(OP)                                                         \
  template <int L>                                                                         \
  KOKKOS_FORCEINLINE_FUNCTION Lanes<L> operator OP(const Lanes<L>& a, const Lanes<L>& b) { \
    return detail::toLanes(detail::toRegister(a) OP detail::toRegister(b));                \
  }                                                                                        \
  template <int L>                                                                         \
  KOKKOS_FORCEINLINE_FUNCTION Lanes<L> operator OP(const Lanes<L>& a, double b) {          \
    return detail::toLanes(detail::toRegister(a) OP detail::Register<L>::fill(b));         \
  }                                                                                        \
  template <int L>                                                                         \
  KOKKOS_FORCEINLINE_FUNCTION Lanes<L> operator OP(double a, const Lanes<L>& b) {          \
    return detail::toLanes(detail::Register<L>::fill(a) OP detail::toRegister(b));         \
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
  return detail::toLanes(-detail::toRegister(a));
}

#define ATRAPOS_LANES_FUNCTION(NAME)                        \
  template <int L>                                          \
  KOKKOS_INLINE_FUNCTION Lanes<L> NAME(const Lanes<L>& a) { \
    Lanes<L> r;                                             \
    for (int l = 0; l < L; ++l) r.v[l] = std::NAME(a.v[l]); \
    return r;                                               \
  }

ATRAPOS_LANES_FUNCTION(sqrt)
ATRAPOS_LANES_FUNCTION(exp)
ATRAPOS_LANES_FUNCTION(log)
ATRAPOS_LANES_FUNCTION(sin)
ATRAPOS_LANES_FUNCTION(cos)
ATRAPOS_LANES_FUNCTION(tan)
ATRAPOS_LANES_FUNCTION(sinh)
ATRAPOS_LANES_FUNCTION(cosh)
ATRAPOS_LANES_FUNCTION(tanh)
ATRAPOS_LANES_FUNCTION(asin)
ATRAPOS_LANES_FUNCTION(acos)
ATRAPOS_LANES_FUNCTION(atan)
#undef ATRAPOS_LANES_FUNCTION

template <int L>
KOKKOS_INLINE_FUNCTION Lanes<L> pow(const Lanes<L>& a, double r) {
  Lanes<L> c;
  for (int l = 0; l < L; ++l) c.v[l] = std::pow(a.v[l], r);
  return c;
}

}  // namespace atrapos::taylor
