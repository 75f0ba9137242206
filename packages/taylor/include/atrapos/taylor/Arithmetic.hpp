#pragma once

#include "atrapos/taylor/Sweep.hpp"

/// + - * / of Sweep with Sweep, double and Lanes. Sources: docs/theory/taylor.md, one heading per operation.
namespace atrapos::taylor {

namespace detail {

// c_k = sum_{i=0..k} a_i b_{k-i}
template <int L>
KOKKOS_INLINE_FUNCTION Sweep<L> product(const Sweep<L>& a, const Sweep<L>& b) {
  Context<L>& context = *a.context();
  const double* as = a.slot();
  const double* bs = b.slot();
  switch (context.pass) {
    case Pass::Start:
      return {a.value() * b.value(), &context};
    case Pass::Sweep:
      return {as == bs ? convolveSquare<L>(as, 0, context.order)
                       : convolve<L>(as, bs, 0, context.order, context.order),
              &context};
    default:
      return {a.value() * load<L>(bs) + load<L>(as) * b.value(), &context};
  }
}

// c_k = (a_k - sum_{i=1..k} b_i c_{k-i}) / b_0; ak is the coefficient of a in the current pass.
template <int L>
KOKKOS_INLINE_FUNCTION Sweep<L> quotient(const Lanes<L>& ak, const Sweep<L>& b) {
  Context<L>& context = *b.context();
  const double* bs = b.slot();
  double* cs = takeSlot(context);
  Lanes<L> c;
  switch (context.pass) {
    case Pass::Start:
      c = ak / b.value();
      break;
    case Pass::Sweep:
      c = (ak - convolve<L>(bs, cs, 1, context.order, context.order)) / load<L>(bs);
      break;
    default:
      c = (ak - load<L>(cs) * b.value()) / load<L>(bs);
  }
  record(context, cs, c);
  return {c, &context, cs};
}

}  // namespace detail

template <int L>
KOKKOS_FORCEINLINE_FUNCTION Sweep<L> operator+(const Sweep<L>& a) {
  return a;
}

template <int L>
KOKKOS_FORCEINLINE_FUNCTION Sweep<L> operator-(const Sweep<L>& a) {
  return {-a.value(), a.context()};
}

// A constant added to an active value counts in Start only. The sum never keeps its operand's slot, not even
// where it equals it: the slots given away must be the same in every pass.
template <int L>
KOKKOS_FORCEINLINE_FUNCTION Sweep<L> operator+(const Sweep<L>& a, const Lanes<L>& b) {
  if (!a.isPassive() && a.context()->pass != Pass::Start) return {a.value(), a.context()};
  return {a.value() + b, a.context()};
}

template <int L>
KOKKOS_FORCEINLINE_FUNCTION Sweep<L> operator*(const Sweep<L>& a, const Lanes<L>& b) {
  return {a.value() * b, a.context()};
}

template <int L>
KOKKOS_FORCEINLINE_FUNCTION Sweep<L> operator/(const Sweep<L>& a, const Lanes<L>& b) {
  return {a.value() / b, a.context()};
}

template <int L>
KOKKOS_FORCEINLINE_FUNCTION Sweep<L> operator-(const Sweep<L>& a, const Lanes<L>& b) {
  return a + (-b);
}

template <int L>
KOKKOS_FORCEINLINE_FUNCTION Sweep<L> operator+(const Lanes<L>& a, const Sweep<L>& b) {
  return b + a;
}

template <int L>
KOKKOS_FORCEINLINE_FUNCTION Sweep<L> operator-(const Lanes<L>& a, const Sweep<L>& b) {
  return -b + a;
}

template <int L>
KOKKOS_FORCEINLINE_FUNCTION Sweep<L> operator*(const Lanes<L>& a, const Sweep<L>& b) {
  return b * a;
}

template <int L>
KOKKOS_FORCEINLINE_FUNCTION Sweep<L> operator/(const Lanes<L>& a, const Sweep<L>& b) {
  if (b.isPassive()) return {a / b.value()};
  return detail::quotient(b.context()->pass == Pass::Start ? a : Lanes<L>(0.0), b);
}

#define ATRAPOS_SWEEP_WITH_DOUBLE(OP)                                             \
  template <int L>                                                                \
  KOKKOS_FORCEINLINE_FUNCTION Sweep<L> operator OP(const Sweep<L>& a, double b) { \
    return a OP Lanes<L>(b);                                                      \
  }                                                                               \
  template <int L>                                                                \
  KOKKOS_FORCEINLINE_FUNCTION Sweep<L> operator OP(double a, const Sweep<L>& b) { \
    return Lanes<L>(a) OP b;                                                      \
  }

ATRAPOS_SWEEP_WITH_DOUBLE(+)
ATRAPOS_SWEEP_WITH_DOUBLE(-)
ATRAPOS_SWEEP_WITH_DOUBLE(*)
ATRAPOS_SWEEP_WITH_DOUBLE(/)
#undef ATRAPOS_SWEEP_WITH_DOUBLE

template <int L>
KOKKOS_FORCEINLINE_FUNCTION Sweep<L> operator+(const Sweep<L>& a, const Sweep<L>& b) {
  if (a.isPassive()) return b + a.value();
  if (b.isPassive()) return a + b.value();
  return {a.value() + b.value(), a.context()};
}

template <int L>
KOKKOS_FORCEINLINE_FUNCTION Sweep<L> operator-(const Sweep<L>& a, const Sweep<L>& b) {
  if (a.isPassive()) return a.value() - b;
  if (b.isPassive()) return a - b.value();
  return {a.value() - b.value(), a.context()};
}

template <int L>
KOKKOS_FORCEINLINE_FUNCTION Sweep<L> operator*(const Sweep<L>& a, const Sweep<L>& b) {
  if (a.isPassive()) return b * a.value();
  if (b.isPassive()) return a * b.value();
  return detail::product(a, b);
}

template <int L>
KOKKOS_FORCEINLINE_FUNCTION Sweep<L> operator/(const Sweep<L>& a, const Sweep<L>& b) {
  if (a.isPassive()) return a.value() / b;
  if (b.isPassive()) return a / b.value();
  return detail::quotient(a.value(), b);
}

}  // namespace atrapos::taylor
