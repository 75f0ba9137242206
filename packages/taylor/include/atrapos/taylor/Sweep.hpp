#pragma once

#include "atrapos/taylor/Context.hpp"
#include "atrapos/taylor/Convolution.hpp"

namespace atrapos::taylor {

/// The scalar that a law sees during a pass over Taylor coefficients (paper 2.2.3): coefficient `order` of
/// a quantity at L points, or its increment in Pass::Complete.
///
/// A value is passive (a constant: no context) or active. An active value that a nonlinear operation needs
/// owns a history slot; linear operations make values without one. Copies share the slot; what is assigned
/// over a variable brings its own. There are no comparisons: lanes may differ, and a branch would change
/// the slots from pass to pass.
template <int L>
class Sweep {
 public:
  KOKKOS_FORCEINLINE_FUNCTION Sweep() : value_(0.0) {}
  KOKKOS_FORCEINLINE_FUNCTION Sweep(double constant) : value_(constant) {}
  KOKKOS_FORCEINLINE_FUNCTION Sweep(const Lanes<L>& constant) : value_(constant) {}

  /// An active value; slot may be null, otherwise the value must be recorded there already.
  KOKKOS_FORCEINLINE_FUNCTION Sweep(const Lanes<L>& value, Context<L>* context, double* slot = nullptr)
      : value_(value), slot_(slot), context_(context) {}

  KOKKOS_FORCEINLINE_FUNCTION bool isPassive() const { return context_ == nullptr; }
  KOKKOS_FORCEINLINE_FUNCTION const Lanes<L>& value() const { return value_; }
  KOKKOS_FORCEINLINE_FUNCTION Context<L>* context() const { return context_; }

  /// The order-0 lanes of this active value's history; takes and records a slot the first time.
  KOKKOS_FORCEINLINE_FUNCTION double* slot() const {
    if (slot_ == nullptr) {
      slot_ = detail::takeSlot(*context_);
      detail::record(*context_, slot_, value_);
    }
    return slot_;
  }

  /// The same quantity (same slot, or still none) with another value in this pass; nothing is recorded.
  KOKKOS_FORCEINLINE_FUNCTION Sweep withValue(const Lanes<L>& value) const {
    return {value, context_, slot_};
  }

  /// The coefficient of the current pass: what a constant contributes is its value in Start, 0 afterwards.
  KOKKOS_FORCEINLINE_FUNCTION Lanes<L> coefficient(Pass pass) const {
    return isPassive() && pass != Pass::Start ? Lanes<L>(0.0) : value_;
  }

  template <class B>
  KOKKOS_FORCEINLINE_FUNCTION Sweep& operator+=(const B& b) {
    return *this = *this + b;
  }
  template <class B>
  KOKKOS_FORCEINLINE_FUNCTION Sweep& operator-=(const B& b) {
    return *this = *this - b;
  }
  template <class B>
  KOKKOS_FORCEINLINE_FUNCTION Sweep& operator*=(const B& b) {
    return *this = *this * b;
  }
  template <class B>
  KOKKOS_FORCEINLINE_FUNCTION Sweep& operator/=(const B& b) {
    return *this = *this / b;
  }

 private:
  Lanes<L> value_;
  mutable double* slot_ = nullptr;
  Context<L>* context_ = nullptr;
};

namespace detail {
template <class T>
struct PassiveOf {
  using Type = double;
};
template <int L>
struct PassiveOf<Sweep<L>> {
  using Type = Lanes<L>;
};
}  // namespace detail

/// Type of a law's passive data at one point (thickness, initial gap, ...) when its scalar is T: double for
/// double and Sacado Fad types, Lanes<L> for Sweep<L>.
template <class T>
using Passive = typename detail::PassiveOf<T>::Type;

}  // namespace atrapos::taylor

#include "atrapos/taylor/Arithmetic.hpp"
