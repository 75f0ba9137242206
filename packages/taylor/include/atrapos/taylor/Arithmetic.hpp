#pragma once

#include "atrapos/taylor/Sweep.hpp"

/// + - * / of expressions with expressions, double and Lanes. Sources: docs/theory/taylor.md, one heading per
/// operation.
namespace atrapos::taylor {

namespace detail {

// c_k = (a_k - b_k c_0 - sum_{i=1..k-1} b_i c_{k-i}) / b_0; ak is the coefficient of a in the current pass.
template <class X>
KOKKOS_INLINE_FUNCTION Sweep<X> quotient(const LanesOf<X>& ak, const Sweep<X>& b) {
  Context<X::lanes>& context = *b.context();
  const double* bs = b.slot();
  double* cs = takeSlots<X>(context);
  LanesOf<X> c;
  if (X::pass == Pass::Start) {
    c = restrictTo(context, Operation::Division, b.value(), ak / b.value(), [](double x) { return x != 0; });
  } else {
    c = ak - b.value() * LanesOf<X>::load(cs);
    if (X::pass == Pass::Sweep) c -= convolve<X::lanes>(bs, cs, context.stride, context.order);
    c /= LanesOf<X>::load(bs);
  }
  record<X::pass>(context, cs, c);
  return {c, &context, cs};
}

template <class E, class F, class X>
ATRAPOS_FORCEINLINE Scaled<E, F, X> scale(const Expression<E, X>& e, const F& factor) {
  return {e.self(), factor};
}
template <class E, class F, class G, class X>
ATRAPOS_FORCEINLINE auto scale(const Scaled<E, F, X>& e, const G& factor) {
  using FG = decltype(e.factor * factor);
  return Scaled<E, FG, X>(e.x, e.factor * factor);
}

// A factor of an operand becomes one of the product, so that the operand itself needs no history.
template <class A, class B, class X>
ATRAPOS_FORCEINLINE Product<A, B, X> multiply(const Expression<A, X>& a, const Expression<B, X>& b) {
  return {a.self(), b.self()};
}
template <class A, class F, class B, class X>
ATRAPOS_FORCEINLINE auto multiply(const Scaled<A, F, X>& a, const Expression<B, X>& b) {
  return scale<Product<A, B, X>, F, X>(Product<A, B, X>(a.x, b.self()), a.factor);
}
template <class A, class B, class F, class X>
ATRAPOS_FORCEINLINE auto multiply(const Expression<A, X>& a, const Scaled<B, F, X>& b) {
  return scale<Product<A, B, X>, F, X>(Product<A, B, X>(a.self(), b.x), b.factor);
}
template <class A, class F, class B, class G, class X>
ATRAPOS_FORCEINLINE auto multiply(const Scaled<A, F, X>& a, const Scaled<B, G, X>& b) {
  using FG = decltype(a.factor * b.factor);
  return scale<Product<A, B, X>, FG, X>(Product<A, B, X>(a.x, b.x), a.factor * b.factor);
}

}  // namespace detail

template <class E, class X>
ATRAPOS_FORCEINLINE auto operator+(const Expression<E, X>& a) {
  return detail::scale(a.self(), 1.0);
}

template <class E, class X>
ATRAPOS_FORCEINLINE auto operator-(const Expression<E, X>& a) {
  return detail::scale(a.self(), -1.0);
}

template <class A, class B, class X>
ATRAPOS_FORCEINLINE detail::Sum<A, B, 1, X> operator+(const Expression<A, X>& a, const Expression<B, X>& b) {
  return {a.self(), b.self()};
}

template <class A, class B, class X>
ATRAPOS_FORCEINLINE detail::Sum<A, B, -1, X> operator-(const Expression<A, X>& a, const Expression<B, X>& b) {
  return {a.self(), b.self()};
}

template <class A, class B, class X>
ATRAPOS_FORCEINLINE auto operator*(const Expression<A, X>& a, const Expression<B, X>& b) {
  return detail::multiply(a.self(), b.self());
}

template <class A, class B, class X>
ATRAPOS_FORCEINLINE Sweep<X> operator/(const Expression<A, X>& a, const Expression<B, X>& b) {
  const auto& divisor = detail::variable(b.self());
  Context<X::lanes>* own = a.self().context();
  if (divisor.isPassive()) return {detail::evaluate(a, own) / divisor.value(), own};
  return detail::quotient(detail::evaluate(a, own != nullptr ? own : divisor.context()), divisor);
}

#define ATRAPOS_EXPRESSION_WITH(PASSIVE)                                         \
  template <class E, class X>                                                    \
  ATRAPOS_FORCEINLINE auto operator+(const Expression<E, X>& a, PASSIVE b) {     \
    return a + detail::Constant<X>(b);                                           \
  }                                                                              \
  template <class E, class X>                                                    \
  ATRAPOS_FORCEINLINE auto operator+(PASSIVE a, const Expression<E, X>& b) {     \
    return b + detail::Constant<X>(a);                                           \
  }                                                                              \
  template <class E, class X>                                                    \
  ATRAPOS_FORCEINLINE auto operator-(const Expression<E, X>& a, PASSIVE b) {     \
    return a - detail::Constant<X>(b);                                           \
  }                                                                              \
  template <class E, class X>                                                    \
  ATRAPOS_FORCEINLINE auto operator-(PASSIVE a, const Expression<E, X>& b) {     \
    return detail::Constant<X>(a) - b;                                           \
  }                                                                              \
  template <class E, class X>                                                    \
  ATRAPOS_FORCEINLINE auto operator*(const Expression<E, X>& a, PASSIVE b) {     \
    return detail::scale(a.self(), b);                                           \
  }                                                                              \
  template <class E, class X>                                                    \
  ATRAPOS_FORCEINLINE auto operator*(PASSIVE a, const Expression<E, X>& b) {     \
    return detail::scale(b.self(), a);                                           \
  }                                                                              \
  template <class E, class X>                                                    \
  ATRAPOS_FORCEINLINE auto operator/(const Expression<E, X>& a, PASSIVE b) {     \
    return detail::scale(a.self(), 1.0 / b);                                     \
  }                                                                              \
  template <class E, class X>                                                    \
  ATRAPOS_FORCEINLINE Sweep<X> operator/(PASSIVE a, const Expression<E, X>& b) { \
    return Sweep<X>(a) / b;                                                      \
  }

ATRAPOS_EXPRESSION_WITH(double)
ATRAPOS_EXPRESSION_WITH(const LanesOf<X>&)
#undef ATRAPOS_EXPRESSION_WITH

}  // namespace atrapos::taylor
