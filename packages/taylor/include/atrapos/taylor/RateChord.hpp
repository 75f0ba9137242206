#pragma once

#include "atrapos/taylor/Rate.hpp"

/// Internal variables away from the path: integrated along the straight line from a state on it
/// (docs/theory/taylor.md, Off the path).
namespace atrapos::taylor {

/// Order of the series along a chord: with K orders a step may be eps^(1/K) of the radius long and costs
/// about K^2; K = -ln(eps)/2 makes the whole way cheapest.
constexpr int chordOrder = 18;

namespace detail {

// Inputs v, data (the rate law's data, z on entry), outputs z.
template <int NV, int NZ, int ND, class G>
struct ChordLaw {
  static constexpr int numInputs = NV, numOutputs = NZ, numData = ND + NZ, numVariables = NZ;
  G rate;
  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* in, const Passive<T>* data, T* out) const {
    for (int j = 0; j < NZ; ++j) out[j] = T(data[ND + j]);
    if constexpr (ND > 0)
      solveRate<NV, NZ, ND>(rate, in, data, out);
    else
      solveRate<NV, NZ>(rate, in, out);
  }
};

template <int NZ, int L>
using ChordSeries = Lanes<L>[NZ][chordOrder + 1];

/// The last two terms of the series at h over what rounding leaves of its largest, the most of all z: up to 1
/// the series is at its end.
template <int NZ, int L>
KOKKOS_INLINE_FUNCTION double chordRemainder(const ChordSeries<NZ, L>& z, int lane, double h) {
  constexpr double eps = std::numeric_limits<double>::epsilon();
  double remainder = 0;
  for (int j = 0; j < NZ; ++j) {
    double largest = 0, last = 0, power = 1;
    for (int k = 0; k <= chordOrder; ++k, power *= h) {
      const double term = std::fabs(z[j][k][lane]) * power;
      if (!std::isfinite(term)) return std::numeric_limits<double>::infinity();
      double& size = k < chordOrder - 1 ? largest : last;
      if (term > size) size = term;
    }
    if (last > remainder * eps * largest) remainder = last / (eps * largest);
  }
  return remainder;
}

/// The longest step up to `rest` at whose end the series is at its own, 0 where there is none.
template <int NZ, int L>
KOKKOS_INLINE_FUNCTION double chordStep(const ChordSeries<NZ, L>& z, int lane, double rest) {
  constexpr double least = 1e-12;  // of the chord
  double h = rest, remainder;
  while ((remainder = chordRemainder<NZ, L>(z, lane, h)) > 1) {
    // The remainder falls about like h^K.
    const double shorter = std::isfinite(remainder) ? std::pow(remainder, -1.0 / chordOrder) : 0.5;
    h *= shorter < 0.95 ? shorter : 0.95;
    if (h < least) return 0;
  }
  return h;
}

/// All orders of z from the point `at` of a chord of direction dv on.
template <int L, class Law, int NZ = Law::numVariables>
KOKKOS_INLINE_FUNCTION void chordSeries(const Law& law, Context<L>& context, const Lanes<L>* at,
                                        const Lanes<L>* dv, const Lanes<L>* data, ChordSeries<NZ, L>& z) {
  constexpr int NV = Law::numInputs, first = Law::numOutputs - NZ;
  Lanes<L> out[Law::numOutputs], still[NV];
  for (int j = 0; j < NV; ++j) still[j] = 0.0;
  for (int k = 0; k <= chordOrder; ++k) {
    context.order = k;
    if (k == 0)
      start(law, context, at, data, out);
    else
      sweepKnown(law, context, k == 1 ? dv : still, data, out);
    for (int j = 0; j < NZ; ++j) z[j][k] = out[first + j];
  }
}

/// How far L points have come on their chords. A lane that has arrived stays where its last series began: at
/// the end of the chord there need not be one.
template <int NV, int NZ, int ND, int L>
struct ChordWalk {
  Lanes<L> at[NV], dv[NV], data[ND + NZ];  ///< data: passive ones, then z there
  Lanes<L> series[NZ][chordOrder + 1];
  bool good = true;

  KOKKOS_INLINE_FUNCTION ChordWalk(const Lanes<L>* from, const Lanes<L>* to, const Lanes<L>* passive,
                                   const Lanes<L>* z)
      : from_(from) {
    for (int l = 0; l < L; ++l) arrived_[l] = true;
    for (int j = 0; j < NV; ++j) {
      at[j] = from[j];
      dv[j] = to[j] - from[j];
      for (int l = 0; l < L; ++l) arrived_[l] = arrived_[l] && dv[j][l] == 0;
    }
    for (int j = 0; j < ND; ++j) data[j] = passive[j];
    for (int j = 0; j < NZ; ++j) data[ND + j] = z[j];
  }

  KOKKOS_INLINE_FUNCTION bool underWay() const {
    bool any = false;
    for (int l = 0; l < L; ++l) any = any || !arrived_[l];
    return any;
  }

  /// One sub-step of a lane, with `series` from where it is.
  KOKKOS_INLINE_FUNCTION void advance(int lane, Failures<L>* failures, Lanes<L>* z) {
    if (arrived_[lane]) return;
    const double rest = 1 - reached_[lane];
    const double h = chordStep<NZ, L>(series, lane, rest);
    if (h == 0) return giveUp(lane, failures, z);
    arrived_[lane] = h == rest;
    for (int j = 0; j < NZ; ++j) {
      double sum = 0;
      for (int k = chordOrder; k >= 0; --k) sum = sum * h + series[j][k][lane];
      z[j][lane] = sum;
      if (!arrived_[lane]) data[ND + j][lane] = sum;
    }
    if (arrived_[lane]) return;
    reached_[lane] += h;
    for (int j = 0; j < NV; ++j) at[j][lane] = from_[j][lane] + reached_[lane] * dv[j][lane];
  }

  /// Ends a lane that has not arrived. What Start noted there comes first.
  KOKKOS_INLINE_FUNCTION void giveUp(int lane, Failures<L>* failures, Lanes<L>* z) {
    if (arrived_[lane]) return;
    if (failures != nullptr) failures->note(lane, Operation::Chord, reached_[lane]);
    for (int j = 0; j < NZ; ++j) z[j][lane] = notANumber;
    arrived_[lane] = true;
    good = false;
  }

 private:
  const Lanes<L>* from_;
  double reached_[L] = {};
  bool arrived_[L];
};

}  // namespace detail

/// What integrateRate needs to keep at a point: shape.doubles<L>(chordOrder, 0) doubles. Host; once a law.
template <int NV, int NZ, int ND = 0, class G>
HistoryShape chordShape(const G& g) {
  return historyShape(detail::ChordLaw<NV, NZ, ND, G>{g});
}

/// The internal variables of a law (Law::numVariables: its last data, and its last outputs) at the inputs
/// `to`, along the straight line from the inputs `from`: z is their state there on entry and that at `to` on
/// exit, a function of from, to, z and data (the others) alone, whatever the other lanes hold. Series of
/// chordOrder orders, in sub-steps that each lane chooses. Where from = to, z stays, and the law is not
/// looked at.
///
/// context.memory holds historyShape(law).doubles<L>(chordOrder, 0) doubles of scratch, context.shape is that
/// shape; order and plain are ignored. False, with NaN in z and a note in context.failures (lanes concerned),
/// where the law has no series on the way or where maxSteps sub-steps are not enough: a singularity, or a
/// chord much longer than the radii on it.
template <int L, class Law>
KOKKOS_INLINE_FUNCTION bool carryVariables(const Law& law, Context<L> context, const Lanes<L>* from,
                                           const Lanes<L>* to, const Lanes<L>* data, Lanes<L>* z,
                                           int maxSteps = 1000) {
  constexpr int NZ = Law::numVariables;
  context.plain = false;
  context.block = OrderBlock{};
  context.waiting = 0;
  detail::ChordWalk<Law::numInputs, NZ, Law::numData - NZ, L> walk(from, to, data, z);
  for (int step = 0; step < maxSteps && walk.underWay(); ++step) {
    detail::chordSeries<L>(law, context, walk.at, walk.dv, walk.data, walk.series);
    for (int l = 0; l < L; ++l) walk.advance(l, context.failures, z);
  }
  for (int l = 0; l < L; ++l) walk.giveUp(l, context.failures, z);
  return walk.good;
}

/// z at `to` by the rate law g (solveRate) alone along the straight chord v = from + a (to - from),
/// 0 <= a <= 1, at L points, to rounding (carryVariables): context.shape is chordShape of g. The derivative
/// of z by `to` is not given, and is the tangent of solveRate only in the limit of a short chord.
template <int NV, int NZ, int ND, int L, class G>
KOKKOS_INLINE_FUNCTION bool integrateRate(const G& g, Context<L> context, const Lanes<L>* from,
                                          const Lanes<L>* to, const Lanes<L>* data, Lanes<L>* z,
                                          int maxSteps = 1000) {
  return carryVariables<L>(detail::ChordLaw<NV, NZ, ND, G>{g}, context, from, to, data, z, maxSteps);
}

/// The same at one point.
template <int NV, int NZ, int ND = 0, class G>
KOKKOS_INLINE_FUNCTION bool integrateRate(const G& g, const Context<1>& context, const double* from,
                                          const double* to, const double* data, double* z,
                                          int maxSteps = 1000) {
  Lanes<1> v0[NV], v1[NV], lane[NZ], datum[ND + 1] = {};
  for (int j = 0; j < NV; ++j) {
    v0[j] = from[j];
    v1[j] = to[j];
  }
  for (int j = 0; j < ND; ++j) datum[j] = data[j];
  for (int j = 0; j < NZ; ++j) lane[j] = z[j];
  const bool good = integrateRate<NV, NZ, ND>(g, context, v0, v1, datum, lane, maxSteps);
  for (int j = 0; j < NZ; ++j) z[j] = lane[j][0];
  return good;
}

}  // namespace atrapos::taylor
