#pragma once

#include <cstddef>

#include "atrapos/taylor/Lanes.hpp"

/// Sums over the orders 1..k-1 of histories: the inner loops of every recurrence. (Terms with coefficient k
/// of an operand are linear in what is new; they are added where the recurrence stands.) a and b point to the
/// order-0 lanes of a slot, `stride` doubles lie between an order and the next.
namespace atrapos::taylor::detail {

/// sum_{i=1..k-1} a_i b_{k-i}
template <int L>
KOKKOS_INLINE_FUNCTION Lanes<L> convolve(const double* a, const double* b, std::ptrdiff_t stride, int k) {
  // Two sums: one alone would wait for the latency of the fused multiply-add.
  Lanes<L> even(0.0), odd(0.0);
  const double* p = a + stride;
  const double* q = b + (k - 1) * stride;
  int left = k - 1;
  for (; left > 1; left -= 2, p += 2 * stride, q -= 2 * stride) {
    even += Lanes<L>::load(p) * Lanes<L>::load(q);
    odd += Lanes<L>::load(p + stride) * Lanes<L>::load(q - stride);
  }
  if (left == 1) even += Lanes<L>::load(p) * Lanes<L>::load(q);
  return even + odd;
}

/// sum_{i=1..k-1} a_i a_{k-i}, each pair once
template <int L>
KOKKOS_INLINE_FUNCTION Lanes<L> convolveSquare(const double* a, std::ptrdiff_t stride, int k) {
  Lanes<L> sum(0.0);
  for (int i = 1; 2 * i < k; ++i)
    sum += Lanes<L>::load(a + i * stride) * Lanes<L>::load(a + (k - i) * stride);
  sum *= 2.0;
  if (k % 2 == 0 && k > 0) {
    const Lanes<L> middle = Lanes<L>::load(a + k / 2 * stride);
    sum += middle * middle;
  }
  return sum;
}

/// sum_{i=1..k-1} (slope i + offset) a_i b_{k-i}
template <int L, class S>
KOKKOS_INLINE_FUNCTION Lanes<L> convolveWeighted(const double* a, const double* b, std::ptrdiff_t stride,
                                                 int k, const S& slope, double offset) {
  Lanes<L> even(0.0), odd(0.0);
  int i = 1;
  for (; i < k - 1; i += 2) {
    even += (slope * i + offset) * (Lanes<L>::load(a + i * stride) * Lanes<L>::load(b + (k - i) * stride));
    odd += (slope * (i + 1) + offset) *
           (Lanes<L>::load(a + (i + 1) * stride) * Lanes<L>::load(b + (k - i - 1) * stride));
  }
  if (i == k - 1)
    even += (slope * i + offset) * (Lanes<L>::load(a + i * stride) * Lanes<L>::load(b + stride));
  return even + odd;
}

/// The part of coefficient k of c, c' = w a', that is known before order k: (1/k) sum_{i=1..k-1} i a_i
/// w_{k-i}
template <int L>
KOKKOS_INLINE_FUNCTION Lanes<L> integrate(const double* a, const double* w, std::ptrdiff_t stride, int k) {
  return convolveWeighted<L>(a, w, stride, k, 1.0, 0.0) * (1.0 / k);
}

}  // namespace atrapos::taylor::detail
