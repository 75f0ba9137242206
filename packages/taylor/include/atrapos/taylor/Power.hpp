#pragma once

#include "atrapos/taylor/Sweep.hpp"

namespace atrapos::taylor {

/// a^n by repeated squaring: right for every a_0, 0 and negative included (n < 0: division by a_0 = 0 gives
/// infinity or NaN in that lane). n is the same for all points.
template <int L>
KOKKOS_INLINE_FUNCTION Sweep<L> pow(const Sweep<L>& a, int n) {
  unsigned int rest = n < 0 ? 0u - static_cast<unsigned int>(n) : static_cast<unsigned int>(n);
  Sweep<L> power(1.0);
  Sweep<L> square = a;
  bool first = true;
  while (rest != 0) {
    if (rest % 2 == 1) {
      power = first ? square : power * square;
      first = false;
    }
    rest /= 2;
    if (rest != 0) square = square * square;
  }
  return n < 0 ? 1.0 / power : power;
}

/// a^r. An integer r goes to the overload above; otherwise a c' = r c a':
/// c_k = (1/(k a_0)) sum_{i=1..k} (i r - (k-i)) a_i c_{k-i}, with NaN or infinity in a lane where a_0 <= 0
/// (order 0 at a_0 = 0 alone can be finite). r is the same for all points.
template <int L>
KOKKOS_INLINE_FUNCTION Sweep<L> pow(const Sweep<L>& a, double r) {
  constexpr double largestInteger = 1024;  // beyond, squaring loses more digits than the recurrence
  if (r >= -largestInteger && r <= largestInteger && r == static_cast<int>(r))
    return pow(a, static_cast<int>(r));
  if (a.isPassive()) return {pow(a.value(), r)};
  Context<L>& context = *a.context();
  const int k = context.order;
  const double* as = a.slot();
  double* cs = detail::takeSlot(context);
  Lanes<L> c;
  switch (context.pass) {
    case Pass::Start:
      c = pow(a.value(), r);
      break;
    case Pass::Sweep:
      c = detail::convolveWeighted<L>(as, cs, 1, k, k, r + 1.0, -static_cast<double>(k)) /
          (static_cast<double>(k) * detail::load<L>(as));
      break;
    default:
      c = r * detail::load<L>(cs) * a.value() / detail::load<L>(as);
  }
  detail::record(context, cs, c);
  return {c, &context, cs};
}

}  // namespace atrapos::taylor
