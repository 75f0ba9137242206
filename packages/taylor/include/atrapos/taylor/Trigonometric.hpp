#pragma once

#include "atrapos/taylor/Roots.hpp"

namespace atrapos::taylor {

/// sine and cosine of one argument at the price of either:
/// s_k = (1/k) sum_{i=1..k} i a_i c_{k-i},  c_k = -(1/k) sum_{i=1..k} i a_i s_{k-i}
template <class E, class X>
KOKKOS_INLINE_FUNCTION void sinCos(const Expression<E, X>& e, Sweep<X>& sine, Sweep<X>& cosine) {
  const auto& a = detail::variable(e.self());
  const LanesOf<X> x = a.value();
  if (a.isPassive()) {
    sine = Sweep<X>(sin(x));
    cosine = Sweep<X>(cos(x));
    return;
  }
  LanesOf<X> s0(0.0), c0(0.0);
  if (detail::isStart(a)) {
    s0 = sin(x);
    c0 = cos(x);
  }
  detail::sinePair(a, s0, c0, -1.0, sine, cosine);
}

/// The same for double and Sacado types, so that a law may call sinCos (unqualified, after
/// `using atrapos::taylor::sinCos;`) with each of its scalars.
template <class T>
KOKKOS_INLINE_FUNCTION void sinCos(const T& a, T& sine, T& cosine) {
  using std::cos;
  using std::sin;
  const T x = a;
  sine = sin(x);
  cosine = cos(x);
}

template <class X>
KOKKOS_INLINE_FUNCTION void sinCos(const Sweep<X>& a, Sweep<X>& sine, Sweep<X>& cosine) {
  sinCos(static_cast<const Expression<Sweep<X>, X>&>(a), sine, cosine);
}

template <class E, class X>
KOKKOS_INLINE_FUNCTION Sweep<X> sin(const Expression<E, X>& a) {
  Sweep<X> s, c;
  sinCos(a, s, c);
  return s;
}

template <class E, class X>
KOKKOS_INLINE_FUNCTION Sweep<X> cos(const Expression<E, X>& a) {
  Sweep<X> s, c;
  sinCos(a, s, c);
  return c;
}

/// t' = (1 + t^2) a'
template <class E, class X>
KOKKOS_INLINE_FUNCTION Sweep<X> tan(const Expression<E, X>& e) {
  const auto& a = detail::variable(e.self());
  if (a.isPassive()) return {tan(a.value())};
  LanesOf<X> t0(0.0);
  if (detail::isStart(a)) t0 = tan(a.value());
  return detail::tangentPair(a, t0, 1.0 + t0 * t0, 1.0);
}

/// c' = a' / (1 + a^2)
template <class E, class X>
KOKKOS_INLINE_FUNCTION Sweep<X> atan(const Expression<E, X>& e) {
  const auto& a = detail::variable(e.self());
  if (a.isPassive()) return {atan(a.value())};
  return detail::primitive(a, 1.0 / (1.0 + a * a), detail::isStart(a) ? atan(a.value()) : LanesOf<X>(0.0));
}

namespace detail {

template <class Inverse, class X>
KOKKOS_INLINE_FUNCTION Sweep<X> inverseSine(const Sweep<X>& a, Operation operation, double sign,
                                            const Inverse& inverse) {
  LanesOf<X> c0(0.0);
  if (isStart(a))
    c0 = restrictTo(*a.context(), operation, a.value(), inverse(a.value()),
                    [](double x) { return x > -1 && x < 1; });
  return primitive(a, 1.0 / sqrt((1.0 - a) * (1.0 + a)), c0, sign);
}

}  // namespace detail

/// c' = a' / sqrt(1 - a^2). Defined for |a_0| < 1.
template <class E, class X>
KOKKOS_INLINE_FUNCTION Sweep<X> asin(const Expression<E, X>& e) {
  const auto& a = detail::variable(e.self());
  const auto inverse = [](const LanesOf<X>& x) { return asin(x); };
  if (a.isPassive()) return {inverse(a.value())};
  return detail::inverseSine(a, Operation::Asin, 1.0, inverse);
}

/// c' = -a' / sqrt(1 - a^2). Defined for |a_0| < 1.
template <class E, class X>
KOKKOS_INLINE_FUNCTION Sweep<X> acos(const Expression<E, X>& e) {
  const auto& a = detail::variable(e.self());
  const auto inverse = [](const LanesOf<X>& x) { return acos(x); };
  if (a.isPassive()) return {inverse(a.value())};
  return detail::inverseSine(a, Operation::Acos, -1.0, inverse);
}

/// The angle of the vector (x, y): c' = (x y' - y x') / (x^2 + y^2). Defined where x_0, y_0 do not both
/// vanish.
template <class A, class B, class X>
KOKKOS_INLINE_FUNCTION Sweep<X> atan2(const Expression<A, X>& ey, const Expression<B, X>& ex) {
  const auto& y = detail::variable(ey.self());
  const auto& x = detail::variable(ex.self());
  if (x.isPassive() && y.isPassive()) return {atan2(y.value(), x.value())};
  Context<X::lanes>* context = x.isPassive() ? y.context() : x.context();
  LanesOf<X> c0(0.0);
  if (X::pass == Pass::Start)
    c0 = detail::restrictTo(*context, Operation::Atan2, hypot(x.value(), y.value()),
                            atan2(y.value(), x.value()), [](double r) { return r > 0; });
  const Sweep<X> squares = x * x + y * y;
  if (x.isPassive()) return detail::primitive(y, x.value() / squares, c0);
  if (y.isPassive()) return detail::primitive(x, -y.value() / squares, c0);
  const Sweep<X> ofY = detail::primitive(y, x / squares, c0);
  const Sweep<X> ofX = detail::primitive(x, y / squares, LanesOf<X>(0.0));
  return ofY - ofX;
}
template <class E, class X>
KOKKOS_INLINE_FUNCTION Sweep<X> atan2(const Expression<E, X>& y, const LanesOf<X>& x) {
  return atan2(y, Sweep<X>(x));
}
template <class E, class X>
KOKKOS_INLINE_FUNCTION Sweep<X> atan2(const LanesOf<X>& y, const Expression<E, X>& x) {
  return atan2(Sweep<X>(y), x);
}

}  // namespace atrapos::taylor
