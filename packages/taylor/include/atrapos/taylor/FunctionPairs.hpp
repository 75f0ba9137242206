#pragma once

#include "atrapos/taylor/Sweep.hpp"

/// The recurrences that several functions share, each through c' = w a'. Arguments named ..0 are order 0 and
/// count in Pass::Start only.
namespace atrapos::taylor::detail {

template <class X>
ATRAPOS_FORCEINLINE bool isStart(const Sweep<X>&) {
  return X::pass == Pass::Start;
}

// s' = c a', c' = sign s a'
template <class X>
KOKKOS_INLINE_FUNCTION void sinePair(const Sweep<X>& a, const LanesOf<X>& s0, const LanesOf<X>& c0,
                                     double sign, Sweep<X>& sine, Sweep<X>& cosine) {
  Context<X::lanes>& context = *a.context();
  const LanesOf<X> ak = a.value();
  const double* as = a.slot();
  double* ss = takeSlots<X>(context, 2);
  double* cs = ss + X::lanes;
  LanesOf<X> s, c;
  if (X::pass == Pass::Start) {
    s = s0;
    c = c0;
  } else {
    s = ak * LanesOf<X>::load(cs);
    c = ak * LanesOf<X>::load(ss);
    if (X::pass == Pass::Sweep) {
      // Both sums in one loop: the weighted coefficients of a are read once.
      LanesOf<X> sumS(0.0), sumC(0.0);
      const int k = context.order;
      for (int i = 1; i < k; ++i) {
        const LanesOf<X> slope = static_cast<double>(i) * LanesOf<X>::load(as + i * context.stride);
        sumS += slope * LanesOf<X>::load(cs + (k - i) * context.stride);
        sumC += slope * LanesOf<X>::load(ss + (k - i) * context.stride);
      }
      s += sumS * (1.0 / k);
      c += sumC * (1.0 / k);
    }
    c = sign * c;
  }
  record<X::pass>(context, ss, s);
  record<X::pass>(context, cs, c);
  sine = Sweep<X>(s, &context, ss);
  cosine = Sweep<X>(c, &context, cs);
}

// t' = w a', w = 1 + sign t^2
template <class X>
KOKKOS_INLINE_FUNCTION Sweep<X> tangentPair(const Sweep<X>& a, const LanesOf<X>& t0, const LanesOf<X>& w0,
                                            double sign) {
  Context<X::lanes>& context = *a.context();
  const double* as = a.slot();
  double* ts = takeSlots<X>(context, 2);
  double* ws = ts + X::lanes;
  LanesOf<X> t, w;
  if (X::pass == Pass::Start) {
    t = t0;
    w = w0;
  } else {
    t = a.value() * LanesOf<X>::load(ws);
    if (X::pass == Pass::Sweep) t += integrate<X::lanes>(as, ws, context.stride, context.order);
    w = 2.0 * LanesOf<X>::load(ts) * t;
    if (X::pass == Pass::Sweep) w += convolveSquare<X::lanes>(ts, context.stride, context.order);
    w = sign * w;
  }
  record<X::pass>(context, ts, t);
  record<X::pass>(context, ws, w);
  return {t, &context, ts};
}

// c' = factor w a' where w is itself a series that the law's own operations compute
template <class X>
KOKKOS_INLINE_FUNCTION Sweep<X> primitive(const Sweep<X>& a, const Sweep<X>& w, const LanesOf<X>& c0,
                                          double factor = 1.0) {
  Context<X::lanes>& context = *a.context();
  const double* as = a.slot();
  const double* ws = w.slot();
  if (X::pass == Pass::Start) return {c0, &context};
  LanesOf<X> c = a.value() * LanesOf<X>::load(ws);
  if (X::pass == Pass::Sweep) c += integrate<X::lanes>(as, ws, context.stride, context.order);
  return {factor * c, &context};
}

}  // namespace atrapos::taylor::detail
