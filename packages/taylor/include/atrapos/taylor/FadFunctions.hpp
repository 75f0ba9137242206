#pragma once

#include <cmath>
#include <type_traits>

#include "atrapos/taylor/Fad.hpp"

/// hypot, expm1, log1p and erf of Sacado Fad types over double, which Sacado has not: with them a law that
/// calls one has a tangent. Argument-dependent look-up does not reach here, so a law says `using std::erf,
/// atrapos::taylor::erf;` and calls erf unqualified.
#if !defined(ATRAPOS_WITHOUT_TRILINOS)
namespace atrapos::taylor {

namespace detail {

template <class T>
using FadOf = typename Sacado::BaseExprType<T>::type;

// Values and derivatives of a Fad or an expression of such.
template <class T>
using IfFad = std::enable_if_t<Sacado::IsExpr<T>::value && Sacado::IsFad<FadOf<T>>::value>;

/// f with df = slope da.
template <class T>
KOKKOS_INLINE_FUNCTION FadOf<T> chain(const T& a, double value, double slope) {
  FadOf<T> f(a);
  for (int d = 0; d < f.size(); ++d) f.fastAccessDx(d) *= slope;
  f.val() = value;
  return f;
}

}  // namespace detail

template <class T, class = detail::IfFad<T>>
KOKKOS_INLINE_FUNCTION detail::FadOf<T> expm1(const T& a) {
  return detail::chain(a, std::expm1(a.val()), std::exp(a.val()));
}

template <class T, class = detail::IfFad<T>>
KOKKOS_INLINE_FUNCTION detail::FadOf<T> log1p(const T& a) {
  return detail::chain(a, std::log1p(a.val()), 1.0 / (1.0 + a.val()));
}

template <class T, class = detail::IfFad<T>>
KOKKOS_INLINE_FUNCTION detail::FadOf<T> erf(const T& a) {
  constexpr double twoOverSqrtPi = 1.12837916709551257390;
  return detail::chain(a, std::erf(a.val()), twoOverSqrtPi * std::exp(-a.val() * a.val()));
}

/// sqrt(a^2 + b^2); either argument may be a double.
template <class A, class B, class = detail::IfFad<A>, class = detail::IfFad<B>>
KOKKOS_INLINE_FUNCTION detail::FadOf<A> hypot(const A& a, const B& b) {
  const double length = std::hypot(a.val(), b.val());
  detail::FadOf<A> f = (a.val() / length) * a + (b.val() / length) * b;
  f.val() = length;
  return f;
}
template <class A, class = detail::IfFad<A>>
KOKKOS_INLINE_FUNCTION detail::FadOf<A> hypot(const A& a, double b) {
  const double length = std::hypot(a.val(), b);
  return detail::chain(a, length, a.val() / length);
}
template <class B, class = detail::IfFad<B>>
KOKKOS_INLINE_FUNCTION detail::FadOf<B> hypot(double a, const B& b) {
  return hypot(b, a);
}

}  // namespace atrapos::taylor
#endif
