#pragma once

#include <cstddef>

#include "atrapos/taylor/Lanes.hpp"

namespace atrapos::taylor {

/// What one execution of a law computes (docs/theory/taylor.md).
enum class Pass {
  Start,    ///< order 0: ordinary values
  Sweep,    ///< coefficient `order` of everything, from the inputs' coefficient `order` and the histories
  Complete  ///< the linear response to an increment of the inputs' coefficient `order`, added to the
            ///< histories
};

/// The state of one execution at L points: where the histories lie and what is being computed.
///
/// history[slot][order][lane] holds (maxOrder+1)*L doubles a slot; slots are handed out in the order of
/// execution, which is the same at every pass. Any alignment of a double will do; a multiple of 8*L bytes is
/// fastest.
template <int L>
struct Context {
  double* history;  ///< historyDoubles<L>(slots, maxOrder) doubles; kept from pass to pass
  int maxOrder;     ///< highest order the histories hold; -1 while slots are only being counted
  int order;        ///< order of this pass; 0 in Start
  Pass pass;
  int cursor;  ///< slots handed out so far in this execution
};

namespace detail {

template <int L>
KOKKOS_FORCEINLINE_FUNCTION double* takeSlot(Context<L>& context) {
  return context.history + static_cast<std::size_t>(context.cursor++) * (context.maxOrder + 1) * L;
}

// In Complete the value is an increment of what Sweep (and earlier Completes) left.
template <int L>
KOKKOS_FORCEINLINE_FUNCTION void record(const Context<L>& context, double* slot, const Lanes<L>& value) {
  double* p = slot + static_cast<std::size_t>(context.order) * L;
  if (context.pass == Pass::Complete)
    store(p, load<L>(p) + value);
  else
    store(p, value);
}

}  // namespace detail
}  // namespace atrapos::taylor
