#pragma once

#include "atrapos/taylor/Sweep.hpp"

/// The recurrences that circular and hyperbolic functions share, each through c' = w a'. Arguments named ..0
/// are order 0 and used in Pass::Start only.
namespace atrapos::taylor::detail {

// s' = c a', c' = sign s a'
template <int L>
KOKKOS_INLINE_FUNCTION void sinePair(const Sweep<L>& a, const Lanes<L>& s0, const Lanes<L>& c0, double sign,
                                     Sweep<L>& sine, Sweep<L>& cosine) {
  Context<L>& context = *a.context();
  const double* as = a.slot();
  double* ss = takeSlot(context);
  double* cs = takeSlot(context);
  Lanes<L> s, c;
  switch (context.pass) {
    case Pass::Start:
      s = s0;
      c = c0;
      break;
    case Pass::Sweep:
      s = integrate<L>(as, cs, context.order);
      c = sign * integrate<L>(as, ss, context.order);
      break;
    default:
      s = load<L>(cs) * a.value();
      c = sign * load<L>(ss) * a.value();
  }
  record(context, ss, s);
  record(context, cs, c);
  sine = Sweep<L>(s, &context, ss);
  cosine = Sweep<L>(c, &context, cs);
}

// t' = w a', w = 1 + sign t^2
template <int L>
KOKKOS_INLINE_FUNCTION Sweep<L> tangentPair(const Sweep<L>& a, const Lanes<L>& t0, const Lanes<L>& w0,
                                            double sign) {
  Context<L>& context = *a.context();
  const double* as = a.slot();
  double* ts = takeSlot(context);
  double* ws = takeSlot(context);
  Lanes<L> t, w;
  switch (context.pass) {
    case Pass::Start:
      t = t0;
      w = w0;
      record(context, ts, t);
      break;
    case Pass::Sweep:
      t = integrate<L>(as, ws, context.order);
      record(context, ts, t);  // before w, whose sum runs up to the t of this order
      w = sign * convolveSquare<L>(ts, 0, context.order);
      break;
    default:
      t = load<L>(ws) * a.value();
      record(context, ts, t);
      w = 2.0 * sign * load<L>(ts) * t;
  }
  record(context, ws, w);
  return {t, &context, ts};
}

// c' = w a' where w is itself a series that the law's own operations compute
template <int L>
KOKKOS_INLINE_FUNCTION Sweep<L> primitive(const Sweep<L>& a, const Sweep<L>& w, const Lanes<L>& c0) {
  Context<L>& context = *a.context();
  const double* as = a.slot();
  const double* ws = w.slot();
  switch (context.pass) {
    case Pass::Start:
      return {c0, &context};
    case Pass::Sweep:
      return {integrate<L>(as, ws, context.order), &context};
    default:
      return {load<L>(ws) * a.value(), &context};
  }
}

template <int L>
KOKKOS_FORCEINLINE_FUNCTION bool isStart(const Sweep<L>& a) {
  return a.context()->pass == Pass::Start;
}

}  // namespace atrapos::taylor::detail
