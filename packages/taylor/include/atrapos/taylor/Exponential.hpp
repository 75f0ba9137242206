#pragma once

#include "atrapos/taylor/FunctionPairs.hpp"

namespace atrapos::taylor {

namespace detail {

// c' = c a': c_k = a_k c_0 + (1/k) sum_{i=1..k-1} i a_i c_{k-i}  (paper, Algorithm 2, line 3)
template <class X>
KOKKOS_INLINE_FUNCTION Sweep<X> exponential(const Sweep<X>& a) {
  Context<X::lanes>& context = *a.context();
  const double* as = a.slot();
  double* cs = takeSlots<X>(context);
  LanesOf<X> c;
  if (X::pass == Pass::Start) {
    c = exp(a.value());
  } else {
    c = a.value() * LanesOf<X>::load(cs);
    if (X::pass == Pass::Sweep) c += integrate<X::lanes>(as, cs, context.stride, context.order);
  }
  record<X::pass>(context, cs, c);
  return {c, &context, cs};
}

// (shift + a) c' = scale a': c_k = (scale a_k - (1/k) sum_{i=1..k-1} i c_i a_{k-i}) / (shift + a_0)
template <class X>
KOKKOS_INLINE_FUNCTION Sweep<X> logarithm(const Sweep<X>& a, const LanesOf<X>& c0, double shift,
                                          double scale) {
  Context<X::lanes>& context = *a.context();
  const double* as = a.slot();
  double* cs = takeSlots<X>(context);
  LanesOf<X> c;
  if (X::pass == Pass::Start) {
    c = c0;
  } else {
    c = scale * a.value();
    if (X::pass == Pass::Sweep) c -= integrate<X::lanes>(cs, as, context.stride, context.order);
    c /= shift + LanesOf<X>::load(as);
  }
  record<X::pass>(context, cs, c);
  return {c, &context, cs};
}

}  // namespace detail

template <class E, class X>
KOKKOS_INLINE_FUNCTION Sweep<X> exp(const Expression<E, X>& e) {
  const auto& a = detail::variable(e.self());
  if (a.isPassive()) return {exp(a.value())};
  return detail::exponential(a);
}

/// exp(a) - 1 without cancellation in order 0; the other orders are those of exp(a).
template <class E, class X>
KOKKOS_INLINE_FUNCTION Sweep<X> expm1(const Expression<E, X>& e) {
  const auto& a = detail::variable(e.self());
  if (a.isPassive()) return {expm1(a.value())};
  const Sweep<X> c = detail::exponential(a);
  return {detail::isStart(a) ? expm1(a.value()) : c.value(), a.context()};
}

/// Defined for a_0 > 0.
template <class E, class X>
KOKKOS_INLINE_FUNCTION Sweep<X> log(const Expression<E, X>& e) {
  const auto& a = detail::variable(e.self());
  if (a.isPassive()) return {log(a.value())};
  LanesOf<X> c0(0.0);
  if (detail::isStart(a))
    c0 = detail::restrictTo(*a.context(), Operation::Log, a.value(), log(a.value()),
                            [](double x) { return x > 0; });
  return detail::logarithm(a, c0, 0.0, 1.0);
}

/// Defined for a_0 > 0.
template <class E, class X>
KOKKOS_INLINE_FUNCTION Sweep<X> log10(const Expression<E, X>& e) {
  constexpr double log10OfE = 0.43429448190325182765;
  const auto& a = detail::variable(e.self());
  if (a.isPassive()) return {log10(a.value())};
  LanesOf<X> c0(0.0);
  if (detail::isStart(a))
    c0 = detail::restrictTo(*a.context(), Operation::Log10, a.value(), log10(a.value()),
                            [](double x) { return x > 0; });
  return detail::logarithm(a, c0, 0.0, log10OfE);
}

/// log(1 + a) without cancellation in order 0. Defined for a_0 > -1.
template <class E, class X>
KOKKOS_INLINE_FUNCTION Sweep<X> log1p(const Expression<E, X>& e) {
  const auto& a = detail::variable(e.self());
  if (a.isPassive()) return {log1p(a.value())};
  LanesOf<X> c0(0.0);
  if (detail::isStart(a))
    c0 = detail::restrictTo(*a.context(), Operation::Log1p, a.value(), log1p(a.value()),
                            [](double x) { return x > -1; });
  return detail::logarithm(a, c0, 1.0, 1.0);
}

/// c' = (2/sqrt(pi)) exp(-a^2) a'
template <class E, class X>
KOKKOS_INLINE_FUNCTION Sweep<X> erf(const Expression<E, X>& e) {
  constexpr double twoOverSqrtPi = 1.12837916709551257390;
  const auto& a = detail::variable(e.self());
  if (a.isPassive()) return {erf(a.value())};
  const Sweep<X> w = exp(-(a * a));
  return detail::primitive(a, w, detail::isStart(a) ? erf(a.value()) : LanesOf<X>(0.0), twoOverSqrtPi);
}

}  // namespace atrapos::taylor
