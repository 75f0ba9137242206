#pragma once

#include <utility>

#include "atrapos/taylor/Expression.hpp"

namespace atrapos::taylor {

/// The scalar that a law sees during a pass over Taylor coefficients (paper 2.2.3): coefficient `order` of
/// a quantity at several points, or its increment in Pass::Complete. X is an Execution<L, Pass>.
///
/// A value is passive (a constant: no context) or active. An active value that a nonlinear operation needs
/// owns a history slot, taken the first time; linear operations make values without one. Copies share the
/// slot; what is assigned over a variable brings its own. Comparisons act on the value of order 0
/// (Comparison.hpp) and give a Mask for if_then_else: lanes may differ, so there is no `if`.
template <class X>
class Sweep : public Expression<Sweep<X>, X> {
 public:
  ATRAPOS_FORCEINLINE Sweep() : value_(0.0) {}
  ATRAPOS_FORCEINLINE Sweep(double constant) : value_(constant) {}
  // Written out member by member: the compiler's own copies move the padding too, through memory.
  ATRAPOS_FORCEINLINE Sweep(const Sweep& b)
      : value_(b.value_), slot_(b.slot_), context_(b.context_), zero_(b.zero_) {}
  ATRAPOS_FORCEINLINE Sweep& operator=(const Sweep& b) {
    value_ = b.value_;
    slot_ = b.slot_;
    context_ = b.context_;
    zero_ = b.zero_;
    return *this;
  }
  ATRAPOS_FORCEINLINE Sweep(const LanesOf<X>& constant) : value_(constant) {}

  /// An active value; slot may be null, otherwise the value must be recorded there already.
  ATRAPOS_FORCEINLINE Sweep(const LanesOf<X>& value, Context<X::lanes>* context, double* slot = nullptr)
      : value_(value), slot_(slot), context_(context) {}

  /// An active value with a slot whose coefficient of this order is not known yet and counts as zero.
  static ATRAPOS_FORCEINLINE Sweep unknown(Context<X::lanes>* context, double* slot) {
    Sweep a(LanesOf<X>(0.0), context, slot);
    a.zero_ = true;
    return a;
  }

  /// Evaluates a statement. The value never keeps an operand's slot, not even where it equals it: the slots
  /// given away must be the same in every pass.
  template <class E>
  ATRAPOS_FORCEINLINE Sweep(const Expression<E, X>& e)
      : value_(detail::evaluate(e, e.self().context())), context_(e.self().context()) {}

  ATRAPOS_FORCEINLINE bool isPassive() const { return context_ == nullptr; }
  ATRAPOS_FORCEINLINE const LanesOf<X>& value() const { return value_; }
  ATRAPOS_FORCEINLINE Context<X::lanes>* context() const { return context_; }
  /// Whether this pass's coefficient is known to be zero when compiling: an input that is not known yet.
  ATRAPOS_FORCEINLINE bool isZero() const { return zero_; }
  ATRAPOS_FORCEINLINE bool hasSlot() const { return slot_ != nullptr; }

  /// The order-0 lanes of this active value's history; takes and records a slot the first time.
  ATRAPOS_FORCEINLINE double* slot() const {
    if (slot_ == nullptr) {
      slot_ = detail::takeSlots<X>(*context_);
      detail::record<X::pass>(*context_, slot_, value_);
    }
    return slot_;
  }

  /// The same quantity (same slot, or still none) with another value in this pass; nothing is recorded.
  ATRAPOS_FORCEINLINE Sweep withValue(const LanesOf<X>& value) const { return {value, context_, slot_}; }

  /// The same in another pass of the same context.
  template <class Y>
  ATRAPOS_FORCEINLINE Sweep<Y> in() const {
    return isPassive() ? Sweep<Y>(value_) : Sweep<Y>(value_, context_, slot_);
  }

  /// The coefficient of the current pass: what a constant contributes is its value in Start, 0 afterwards.
  ATRAPOS_FORCEINLINE LanesOf<X> coefficient() const {
    return X::pass != Pass::Start && isPassive() ? LanesOf<X>(0.0) : value_;
  }
  ATRAPOS_FORCEINLINE detail::PreparedValue<X> prepare() const { return {coefficient()}; }
  ATRAPOS_FORCEINLINE const LanesOf<X>& constant() const { return value_; }

  template <class B>
  ATRAPOS_FORCEINLINE Sweep& operator+=(const B& b) {
    return *this = *this + b;
  }
  template <class B>
  ATRAPOS_FORCEINLINE Sweep& operator-=(const B& b) {
    return *this = *this - b;
  }
  template <class B>
  ATRAPOS_FORCEINLINE Sweep& operator*=(const B& b) {
    return *this = *this * b;
  }
  template <class B>
  ATRAPOS_FORCEINLINE Sweep& operator/=(const B& b) {
    return *this = *this / b;
  }

 private:
  LanesOf<X> value_;
  mutable double* slot_ = nullptr;
  Context<X::lanes>* context_ = nullptr;
  bool zero_ = false;
};

namespace detail {

/// An operand of a nonlinear operation: a variable itself (the history becomes the variable's own), or the
/// value of an expression.
template <class X>
ATRAPOS_FORCEINLINE const Sweep<X>& variable(const Sweep<X>& a) {
  return a;
}
template <class E, class X>
ATRAPOS_FORCEINLINE Sweep<X> variable(const Expression<E, X>& e) {
  return Sweep<X>(e);
}

template <class T>
struct PassiveOf {
  using Type = double;
};
template <class X>
struct PassiveOf<Sweep<X>> {
  using Type = LanesOf<X>;
};
}  // namespace detail

/// Type of a law's passive data at one point (thickness, initial gap, ...) when its scalar is T: double for
/// double and Sacado Fad types, LanesOf<X> for Sweep<X>.
template <class T>
using Passive = typename detail::PassiveOf<T>::Type;

}  // namespace atrapos::taylor

#include "atrapos/taylor/Arithmetic.hpp"
