#pragma once

#include "atrapos/taylor/Power.hpp"

namespace atrapos::taylor {

namespace detail {

// c c = a: c_k = (a_k - sum_{i=1..k-1} c_i c_{k-i}) / (2 c_0); c0 counts in Start only.
template <class X>
KOKKOS_INLINE_FUNCTION Sweep<X> squareRoot(const Sweep<X>& a, const LanesOf<X>& c0) {
  Context<X::lanes>& context = *a.context();
  double* cs = takeSlots<X>(context);
  LanesOf<X> c;
  if (X::pass == Pass::Start) {
    c = c0;
  } else {
    c = a.value();
    if (X::pass == Pass::Sweep) c -= convolveSquare<X::lanes>(cs, context.stride, context.order);
    c /= 2.0 * LanesOf<X>::load(cs);
  }
  record<X::pass>(context, cs, c);
  return {c, &context, cs};
}

}  // namespace detail

/// Defined for a_0 > 0 (a constant: a >= 0).
template <class E, class X>
KOKKOS_INLINE_FUNCTION Sweep<X> sqrt(const Expression<E, X>& e) {
  const Sweep<X> a(detail::variable(e.self()));
  if (a.isPassive()) return {sqrt(a.value())};
  LanesOf<X> c0(0.0);
  if (detail::isStart(a))
    c0 = detail::restrictTo(*a.context(), Operation::Sqrt, a.value(), sqrt(a.value()),
                            [](double x) { return x > 0; });
  return detail::squareRoot(a, c0);
}

/// a^(1/3), negative where a is. Defined for a_0 != 0.
template <class E, class X>
KOKKOS_INLINE_FUNCTION Sweep<X> cbrt(const Expression<E, X>& e) {
  const auto& a = detail::variable(e.self());
  if (a.isPassive()) return {cbrt(a.value())};
  LanesOf<X> c0(0.0);
  if (detail::isStart(a))
    c0 = detail::restrictTo(*a.context(), Operation::Cbrt, a.value(), cbrt(a.value()),
                            [](double x) { return x != 0; });
  return detail::powerSeries(a, c0, 1.0 / 3.0);
}

/// sqrt(a^2 + b^2), order 0 without overflow. Defined where a_0 and b_0 do not both vanish.
template <class A, class B, class X>
KOKKOS_INLINE_FUNCTION Sweep<X> hypot(const Expression<A, X>& ea, const Expression<B, X>& eb) {
  const auto& a = detail::variable(ea.self());
  const auto& b = detail::variable(eb.self());
  const Sweep<X> squares = a * a + b * b;
  if (squares.isPassive()) return {hypot(a.value(), b.value())};
  LanesOf<X> c0(0.0);
  if (detail::isStart(squares)) {
    const LanesOf<X> length = hypot(a.value(), b.value());
    c0 = detail::restrictTo(*squares.context(), Operation::Hypot, length, length,
                            [](double x) { return x > 0; });
  }
  return detail::squareRoot(squares, c0);
}
template <class E, class X>
KOKKOS_INLINE_FUNCTION Sweep<X> hypot(const Expression<E, X>& a, const LanesOf<X>& b) {
  return hypot(a, Sweep<X>(b));
}
template <class E, class X>
KOKKOS_INLINE_FUNCTION Sweep<X> hypot(const LanesOf<X>& a, const Expression<E, X>& b) {
  return hypot(Sweep<X>(a), b);
}

}  // namespace atrapos::taylor
