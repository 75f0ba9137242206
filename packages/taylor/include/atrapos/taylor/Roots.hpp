#pragma once

#include "atrapos/taylor/Sweep.hpp"

namespace atrapos::taylor {

/// c_k = (a_k - sum_{i=1..k-1} c_i c_{k-i}) / (2 c_0). A negative a_0 gives NaN in its lane; a_0 = 0 gives
/// 0 in order 0 and NaN or infinity afterwards (no series exists there).
template <int L>
KOKKOS_INLINE_FUNCTION Sweep<L> sqrt(const Sweep<L>& a) {
  if (a.isPassive()) return {sqrt(a.value())};
  Context<L>& context = *a.context();
  double* cs = detail::takeSlot(context);
  Lanes<L> c;
  switch (context.pass) {
    case Pass::Start:
      c = sqrt(a.value());
      break;
    case Pass::Sweep:
      c = (a.value() - detail::convolveSquare<L>(cs, 1, context.order)) / (2.0 * detail::load<L>(cs));
      break;
    default:
      c = a.value() / (2.0 * detail::load<L>(cs));
  }
  detail::record(context, cs, c);
  return {c, &context, cs};
}

}  // namespace atrapos::taylor
