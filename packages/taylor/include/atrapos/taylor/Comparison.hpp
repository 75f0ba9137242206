#pragma once

#include <type_traits>

#include "atrapos/taylor/FunctionPairs.hpp"

/// Comparisons and what follows from them: decided lane by lane on the values of order 0, in Start, and kept
/// for all orders of the series.
namespace atrapos::taylor {

/// One truth value per point.
template <int L>
struct Mask {
  Lanes<L> v;  ///< 1 or 0
  ATRAPOS_FORCEINLINE bool operator[](int l) const { return v[l] != 0; }
};

template <int L>
KOKKOS_INLINE_FUNCTION Mask<L> operator!(const Mask<L>& a) {
  return {1.0 - a.v};
}
template <int L>
KOKKOS_INLINE_FUNCTION Mask<L> operator&&(const Mask<L>& a, const Mask<L>& b) {
  return {a.v * b.v};
}
template <int L>
KOKKOS_INLINE_FUNCTION Mask<L> operator||(const Mask<L>& a, const Mask<L>& b) {
  return {a.v + b.v - a.v * b.v};
}

namespace detail {

template <class X, class Compare>
KOKKOS_INLINE_FUNCTION Mask<X::lanes> compare(const Sweep<X>& a, const Sweep<X>& b, const Compare& holds) {
  Context<X::lanes>* context = a.isPassive() ? b.context() : a.context();
  LanesOf<X> outcome(0.0);
  if (context == nullptr || X::pass == Pass::Start)
    outcome = LanesOf<X>::of(LanesOf<X>::Register::compare(a.value().v, b.value().v, holds));
  return {context == nullptr ? outcome : keep<X>(*context, outcome)};
}

// yes in lanes where the mask holds, no elsewhere.
template <int L>
KOKKOS_INLINE_FUNCTION Lanes<L> select(const Mask<L>& mask, const Lanes<L>& yes, const Lanes<L>& no) {
  return Lanes<L>::of(Lanes<L>::Register::select(mask.v.v, yes.v, no.v));
}

// The smaller (sign = 1) or larger (-1) of two: order 0 decides; where it cannot, there is no series.
template <class X>
KOKKOS_INLINE_FUNCTION Sweep<X> extremum(const Sweep<X>& a, const Sweep<X>& b, double sign,
                                         Operation operation) {
  if (a.isPassive() && b.isPassive())
    return {sign > 0 ? fmin(a.value(), b.value()) : fmax(a.value(), b.value())};
  Context<X::lanes>& context = a.isPassive() ? *b.context() : *a.context();
  LanesOf<X> weight(0.0);
  if (X::pass == Pass::Start)
    for (int l = 0; l < X::lanes; ++l) {
      const double x = sign * a.value()[l], y = sign * b.value()[l];
      weight[l] = x < y ? 1.0 : 0.0;
      if (!(x < y || y < x)) refuse(context, l, operation, a.value()[l], weight);
    }
  weight = keep<X>(context, weight);
  LanesOf<X> c = select(Mask<X::lanes>{weight}, a.coefficient(), b.coefficient());
  return {c + 0.0 * weight, &context};  // NaN where the weight is
}

}  // namespace detail

#define ATRAPOS_COMPARISON(OP)                                                                              \
  template <class A, class B, class X>                                                                      \
  KOKKOS_INLINE_FUNCTION Mask<X::lanes> operator OP(const Expression<A, X>& a, const Expression<B, X>& b) { \
    return detail::compare(Sweep<X>(a.self()), Sweep<X>(b.self()),                                          \
                           [](const auto& x, const auto& y) { return x OP y; });                            \
  }                                                                                                         \
  template <class E, class X>                                                                               \
  KOKKOS_INLINE_FUNCTION Mask<X::lanes> operator OP(const Expression<E, X>& a, double b) {                  \
    return a OP Sweep<X>(b);                                                                                \
  }                                                                                                         \
  template <class E, class X>                                                                               \
  KOKKOS_INLINE_FUNCTION Mask<X::lanes> operator OP(double a, const Expression<E, X>& b) {                  \
    return Sweep<X>(a) OP b;                                                                                \
  }                                                                                                         \
  template <class E, class X>                                                                               \
  KOKKOS_INLINE_FUNCTION Mask<X::lanes> operator OP(const Expression<E, X>& a, const LanesOf<X>& b) {       \
    return a OP Sweep<X>(b);                                                                                \
  }                                                                                                         \
  template <class E, class X>                                                                               \
  KOKKOS_INLINE_FUNCTION Mask<X::lanes> operator OP(const LanesOf<X>& a, const Expression<E, X>& b) {       \
    return Sweep<X>(a) OP b;                                                                                \
  }

ATRAPOS_COMPARISON(<)
ATRAPOS_COMPARISON(<=)
ATRAPOS_COMPARISON(>)
ATRAPOS_COMPARISON(>=)
ATRAPOS_COMPARISON(==)
ATRAPOS_COMPARISON(!=)
#undef ATRAPOS_COMPARISON

/// yes where the condition holds, no elsewhere; both are evaluated. In a lane where the other one is chosen,
/// an argument outside a domain does no harm.
template <class A, class B, class X>
KOKKOS_INLINE_FUNCTION Sweep<X> if_then_else(const Mask<X::lanes>& condition, const Expression<A, X>& a,
                                             const Expression<B, X>& b) {
  const Sweep<X> yes(detail::variable(a.self())), no(detail::variable(b.self()));
  Context<X::lanes>* context = yes.isPassive() ? no.context() : yes.context();
  if (context == nullptr) return {detail::select(condition, yes.value(), no.value())};
  return {detail::select(condition, yes.coefficient(), no.coefficient()), context};
}
template <class E, class X>
KOKKOS_INLINE_FUNCTION Sweep<X> if_then_else(const Mask<X::lanes>& condition, const Expression<E, X>& yes,
                                             const LanesOf<X>& no) {
  return if_then_else(condition, yes, Sweep<X>(no));
}
template <class E, class X>
KOKKOS_INLINE_FUNCTION Sweep<X> if_then_else(const Mask<X::lanes>& condition, const LanesOf<X>& yes,
                                             const Expression<E, X>& no) {
  return if_then_else(condition, Sweep<X>(yes), no);
}
template <int L>
KOKKOS_INLINE_FUNCTION Lanes<L> if_then_else(const Mask<L>& condition, const std::decay_t<Lanes<L>>& yes,
                                             const std::decay_t<Lanes<L>>& no) {
  return detail::select(condition, yes, no);
}

/// The same for double and Sacado types.
template <class A, class B>
KOKKOS_INLINE_FUNCTION std::common_type_t<A, B> if_then_else(bool condition, const A& a, const B& b) {
  return condition ? std::common_type_t<A, B>(a) : std::common_type_t<A, B>(b);
}

/// |a|. Defined for a_0 != 0.
template <class E, class X>
KOKKOS_INLINE_FUNCTION Sweep<X> fabs(const Expression<E, X>& e) {
  const Sweep<X> a(detail::variable(e.self()));
  if (a.isPassive()) return {fabs(a.value())};
  Context<X::lanes>& context = *a.context();
  LanesOf<X> sign(0.0);
  if (X::pass == Pass::Start) {
    for (int l = 0; l < X::lanes; ++l) sign[l] = a.value()[l] < 0 ? -1.0 : 1.0;
    sign = detail::restrictTo(context, Operation::Abs, a.value(), sign, [](double x) { return x != 0; });
  }
  return {a.value() * detail::keep<X>(context, sign), &context};
}
template <class E, class X>
KOKKOS_INLINE_FUNCTION Sweep<X> abs(const Expression<E, X>& e) {
  return fabs(e);
}

// Overloads for Sweep itself because std::min and std::max would fit better than the ones for expressions.
#define ATRAPOS_EXTREMUM(NAME, SIGN, OPERATION)                                                  \
  template <class A, class B, class X>                                                           \
  KOKKOS_INLINE_FUNCTION Sweep<X> NAME(const Expression<A, X>& a, const Expression<B, X>& b) {   \
    return detail::extremum(Sweep<X>(a.self()), Sweep<X>(b.self()), SIGN, Operation::OPERATION); \
  }                                                                                              \
  template <class X>                                                                             \
  KOKKOS_INLINE_FUNCTION Sweep<X> NAME(const Sweep<X>& a, const Sweep<X>& b) {                   \
    return detail::extremum(a, b, SIGN, Operation::OPERATION);                                   \
  }                                                                                              \
  template <class E, class X>                                                                    \
  KOKKOS_INLINE_FUNCTION Sweep<X> NAME(const Expression<E, X>& a, const LanesOf<X>& b) {         \
    return NAME(a, static_cast<const Expression<Sweep<X>, X>&>(Sweep<X>(b)));                    \
  }                                                                                              \
  template <class E, class X>                                                                    \
  KOKKOS_INLINE_FUNCTION Sweep<X> NAME(const LanesOf<X>& a, const Expression<E, X>& b) {         \
    return NAME(static_cast<const Expression<Sweep<X>, X>&>(Sweep<X>(a)), b);                    \
  }

/// The smaller or larger of two. Defined where they differ in order 0.
ATRAPOS_EXTREMUM(min, 1.0, Min)
ATRAPOS_EXTREMUM(max, -1.0, Max)
#undef ATRAPOS_EXTREMUM

}  // namespace atrapos::taylor
