#pragma once

#include "atrapos/taylor/FunctionPairs.hpp"

namespace atrapos::taylor {

/// sinh and cosh of one argument at the price of either:
/// s_k = (1/k) sum_{i=1..k} i a_i c_{k-i},  c_k = (1/k) sum_{i=1..k} i a_i s_{k-i}
template <int L>
KOKKOS_INLINE_FUNCTION void sinhCosh(const Sweep<L>& a, Sweep<L>& sine, Sweep<L>& cosine) {
  const Lanes<L> x = a.value();
  if (a.isPassive()) {
    sine = Sweep<L>(sinh(x));
    cosine = Sweep<L>(cosh(x));
    return;
  }
  Lanes<L> s0(0.0), c0(0.0);
  if (detail::isStart(a)) {
    s0 = sinh(x);
    c0 = cosh(x);
  }
  detail::sinePair(a, s0, c0, 1.0, sine, cosine);
}

/// The same for double and Sacado types.
template <class T>
KOKKOS_INLINE_FUNCTION void sinhCosh(const T& a, T& sine, T& cosine) {
  using std::cosh;
  using std::sinh;
  const T x = a;
  sine = sinh(x);
  cosine = cosh(x);
}

template <int L>
KOKKOS_INLINE_FUNCTION Sweep<L> sinh(const Sweep<L>& a) {
  Sweep<L> s, c;
  sinhCosh(a, s, c);
  return s;
}

template <int L>
KOKKOS_INLINE_FUNCTION Sweep<L> cosh(const Sweep<L>& a) {
  Sweep<L> s, c;
  sinhCosh(a, s, c);
  return c;
}

/// t_k = (1/k) sum_{i=1..k} i a_i w_{k-i},  w = 1 - t^2
template <int L>
KOKKOS_INLINE_FUNCTION Sweep<L> tanh(const Sweep<L>& a) {
  if (a.isPassive()) return {tanh(a.value())};
  Lanes<L> t0(0.0), w0(0.0);
  if (detail::isStart(a)) {
    t0 = tanh(a.value());
    const Lanes<L> c = cosh(a.value());
    w0 = 1.0 / (c * c);  // 1 - t^2 would cancel where |t| is near 1
  }
  return detail::tangentPair(a, t0, w0, -1.0);
}

}  // namespace atrapos::taylor
