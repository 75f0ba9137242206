#pragma once

#include <cstddef>

#include "atrapos/taylor/Domain.hpp"
#include "atrapos/taylor/Lanes.hpp"

namespace atrapos::taylor {

/// What one execution of a law computes (docs/theory/taylor.md).
enum class Pass {
  Start,     ///< order 0: ordinary values
  Sweep,     ///< coefficient `order` of everything, from the inputs' coefficient `order` and the histories
  Complete,  ///< after a Sweep with the inputs' coefficient taken as zero: the linear response to the true
             ///< one, added to the histories
  Linear     ///< after Start: the same linear response, and nothing is recorded: a column of the tangent
};

/// How a law is executed on Sweep: for L points at a time, in one of the passes. With Counting it only tells
/// what memory it takes: context.shape is what there is, and what does not fit shares the first slot.
template <int L, Pass P, bool Counting = false, int Native = nativeLanes>
struct Execution {
  static constexpr bool counting = Counting;
  static constexpr int lanes = L;
  static constexpr Pass pass = P;
  using Values = Lanes<L>;
};

template <class X>
using LanesOf = typename X::Values;

/// Orders begin..end-1 whose convolutions share one pass over the histories: when order `begin` is swept, the
/// products of coefficients below it are added up for all orders of the block (docs/theory/taylor.md, Blocks
/// of orders).
struct OrderBlock {
  int begin = 0, end = 0;  ///< 0, 0: the order alone
};

/// The block of order k >= 1 in a series of orders up to maxOrder. About sqrt(begin) orders make a block:
/// what is read again within it and what it saves then balance. Host; once an order.
inline OrderBlock orderBlock(int k, int maxOrder) {
  OrderBlock block{1, 1};
  while (block.end <= k) {
    block.begin = block.end;
    int size = 1;
    while (size * (size + 1) < block.begin) ++size;  // sqrt(begin), rounded
    block.end = block.begin + size < maxOrder + 1 ? block.begin + size : maxOrder + 1;
  }
  return block;
}

/// Size of the memory that one execution of a law needs at a point.
struct HistoryShape {
  int slots = 0;      ///< series: operands of nonlinear operations
  int constants = 0;  ///< numbers of order 0 alone: inverses of implicit systems, outcomes of comparisons
  int sums = 0;       ///< convolutions that work in blocks of orders

  /// Orders of a block that wait for their turn, at most.
  static int waiting(int maxOrder) {
    int most = 0;
    for (int k = 1; k <= maxOrder; ++k) {
      const OrderBlock block = orderBlock(k, maxOrder);
      if (block.end - block.begin - 1 > most) most = block.end - block.begin - 1;
    }
    return most;
  }

  /// Doubles of the histories of L points for orders 0..maxOrder. Host.
  template <int L>
  std::size_t doubles(int maxOrder) const {
    return doubles<L>(maxOrder, waiting(maxOrder));
  }
  /// The same where it is known how many orders wait.
  template <int L>
  KOKKOS_INLINE_FUNCTION std::size_t doubles(int maxOrder, int ordersWaiting) const {
    return (static_cast<std::size_t>(slots) * (maxOrder + 1) + constants +
            static_cast<std::size_t>(sums) * ordersWaiting) *
           L;
  }
};

/// The state of one execution at L points: where the histories lie and what is being computed.
///
/// Memory at a group of L points: [constant][lane], [order waiting][sum][lane], then [order][slot][lane], so
/// that the sweep of order k reads one contiguous piece, whatever the highest order. Slots, constants and
/// sums are handed out in the order of execution, which is the same at every pass. Any alignment of a double
/// will do; a multiple of 8*L bytes is fastest.
template <int L>
struct Context {
  double* memory = nullptr;  ///< shape.doubles<L>(maxOrder) doubles; kept from pass to pass
  HistoryShape shape;
  int order = 0;             ///< order of this pass; 0 in Start
  OrderBlock block;          ///< of this order
  int waiting = 0;           ///< HistoryShape::waiting(maxOrder) where sweeps work in blocks of orders
  std::ptrdiff_t ahead = 0;  ///< doubles from here to the memory that is wanted next, fetched meanwhile
  Failures<L>* failures = nullptr;  ///< where Start notes arguments outside an operation's domain
  bool plain = false;       ///< Start gives the values of doubles also where an operation has no series
  bool valuesOnly = false;  ///< no pass comes after Start: it need not leave what others read

  // Of the execution under way.
  double* nextSlot = nullptr;
  double* nextConstant = nullptr;
  double* nextSum = nullptr;
  std::ptrdiff_t stride = 0;  ///< doubles from one order to the next
  HistoryShape taken;

  /// Begins an execution with what the caller has given. Read number by number: a wider load would have to
  /// wait for the caller's stores to reach the cache.
  ATRAPOS_FORCEINLINE void begin(const Context& given) {
    memory = alone(given.memory);
    shape.slots = alone(given.shape.slots);
    shape.constants = alone(given.shape.constants);
    shape.sums = alone(given.shape.sums);
    order = alone(given.order);
    block.begin = alone(given.block.begin);
    block.end = alone(given.block.end);
    waiting = alone(given.waiting);
    ahead = alone(given.ahead);
    failures = alone(given.failures);
    plain = given.plain;
    valuesOnly = given.valuesOnly;
    nextConstant = memory;
    nextSum = nextConstant + static_cast<std::ptrdiff_t>(shape.constants) * L;
    nextSlot = nextSum + static_cast<std::ptrdiff_t>(shape.sums) * waiting * L;
    stride = static_cast<std::ptrdiff_t>(shape.slots) * L;
    taken = HistoryShape{};
  }

 private:
  template <class N>
  static ATRAPOS_FORCEINLINE N alone(N number) {
#if defined(__GNUC__) && !defined(__CUDA_ARCH__)
    asm("" : "+r"(number));
#endif
    return number;
  }
};

namespace detail {

/// Outside an operation's domain there is no series: NaN and a note.
template <int L>
KOKKOS_INLINE_FUNCTION void refuse(const Context<L>& context, int lane, Operation operation, double argument,
                                   Lanes<L>& result) {
  if (context.plain) return;
  result[lane] = notANumber;
  if (context.failures != nullptr) context.failures->note(lane, operation, argument);
}

/// What is `there` where `inside` holds for the lane's argument; elsewhere it is refused.
template <int L, class Inside>
KOKKOS_INLINE_FUNCTION Lanes<L> restrictTo(const Context<L>& context, Operation operation,
                                           const Lanes<L>& argument, const Lanes<L>& there,
                                           const Inside& inside) {
  Lanes<L> result = there;
  for (int l = 0; l < L; ++l)
    if (!inside(argument[l])) refuse(context, l, operation, argument[l], result);
  return result;
}

/// `count` consecutive slots; returns the order-0 lanes of the first.
template <class X>
ATRAPOS_FORCEINLINE double* takeSlots(Context<X::lanes>& context, int count = 1) {
  context.taken.slots += count;
  if constexpr (X::counting) {
    if (context.taken.slots > context.shape.slots) return context.memory;
  }
  double* slot = context.nextSlot;
  context.nextSlot += count * X::lanes;
  // Said to the compiler: a value that is asked for its slot a second time has it.
  if constexpr (!X::counting) {
    if (slot == nullptr) __builtin_unreachable();
  }
  return slot;
}

/// Where `count` sums of this execution wait, [order waiting][sum][lane].
template <class X>
ATRAPOS_FORCEINLINE double* takeSums(Context<X::lanes>& context, int count) {
  context.taken.sums += count;
  double* sums = context.nextSum;
  context.nextSum += count * X::lanes;
  return sums;
}

// In Complete the value is an increment of what Sweep left.
template <Pass P, int L>
ATRAPOS_FORCEINLINE void record([[maybe_unused]] const Context<L>& context, [[maybe_unused]] double* slot,
                                [[maybe_unused]] const Lanes<L>& value) {
  if constexpr (P == Pass::Linear) return;
  double* p = slot + context.order * context.stride;
  if constexpr (P == Pass::Complete)
    (Lanes<L>::load(p) + value).store(p);
  else
    value.store(p);
}

/// A number of order 0 that later passes need: `value` counts in Start, when it is kept.
template <class X>
ATRAPOS_FORCEINLINE LanesOf<X> keep(Context<X::lanes>& context, const LanesOf<X>& value) {
  ++context.taken.constants;
  if constexpr (X::counting) return value;
  double* p = context.nextConstant;
  context.nextConstant += X::lanes;
  if constexpr (X::pass != Pass::Start) return LanesOf<X>::load(p);
  value.store(p);
  return value;
}

}  // namespace detail
}  // namespace atrapos::taylor
