#pragma once

#include "atrapos/taylor/FunctionPairs.hpp"
#include "atrapos/taylor/Roots.hpp"

namespace atrapos::taylor {

/// sine and cosine of one argument at the price of either:
/// s_k = (1/k) sum_{i=1..k} i a_i c_{k-i},  c_k = -(1/k) sum_{i=1..k} i a_i s_{k-i}
template <int L>
KOKKOS_INLINE_FUNCTION void sinCos(const Sweep<L>& a, Sweep<L>& sine, Sweep<L>& cosine) {
  const Lanes<L> x = a.value();
  if (a.isPassive()) {
    sine = Sweep<L>(sin(x));
    cosine = Sweep<L>(cos(x));
    return;
  }
  Lanes<L> s0(0.0), c0(0.0);
  if (detail::isStart(a)) {
    s0 = sin(x);
    c0 = cos(x);
  }
  detail::sinePair(a, s0, c0, -1.0, sine, cosine);
}

/// The same for double and Sacado types, so that a law may call sinCos (unqualified, after
/// `using atrapos::taylor::sinCos;`) with each of its scalars.
template <class T>
KOKKOS_INLINE_FUNCTION void sinCos(const T& a, T& sine, T& cosine) {
  using std::cos;
  using std::sin;
  const T x = a;
  sine = sin(x);
  cosine = cos(x);
}

template <int L>
KOKKOS_INLINE_FUNCTION Sweep<L> sin(const Sweep<L>& a) {
  Sweep<L> s, c;
  sinCos(a, s, c);
  return s;
}

template <int L>
KOKKOS_INLINE_FUNCTION Sweep<L> cos(const Sweep<L>& a) {
  Sweep<L> s, c;
  sinCos(a, s, c);
  return c;
}

/// t_k = (1/k) sum_{i=1..k} i a_i w_{k-i},  w = 1 + t^2
template <int L>
KOKKOS_INLINE_FUNCTION Sweep<L> tan(const Sweep<L>& a) {
  if (a.isPassive()) return {tan(a.value())};
  Lanes<L> t0(0.0);
  if (detail::isStart(a)) t0 = tan(a.value());
  return detail::tangentPair(a, t0, 1.0 + t0 * t0, 1.0);
}

/// c' = a' / (1 + a^2)
template <int L>
KOKKOS_INLINE_FUNCTION Sweep<L> atan(const Sweep<L>& a) {
  if (a.isPassive()) return {atan(a.value())};
  return detail::primitive(a, 1.0 / (1.0 + a * a), detail::isStart(a) ? atan(a.value()) : Lanes<L>(0.0));
}

/// c' = a' / sqrt(1 - a^2). NaN or infinity in a lane where |a_0| >= 1.
template <int L>
KOKKOS_INLINE_FUNCTION Sweep<L> asin(const Sweep<L>& a) {
  if (a.isPassive()) return {asin(a.value())};
  return detail::primitive(a, 1.0 / sqrt((1.0 - a) * (1.0 + a)),
                           detail::isStart(a) ? asin(a.value()) : Lanes<L>(0.0));
}

/// c' = -a' / sqrt(1 - a^2). NaN or infinity in a lane where |a_0| >= 1.
template <int L>
KOKKOS_INLINE_FUNCTION Sweep<L> acos(const Sweep<L>& a) {
  if (a.isPassive()) return {acos(a.value())};
  return detail::primitive(a, -1.0 / sqrt((1.0 - a) * (1.0 + a)),
                           detail::isStart(a) ? acos(a.value()) : Lanes<L>(0.0));
}

}  // namespace atrapos::taylor
