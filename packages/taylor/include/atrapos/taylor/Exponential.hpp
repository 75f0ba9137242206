#pragma once

#include "atrapos/taylor/Sweep.hpp"

namespace atrapos::taylor {

/// c' = c a':  c_k = (1/k) sum_{i=1..k} i a_i c_{k-i}  (paper, Algorithm 2, line 3)
template <int L>
KOKKOS_INLINE_FUNCTION Sweep<L> exp(const Sweep<L>& a) {
  if (a.isPassive()) return {exp(a.value())};
  Context<L>& context = *a.context();
  const double* as = a.slot();
  double* cs = detail::takeSlot(context);
  Lanes<L> c;
  switch (context.pass) {
    case Pass::Start:
      c = exp(a.value());
      break;
    case Pass::Sweep:
      c = detail::integrate<L>(as, cs, context.order);
      break;
    default:
      c = detail::load<L>(cs) * a.value();
  }
  detail::record(context, cs, c);
  return {c, &context, cs};
}

/// a c' = a':  c_k = (a_k - (1/k) sum_{i=1..k-1} i c_i a_{k-i}) / a_0. Order 0 is NaN or infinity in a
/// lane where a_0 <= 0.
template <int L>
KOKKOS_INLINE_FUNCTION Sweep<L> log(const Sweep<L>& a) {
  if (a.isPassive()) return {log(a.value())};
  Context<L>& context = *a.context();
  const int k = context.order;
  const double* as = a.slot();
  double* cs = detail::takeSlot(context);
  Lanes<L> c;
  switch (context.pass) {
    case Pass::Start:
      c = log(a.value());
      break;
    case Pass::Sweep:
      c = (a.value() - detail::convolveWeighted<L>(cs, as, 1, k - 1, k, 1.0, 0.0) * (1.0 / k)) /
          detail::load<L>(as);
      break;
    default:
      c = a.value() / detail::load<L>(as);
  }
  detail::record(context, cs, c);
  return {c, &context, cs};
}

}  // namespace atrapos::taylor
