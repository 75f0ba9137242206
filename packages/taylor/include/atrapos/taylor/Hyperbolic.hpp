#pragma once

#include "atrapos/taylor/Roots.hpp"

namespace atrapos::taylor {

/// sinh and cosh of one argument at the price of either:
/// s_k = (1/k) sum_{i=1..k} i a_i c_{k-i},  c_k = (1/k) sum_{i=1..k} i a_i s_{k-i}
template <class E, class X>
KOKKOS_INLINE_FUNCTION void sinhCosh(const Expression<E, X>& e, Sweep<X>& sine, Sweep<X>& cosine) {
  const auto& a = detail::variable(e.self());
  const LanesOf<X> x = a.value();
  if (a.isPassive()) {
    sine = Sweep<X>(sinh(x));
    cosine = Sweep<X>(cosh(x));
    return;
  }
  LanesOf<X> s0(0.0), c0(0.0);
  if (detail::isStart(a)) {
    s0 = sinh(x);
    c0 = cosh(x);
  }
  detail::sinePair(a, s0, c0, 1.0, sine, cosine);
}

/// The same for double and Sacado types.
template <class T>
KOKKOS_INLINE_FUNCTION void sinhCosh(const T& a, T& sine, T& cosine) {
  using std::cosh;
  using std::sinh;
  const T x = a;
  sine = sinh(x);
  cosine = cosh(x);
}

template <class X>
KOKKOS_INLINE_FUNCTION void sinhCosh(const Sweep<X>& a, Sweep<X>& sine, Sweep<X>& cosine) {
  sinhCosh(static_cast<const Expression<Sweep<X>, X>&>(a), sine, cosine);
}

template <class E, class X>
KOKKOS_INLINE_FUNCTION Sweep<X> sinh(const Expression<E, X>& a) {
  Sweep<X> s, c;
  sinhCosh(a, s, c);
  return s;
}

template <class E, class X>
KOKKOS_INLINE_FUNCTION Sweep<X> cosh(const Expression<E, X>& a) {
  Sweep<X> s, c;
  sinhCosh(a, s, c);
  return c;
}

/// t' = (1 - t^2) a'
template <class E, class X>
KOKKOS_INLINE_FUNCTION Sweep<X> tanh(const Expression<E, X>& e) {
  const auto& a = detail::variable(e.self());
  if (a.isPassive()) return {tanh(a.value())};
  LanesOf<X> t0(0.0), w0(0.0);
  if (detail::isStart(a)) {
    t0 = tanh(a.value());
    const LanesOf<X> c = cosh(a.value());
    w0 = 1.0 / (c * c);  // 1 - t^2 would cancel where |t| is near 1
  }
  return detail::tangentPair(a, t0, w0, -1.0);
}

/// c' = a' / sqrt(1 + a^2)
template <class E, class X>
KOKKOS_INLINE_FUNCTION Sweep<X> asinh(const Expression<E, X>& e) {
  const auto& a = detail::variable(e.self());
  if (a.isPassive()) return {asinh(a.value())};
  return detail::primitive(a, 1.0 / sqrt(1.0 + a * a),
                           detail::isStart(a) ? asinh(a.value()) : LanesOf<X>(0.0));
}

/// c' = a' / sqrt(a^2 - 1). Defined for a_0 > 1.
template <class E, class X>
KOKKOS_INLINE_FUNCTION Sweep<X> acosh(const Expression<E, X>& e) {
  const auto& a = detail::variable(e.self());
  if (a.isPassive()) return {acosh(a.value())};
  LanesOf<X> c0(0.0);
  if (detail::isStart(a))
    c0 = detail::restrictTo(*a.context(), Operation::Acosh, a.value(), acosh(a.value()),
                            [](double x) { return x > 1; });
  return detail::primitive(a, 1.0 / sqrt((a - 1.0) * (a + 1.0)), c0);
}

/// c' = a' / (1 - a^2). Defined for |a_0| < 1.
template <class E, class X>
KOKKOS_INLINE_FUNCTION Sweep<X> atanh(const Expression<E, X>& e) {
  const auto& a = detail::variable(e.self());
  if (a.isPassive()) return {atanh(a.value())};
  LanesOf<X> c0(0.0);
  if (detail::isStart(a))
    c0 = detail::restrictTo(*a.context(), Operation::Atanh, a.value(), atanh(a.value()),
                            [](double x) { return x > -1 && x < 1; });
  return detail::primitive(a, 1.0 / ((1.0 - a) * (1.0 + a)), c0);
}

}  // namespace atrapos::taylor
