#pragma once

#include "atrapos/taylor/Functions.hpp"

/// Rates inside a rate law (Rate.hpp).
namespace atrapos::taylor {

/// A sum of products w a' of values w and rates a' along the path: the type R of a rate law whose values have
/// the type Sweep<X>. Only what is linear in the rates can be written down: + - of forms, and a form times or
/// over a value. It stands for its own integral c along the path, c' = w a', by the coefficient k of c in the
/// current pass; order 0 of c has no meaning. A form that is multiplied by a value owns a history slot then.
template <class X>
class RateForm {
 public:
  ATRAPOS_FORCEINLINE RateForm() : value_(0.0) {}  ///< zero
  /// The rate of a.
  ATRAPOS_FORCEINLINE explicit RateForm(const Sweep<X>& a)
      : value_(X::pass == Pass::Start ? LanesOf<X>(0.0) : a.coefficient()),
        slot_(a.isPassive() ? nullptr : a.slot()),
        context_(a.context()) {}
  ATRAPOS_FORCEINLINE RateForm(const LanesOf<X>& value, Context<X::lanes>* context, double* slot = nullptr)
      : value_(value), slot_(slot), context_(context) {}

  /// Coefficient k of the integral. In Start NaN where a factor is not finite, otherwise 0: a form without a
  /// series is noticed at order 0.
  ATRAPOS_FORCEINLINE const LanesOf<X>& value() const { return value_; }
  /// Null: the rate of constants, zero.
  ATRAPOS_FORCEINLINE Context<X::lanes>* context() const { return context_; }
  /// The order-0 lanes of the integral's history; takes and records a slot the first time.
  ATRAPOS_FORCEINLINE double* slot() const {
    if (slot_ == nullptr) {
      slot_ = detail::takeSlots<X>(*context_);
      detail::record<X::pass>(*context_, slot_, value_);
    }
    return slot_;
  }

  ATRAPOS_FORCEINLINE RateForm& operator+=(const RateForm& b) { return *this = *this + b; }
  ATRAPOS_FORCEINLINE RateForm& operator-=(const RateForm& b) { return *this = *this - b; }
  template <class B>
  ATRAPOS_FORCEINLINE RateForm& operator*=(const B& b) {
    return *this = *this * b;
  }
  template <class B>
  ATRAPOS_FORCEINLINE RateForm& operator/=(const B& b) {
    return *this = *this / b;
  }

 private:
  LanesOf<X> value_;
  mutable double* slot_ = nullptr;
  Context<X::lanes>* context_ = nullptr;
};

namespace detail {

template <class X>
ATRAPOS_FORCEINLINE Context<X::lanes>* contextOf(const RateForm<X>& a, const RateForm<X>& b) {
  return a.context() != nullptr ? a.context() : b.context();
}

// c' = w a': c_k = w_0 a_k + (1/k) sum_{i=1..k-1} i a_i w_{k-i}, without w_k
template <class X>
KOKKOS_INLINE_FUNCTION RateForm<X> rateProduct(const Sweep<X>& w, const RateForm<X>& a) {
  Context<X::lanes>* context = a.context();
  if (w.isPassive() || context == nullptr) return {a.value() * w.value(), context};
  const double* as = a.slot();
  const double* ws = w.slot();
  if constexpr (X::pass == Pass::Start) return {a.value() + 0.0 * w.value(), context};
  LanesOf<X> c = a.value() * LanesOf<X>::load(ws);
  if constexpr (X::pass == Pass::Sweep) c += integrate<X::lanes>(as, ws, context->stride, context->order);
  return {c, context};
}

// w c' = a': c_k = (a_k - (1/k) sum_{i=1..k-1} i c_i w_{k-i}) / w_0
template <class X>
KOKKOS_INLINE_FUNCTION RateForm<X> rateQuotient(const RateForm<X>& a, const Sweep<X>& w) {
  Context<X::lanes>* context = a.context();
  if (w.isPassive() || context == nullptr) return {a.value() / w.value(), context};
  const double* ws = w.slot();
  double* cs = takeSlots<X>(*context);
  LanesOf<X> c;
  if constexpr (X::pass == Pass::Start) {
    c = restrictTo(*context, Operation::Division, w.value(), a.value() + 0.0 * w.value(),
                   [](double x) { return x != 0; });
  } else {
    c = a.value();
    if constexpr (X::pass == Pass::Sweep) c -= integrate<X::lanes>(cs, ws, context->stride, context->order);
    c /= LanesOf<X>::load(ws);
  }
  record<X::pass>(*context, cs, c);
  return {c, context, cs};
}

}  // namespace detail

template <class X>
ATRAPOS_FORCEINLINE RateForm<X> operator+(const RateForm<X>& a, const RateForm<X>& b) {
  return {a.value() + b.value(), detail::contextOf(a, b)};
}
template <class X>
ATRAPOS_FORCEINLINE RateForm<X> operator-(const RateForm<X>& a, const RateForm<X>& b) {
  return {a.value() - b.value(), detail::contextOf(a, b)};
}
template <class X>
ATRAPOS_FORCEINLINE RateForm<X> operator+(const RateForm<X>& a) {
  return a;
}
template <class X>
ATRAPOS_FORCEINLINE RateForm<X> operator-(const RateForm<X>& a) {
  return {-a.value(), a.context()};
}

template <class E, class X>
ATRAPOS_FORCEINLINE RateForm<X> operator*(const Expression<E, X>& w, const RateForm<X>& a) {
  return detail::rateProduct(detail::variable(w.self()), a);
}
template <class E, class X>
ATRAPOS_FORCEINLINE RateForm<X> operator*(const RateForm<X>& a, const Expression<E, X>& w) {
  return detail::rateProduct(detail::variable(w.self()), a);
}
template <class E, class X>
ATRAPOS_FORCEINLINE RateForm<X> operator/(const RateForm<X>& a, const Expression<E, X>& w) {
  return detail::rateQuotient(a, detail::variable(w.self()));
}

#define ATRAPOS_RATE_FORM_WITH(PASSIVE)                                              \
  template <class X>                                                                 \
  ATRAPOS_FORCEINLINE RateForm<X> operator*(PASSIVE factor, const RateForm<X>& a) {  \
    return {a.value() * factor, a.context()};                                        \
  }                                                                                  \
  template <class X>                                                                 \
  ATRAPOS_FORCEINLINE RateForm<X> operator*(const RateForm<X>& a, PASSIVE factor) {  \
    return {a.value() * factor, a.context()};                                        \
  }                                                                                  \
  template <class X>                                                                 \
  ATRAPOS_FORCEINLINE RateForm<X> operator/(const RateForm<X>& a, PASSIVE divisor) { \
    return {a.value() / divisor, a.context()};                                       \
  }
ATRAPOS_RATE_FORM_WITH(double)
ATRAPOS_RATE_FORM_WITH(const LanesOf<X>&)
#undef ATRAPOS_RATE_FORM_WITH

/// yes where the condition, decided at order 0, holds, no elsewhere.
template <class X>
KOKKOS_INLINE_FUNCTION RateForm<X> if_then_else(const Mask<X::lanes>& condition, const RateForm<X>& yes,
                                                const RateForm<X>& no) {
  return {detail::select(condition, yes.value(), no.value()), detail::contextOf(yes, no)};
}

/// The same as numbers at one point, where values are doubles: the coefficients of a form by N rates.
/// (Sacado's types would do, but leave variables unset and let products of rates pass.)
template <int N>
struct RateCoefficients {
  double by[N] = {};

  KOKKOS_INLINE_FUNCTION RateCoefficients& operator+=(const RateCoefficients& b) {
    for (int n = 0; n < N; ++n) by[n] += b.by[n];
    return *this;
  }
  KOKKOS_INLINE_FUNCTION RateCoefficients& operator-=(const RateCoefficients& b) {
    for (int n = 0; n < N; ++n) by[n] -= b.by[n];
    return *this;
  }
  KOKKOS_INLINE_FUNCTION RateCoefficients& operator*=(double w) {
    for (int n = 0; n < N; ++n) by[n] *= w;
    return *this;
  }
  KOKKOS_INLINE_FUNCTION RateCoefficients& operator/=(double w) {
    for (int n = 0; n < N; ++n) by[n] /= w;
    return *this;
  }
  KOKKOS_INLINE_FUNCTION RateCoefficients operator+() const { return *this; }
  KOKKOS_INLINE_FUNCTION RateCoefficients operator-() const { return -1.0 * *this; }

  friend KOKKOS_INLINE_FUNCTION RateCoefficients operator+(RateCoefficients a, const RateCoefficients& b) {
    return a += b;
  }
  friend KOKKOS_INLINE_FUNCTION RateCoefficients operator-(RateCoefficients a, const RateCoefficients& b) {
    return a -= b;
  }
  friend KOKKOS_INLINE_FUNCTION RateCoefficients operator*(double w, RateCoefficients a) { return a *= w; }
  friend KOKKOS_INLINE_FUNCTION RateCoefficients operator*(RateCoefficients a, double w) { return a *= w; }
  friend KOKKOS_INLINE_FUNCTION RateCoefficients operator/(RateCoefficients a, double w) { return a /= w; }
};

}  // namespace atrapos::taylor
