#pragma once

#include "atrapos/taylor/Lanes.hpp"

/// Sums over histories: the inner loops of every recurrence. a and b point to the order-0 lanes of a slot.
namespace atrapos::taylor::detail {

/// sum_{i=first..last} a_i b_{k-i}
template <int L>
KOKKOS_INLINE_FUNCTION Lanes<L> convolve(const double* a, const double* b, int first, int last, int k) {
  using R = Register<L>;
  // Two accumulators: one alone would wait for the latency of the fused multiply-add.
  R even = R::fill(0), odd = R::fill(0);
  int i = first;
  for (; i < last; i += 2) {
    even = even + R::load(a + i * L) * R::load(b + (k - i) * L);
    odd = odd + R::load(a + (i + 1) * L) * R::load(b + (k - i - 1) * L);
  }
  if (i == last) even = even + R::load(a + i * L) * R::load(b + (k - i) * L);
  return toLanes(even + odd);
}

/// sum_{i=first..k-first} a_i a_{k-i}, each pair once
template <int L>
KOKKOS_INLINE_FUNCTION Lanes<L> convolveSquare(const double* a, int first, int k) {
  const int half = (k - 1) / 2;
  Lanes<L> sum = 2.0 * convolve<L>(a, a, first, half, k);
  if (k % 2 == 0 && k / 2 >= first) {
    const Lanes<L> middle = load<L>(a + (k / 2) * L);
    sum += middle * middle;
  }
  return sum;
}

/// sum_{i=first..last} (slope i + offset) a_i b_{k-i}
template <int L>
KOKKOS_INLINE_FUNCTION Lanes<L> convolveWeighted(const double* a, const double* b, int first, int last, int k,
                                                 double slope, double offset) {
  using R = Register<L>;
  R even = R::fill(0), odd = R::fill(0);
  int i = first;
  for (; i < last; i += 2) {
    even = even + R::fill(slope * i + offset) * R::load(a + i * L) * R::load(b + (k - i) * L);
    odd = odd + R::fill(slope * (i + 1) + offset) * R::load(a + (i + 1) * L) * R::load(b + (k - i - 1) * L);
  }
  if (i == last) even = even + R::fill(slope * i + offset) * R::load(a + i * L) * R::load(b + (k - i) * L);
  return toLanes(even + odd);
}

/// Coefficient k >= 1 of c with c' = w a':  (1/k) sum_{i=1..k} i a_i w_{k-i}
template <int L>
KOKKOS_INLINE_FUNCTION Lanes<L> integrate(const double* a, const double* w, int k) {
  return convolveWeighted<L>(a, w, 1, k, k, 1.0, 0.0) * (1.0 / k);
}

}  // namespace atrapos::taylor::detail
