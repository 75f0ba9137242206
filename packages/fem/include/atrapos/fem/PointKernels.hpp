#pragma once

#include <type_traits>

#include "atrapos/fem/PointLaw.hpp"
#include "atrapos/taylor/RateChord.hpp"

namespace atrapos::fem::detail {

/// A law's passes over a batch of points, compiled for one instruction set.
struct PointKernels {
  /// Values, and derivatives by the inputs first .. first + count - 1; count = 0: values alone.
  void (*tangent)(const void* law, const taylor::HistoryShape&, const PointBatch&, int first, int count,
                  const double* in, double* out, double* jacobian);
  void (*start)(const void* law, const taylor::HistoryShape&, const PointBatch&, const SeriesOrder&,
                const double* in, double* out, PointFailure& failure);
  void (*advance)(const void* law, const taylor::HistoryShape&, const PointBatch&, const SeriesOrder&,
                  PointLaw::In in, PointLaw::Out out);
  /// Null of a law without internal variables.
  void (*carry)(const void* law, const taylor::HistoryShape&, const PointBatch&, const double* from,
                const double* to, double* variables, PointFailure& failure);
};

/// How many of a law's data and outputs, the last ones, are internal variables.
template <class Law, class = void>
struct NumVariables : std::integral_constant<int, 0> {};
template <class Law>
struct NumVariables<Law, std::void_t<decltype(Law::numVariables)>>
    : std::integral_constant<int, Law::numVariables> {};

/// Whether a law stands behind others (stagedLaw).
template <class Law, class = void>
struct IsStage : std::false_type {};
template <class Law>
struct IsStage<Law, std::void_t<decltype(Law::stage)>> : std::integral_constant<bool, Law::stage> {};

/// Those of a law for L lanes: defined where they are compiled.
template <class Law, int L>
struct PointKernelsOf {
  static PointKernels table();
};

#ifndef ATRAPOS_KERNEL_LEVELS
/// Nothing but arithmetic on the caller's arrays: what is compiled for another instruction set than the rest
/// of the program must share no function with it.
template <class Law, int L>
struct PointPasses {
  using Pack = taylor::Lanes<L>;
  static constexpr int I = Law::numInputs, O = Law::numOutputs, D = Law::numData,
                       V = NumVariables<Law>::value;
  static constexpr int groups = kLanes / L;  ///< of L lanes, in a batch
  static_assert(kLanes % L == 0, "a batch is a number of whole registers");

  /// `count` entries of L lanes from or to [entry][kLanes].
  static ATRAPOS_FORCEINLINE void load(const double* from, int count, Pack* to) {
    for (int m = 0; m < count; ++m) to[m] = Pack::load(from + m * kLanes);
  }
  static ATRAPOS_FORCEINLINE void store(const Pack* from, int count, double* to) {
    for (int m = 0; m < count; ++m) from[m].store(to + m * kLanes);
  }
  static ATRAPOS_FORCEINLINE void loadData(const PointBatch& points, int q, int s, Pack* data) {
    if constexpr (D > 0)
      load(points.data + q * D * kLanes + s, D, data);
    else
      data[0] = Pack(0.0);  // never read
  }

  static ATRAPOS_FORCEINLINE taylor::Context<L> scratch(const taylor::HistoryShape& shape, double* memory) {
    taylor::Context<L> c;
    c.memory = memory;
    c.shape = shape;
    c.plain = true;
    return c;
  }

  // The law at order 0 stands here alone.
  ATRAPOS_NOINLINE static void evaluate(const Law& law, taylor::Context<L>& context, const Pack* in,
                                        const Pack* data, Pack* out) {
    taylor::start(law, context, in, data, out);
  }

  static void tangent(const void* law, const taylor::HistoryShape& shape, const PointBatch& points, int first,
                      int count, const double* in, double* out, double* jacobian) {
    for (int q = 0; q < points.numPoints; ++q)
      for (int s = 0; s < points.lanes; s += L) {
        Pack x[I], y[O], data[D + 1];
        load(in + q * I * kLanes + s, I, x);
        loadData(points, q, s, data);
        auto context = scratch(shape, points.memory);
        context.valuesOnly = count == 0;
        evaluate(*static_cast<const Law*>(law), context, x, data, y);
        store(y, O, out + q * O * kLanes + s);
        for (int j = 0; j < count; ++j) {
          taylor::tangentColumn(*static_cast<const Law*>(law), context, first + j, data, y);
          for (int i = 0; i < O; ++i) y[i].store(jacobian + ((q * O + i) * count + j) * kLanes + s);
        }
      }
  }

  static taylor::Context<L> series(const taylor::HistoryShape& shape, const PointBatch& points, int q, int s,
                                   const SeriesOrder& order, int k) {
    const auto doubles = static_cast<std::ptrdiff_t>(shape.doubles<L>(order.maxOrder, order.waiting));
    taylor::Context<L> c;
    c.memory = points.memory + (q * groups + s / L) * doubles;
    c.shape = shape;
    c.order = k;
    c.block = order.block;
    c.waiting = order.waiting;
    c.ahead = doubles;
    return c;
  }

  static void start(const void* law, const taylor::HistoryShape& shape, const PointBatch& points,
                    const SeriesOrder& order, const double* in, double* out, PointFailure& first) {
    for (int q = 0; q < points.numPoints; ++q)
      for (int s = 0; s < points.lanes; s += L) {
        Pack x[I], y[O], data[D + 1];
        load(in + q * I * kLanes + s, I, x);
        loadData(points, q, s, data);
        taylor::Failures<L> noted;
        auto context = series(shape, points, q, s, order, 0);
        context.failures = &noted;
        evaluate(*static_cast<const Law*>(law), context, x, data, y);
        store(y, O, out + q * O * kLanes + s);
        note(y, O, points, q, s, noted, first);
      }
  }

  /// The first point whose results are not numbers.
  static ATRAPOS_FORCEINLINE void note(const Pack* y, int count, const PointBatch& points, int q, int s,
                                       const taylor::Failures<L>& noted, PointFailure& first) {
    for (int lane = 0; lane < L && s + lane < points.lanes && first.lane < 0; ++lane)
      for (int m = 0; m < count; ++m)
        if (y[m][lane] != y[m][lane]) {
          const bool named = noted.operation[lane] != taylor::Operation::None;
          first = {s + lane, q, named ? noted.operation[lane] : taylor::Operation::Result, noted.value[lane]};
          break;
        }
  }

  static void carry(const void* law, const taylor::HistoryShape& shape, const PointBatch& points,
                    const double* from, const double* to, double* variables, PointFailure& first) {
    if constexpr (V > 0)
      for (int q = 0; q < points.numPoints; ++q)
        for (int s = 0; s < points.lanes; s += L) {
          Pack x[I], y[I], data[D + 1];
          load(from + q * I * kLanes + s, I, x);
          load(to + q * I * kLanes + s, I, y);
          loadData(points, q, s, data);
          // Lanes beyond the last entity need not hold what a law makes sense of.
          for (int lane = points.lanes - s; lane < L; ++lane)
            for (int m = 0; m < I; ++m) y[m][lane] = x[m][lane];
          taylor::Failures<L> noted;
          auto context = scratch(shape, points.memory);
          context.failures = &noted;
          Pack* z = data + D - V;
          taylor::carryVariables<L>(*static_cast<const Law*>(law), context, x, y, data, z);
          store(z, V, variables + q * V * kLanes + s);
          note(z, V, points, q, s, noted, first);
        }
  }

  static void advance(const void* law, const taylor::HistoryShape& shape, const PointBatch& points,
                      const SeriesOrder& order, PointLaw::In in, PointLaw::Out out) {
    const Law& own = *static_cast<const Law*>(law);
    for (int q = 0; q < points.numPoints; ++q)
      for (int s = 0; s < points.lanes; s += L) {
        Pack x[I], y[O], data[D + 1];
        loadData(points, q, s, data);
        if (order.k > 1) {
          load(in.last + q * I * kLanes + s, I, x);
          auto previous = series(shape, points, q, s, order, order.k - 1);
          if constexpr (IsStage<Law>::value)
            taylor::completeKnown(own, previous, x, data, y);
          else if constexpr (V > 0)
            taylor::complete(own, previous, x, data, y);
          else
            taylor::complete(own, previous, x, data);
          if constexpr (IsStage<Law>::value || V > 0)
            if (out.last != nullptr) store(y, O, out.last + q * O * kLanes + s);
        }
        if constexpr (IsStage<Law>::value || V > 0)
          if (out.current == nullptr) continue;
        auto context = series(shape, points, q, s, order, order.k);
        if constexpr (IsStage<Law>::value) {
          for (int j = 0; j < I; ++j)
            x[j] = in.current != nullptr ? Pack::load(in.current + (q * I + j) * kLanes + s) : Pack(0.0);
          taylor::sweepKnown(own, context, x, data, y);
        } else {
          taylor::sweep(own, context, data, y);
        }
        store(y, O, out.current + q * O * kLanes + s);
      }
  }
};

template <class Law, int L>
PointKernels PointKernelsOf<Law, L>::table() {
  using Passes = PointPasses<Law, L>;
  return {Passes::tangent, Passes::start, Passes::advance, Passes::V > 0 ? Passes::carry : nullptr};
}
#endif

}  // namespace atrapos::fem::detail
