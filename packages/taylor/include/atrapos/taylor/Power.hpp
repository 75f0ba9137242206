#pragma once

#include "atrapos/taylor/Exponential.hpp"

namespace atrapos::taylor {

namespace detail {

// a c' = r c a': c_k = r a_k c_0 / a_0 + sum_{i=1..k-1} ((r + 1) i - k) a_i c_{k-i} / (k a_0)
// r: double or Lanes
template <class X, class R>
KOKKOS_INLINE_FUNCTION Sweep<X> powerSeries(const Sweep<X>& a, const LanesOf<X>& c0, const R& r) {
  Context<X::lanes>& context = *a.context();
  const double* as = a.slot();
  double* cs = takeSlots<X>(context);
  LanesOf<X> c;
  if (X::pass == Pass::Start) {
    c = c0;
  } else {
    const int k = context.order;
    c = r * (a.value() * LanesOf<X>::load(cs));
    if (X::pass == Pass::Sweep)
      c +=
          convolveWeighted<X::lanes>(as, cs, context.stride, k, r + 1.0, -static_cast<double>(k)) * (1.0 / k);
    c /= LanesOf<X>::load(as);
  }
  record<X::pass>(context, cs, c);
  return {c, &context, cs};
}

KOKKOS_INLINE_FUNCTION bool isInteger(double r) { return r == std::floor(r); }

}  // namespace detail

/// a^n by repeated squaring: right for every a_0, 0 and negative included (n < 0: a_0 != 0). n is the same
/// for all points.
template <class E, class X>
KOKKOS_INLINE_FUNCTION Sweep<X> pow(const Expression<E, X>& e, int n) {
  const auto& a = detail::variable(e.self());
  unsigned int rest = n < 0 ? 0u - static_cast<unsigned int>(n) : static_cast<unsigned int>(n);
  if (rest > 1 && !a.isPassive()) a.slot();  // the variable's own, shared by the copy
  // Before the division below gives it another name.
  if (n < 0 && !a.isPassive() && detail::isStart(a))
    detail::restrictTo(*a.context(), Operation::Pow, a.value(), a.value(), [](double x) { return x != 0; });
  Sweep<X> power(1.0);
  Sweep<X> square = a;
  bool first = true;
  while (rest != 0) {
    if (rest % 2 == 1) {
      power = first ? square : Sweep<X>(power * square);
      first = false;
    }
    rest /= 2;
    if (rest != 0) square = square * square;
  }
  return n < 0 ? Sweep<X>(1.0 / power) : power;
}

/// a^r. An integer r goes to the overload above; otherwise defined for a_0 > 0. r is the same for all points.
template <class E, class X>
KOKKOS_INLINE_FUNCTION Sweep<X> pow(const Expression<E, X>& e, double r) {
  constexpr double largestInteger = 1024;  // beyond, squaring loses more digits than the recurrence
  if (r >= -largestInteger && r <= largestInteger && detail::isInteger(r)) return pow(e, static_cast<int>(r));
  const auto& a = detail::variable(e.self());
  if (a.isPassive()) return {pow(a.value(), LanesOf<X>(r))};
  LanesOf<X> c0(0.0);
  if (detail::isStart(a))
    c0 = detail::restrictTo(*a.context(), Operation::Pow, a.value(), pow(a.value(), LanesOf<X>(r)),
                            [r](double x) { return x > 0 || (x < 0 && detail::isInteger(r)); });
  return detail::powerSeries(a, c0, r);
}

/// a^r with an exponent that differs from point to point. Defined for a_0 > 0, and for a_0 < 0 where r is an
/// integer.
template <class E, class X>
KOKKOS_INLINE_FUNCTION Sweep<X> pow(const Expression<E, X>& e, const LanesOf<X>& r) {
  const auto& a = detail::variable(e.self());
  if (a.isPassive()) return {pow(a.value(), r)};
  LanesOf<X> c0(0.0);
  if (detail::isStart(a)) {
    c0 = pow(a.value(), r);
    for (int l = 0; l < X::lanes; ++l) {
      const double x = a.value()[l];
      if (x > 0 || (x < 0 && detail::isInteger(r[l]))) continue;
      detail::refuse(*a.context(), l, Operation::Pow, x, c0);
    }
  }
  return detail::powerSeries(a, c0, r);
}

/// a^b with a passive base: exp(b log a). Defined for a > 0.
template <class E, class X>
KOKKOS_INLINE_FUNCTION Sweep<X> pow(const LanesOf<X>& base, const Expression<E, X>& e) {
  const auto& exponent = detail::variable(e.self());
  if (exponent.isPassive()) return {pow(base, exponent.value())};
  Context<X::lanes>& context = *exponent.context();
  LanesOf<X> logarithm(0.0);
  if (detail::isStart(exponent))
    logarithm = detail::restrictTo(context, Operation::Pow, base, log(base), [](double x) { return x > 0; });
  logarithm = detail::keep<X>(context, logarithm);
  return exp(logarithm * exponent);
}
template <class E, class X>
KOKKOS_INLINE_FUNCTION Sweep<X> pow(double base, const Expression<E, X>& e) {
  const auto& exponent = detail::variable(e.self());
  if (exponent.isPassive()) return {pow(LanesOf<X>(base), exponent.value())};
  const LanesOf<X> logarithm = base > 0 ? std::log(base) : detail::notANumber;
  if (detail::isStart(exponent))
    detail::restrictTo(*exponent.context(), Operation::Pow, LanesOf<X>(base), logarithm,
                       [](double x) { return x > 0; });
  return exp(logarithm * exponent);
}

/// a^b = exp(b log a), both series. Defined for a_0 > 0.
template <class A, class B, class X>
KOKKOS_INLINE_FUNCTION Sweep<X> pow(const Expression<A, X>& a, const Expression<B, X>& b) {
  const auto& base = detail::variable(a.self());
  const auto& exponent = detail::variable(b.self());
  if (exponent.isPassive()) return pow(base, exponent.value());
  if (base.isPassive()) return pow(base.value(), exponent);
  if (detail::isStart(base))  // before the logarithm gives it another name
    detail::restrictTo(*base.context(), Operation::Pow, base.value(), base.value(),
                       [](double x) { return x > 0; });
  return exp(exponent * log(base));
}

}  // namespace atrapos::taylor
