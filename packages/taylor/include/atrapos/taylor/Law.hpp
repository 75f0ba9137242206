#pragma once

#include <cstddef>
#include <vector>

#include "atrapos/taylor/Fad.hpp"
#include "atrapos/taylor/Functions.hpp"
#include "atrapos/taylor/Sweep.hpp"

/// A law acts at one quadrature point or contact node, is written once and used with three scalars:
///
///     struct Law {
///       static constexpr int numInputs = 2, numOutputs = 1, numData = 1;   // numData may be 0
///       double stiffness;                                                  // the same for all points
///       template <class T>
///       KOKKOS_INLINE_FUNCTION void operator()(const T* in, const Passive<T>* data, T* out) const {
///         using std::sqrt;  // for double; argument-dependent look-up finds those of Sacado and of Sweep
///         out[0] = data[0] * stiffness * sqrt(in[0] * in[0] + in[1]);
///       }
///     };
///
/// Its operations must not depend on the values of inputs or data (no branches): one execution serves
/// several points; if_then_else, min, max and abs choose point by point. They may depend on the law's own
/// members. Intermediate results are stored in a T (or a Matrix3<T>, Symmetric3<T>), never in an auto.
namespace atrapos::taylor {

/// out = law(in): numInputs, numData and numOutputs doubles.
template <class Law>
KOKKOS_INLINE_FUNCTION void value(const Law& law, const double* in, const double* data, double* out) {
  law(in, data, out);
}

#if !defined(ATRAPOS_WITHOUT_TRILINOS)
/// out = law(in) and jacobian[i * numInputs + j] = d out[i] / d in[j].
template <class Law>
KOKKOS_INLINE_FUNCTION void tangent(const Law& law, const double* in, const double* data, double* out,
                                    double* jacobian) {
  using Fad = Sacado::Fad::SFad<double, Law::numInputs>;
  Fad x[Law::numInputs];
  Fad y[Law::numOutputs];
  for (int j = 0; j < Law::numInputs; ++j) x[j] = Fad(Law::numInputs, j, in[j]);
  law(x, data, y);
  for (int i = 0; i < Law::numOutputs; ++i) {
    out[i] = y[i].val();
    for (int j = 0; j < Law::numInputs; ++j) jacobian[i * Law::numInputs + j] = y[i].dx(j);
  }
}
#endif

namespace detail {

/// Inputs of a pass: not known yet, given, or an increment of those that the sweep was given.
enum class Inputs { unknown, given, increment };

// Inlined whole, law included: only then do contexts, slots and what is constant stay out of memory.
template <class X, Inputs inputs, int L, class Law>
ATRAPOS_FLATTEN KOKKOS_INLINE_FUNCTION void execute(const Law& law, Context<L>& given,
                                                    [[maybe_unused]] const Lanes<L>* in, const Lanes<L>* data,
                                                    Lanes<L>* out) {
  Context<L> context;
  context.begin(given);
  Sweep<X> x[Law::numInputs];
  Sweep<X> y[Law::numOutputs];
  // Inputs come first, in their order. A slot that a Sweep without inputs left alone is written by Complete.
  double* slots = takeSlots<X>(context, Law::numInputs);
  ATRAPOS_UNROLL
  for (int j = 0; j < Law::numInputs; ++j) {
    double* slot = slots + j * X::lanes;
    if constexpr (inputs != Inputs::unknown) {
      x[j] = Sweep<X>(in[j], &context, slot);
      if constexpr (inputs == Inputs::increment)
        record<X::pass>(context, slot, in[j]);
      else if constexpr (X::pass != Pass::Linear)
        in[j].store(slot + context.order * context.stride);
    } else {
      x[j] = Sweep<X>::unknown(&context, slot);
    }
  }
  law(x, data, y);
  given.taken.slots = context.taken.slots;
  given.taken.constants = context.taken.constants;
  given.taken.sums = context.taken.sums;
  if (out == nullptr) return;
  ATRAPOS_UNROLL
  for (int i = 0; i < Law::numOutputs; ++i) out[i] = y[i].coefficient();
}

}  // namespace detail

/// The passes: each executes the law once at L points for the order in context. Shapes: in[numInputs],
/// data[numData], out[numOutputs]. Orders come one after the other; histories need no initial value.

/// Order 0: `in` holds values. In a lane where an operation has no series the result is NaN, with a note in
/// context.failures.
template <int L, class Law>
ATRAPOS_FORCEINLINE void start(const Law& law, Context<L>& context, const Lanes<L>* in, const Lanes<L>* data,
                               Lanes<L>* out) {
  detail::execute<Execution<L, Pass::Start>, detail::Inputs::given>(law, context, in, data, out);
}

/// Order k with coefficient k of the inputs taken as zero, because it is not known yet: `out` is the
/// nonlinear part of order k (paper (16)-(20)).
template <int L, class Law>
ATRAPOS_FORCEINLINE void sweep(const Law& law, Context<L>& context, const Lanes<L>* data, Lanes<L>* out) {
  detail::execute<Execution<L, Pass::Sweep>, detail::Inputs::unknown>(
      law, context, static_cast<const Lanes<L>*>(nullptr), data, out);
}

/// Once after such a sweep: `in` is coefficient k of the inputs. The histories become those of the true
/// series.
template <int L, class Law>
ATRAPOS_FORCEINLINE void complete(const Law& law, Context<L>& context, const Lanes<L>* in,
                                  const Lanes<L>* data) {
  detail::execute<Execution<L, Pass::Complete>, detail::Inputs::given>(law, context, in, data,
                                                                       static_cast<Lanes<L>*>(nullptr));
}

/// The same, and `out` is the linear effect of `in`.
template <int L, class Law>
ATRAPOS_FORCEINLINE void complete(const Law& law, Context<L>& context, const Lanes<L>* in,
                                  const Lanes<L>* data, Lanes<L>* out) {
  detail::execute<Execution<L, Pass::Complete>, detail::Inputs::given>(law, context, in, data, out);
}

/// Order k in one pass where coefficient k of the inputs is known, or as much of it as is.
template <int L, class Law>
ATRAPOS_FORCEINLINE void sweepKnown(const Law& law, Context<L>& context, const Lanes<L>* in,
                                    const Lanes<L>* data, Lanes<L>* out) {
  detail::execute<Execution<L, Pass::Sweep>, detail::Inputs::given>(law, context, in, data, out);
}

/// Once after sweepKnown with a part of coefficient k of the inputs: `in` is the rest of it, `out` its linear
/// effect. The histories become those of the true series.
template <int L, class Law>
ATRAPOS_FORCEINLINE void completeKnown(const Law& law, Context<L>& context, const Lanes<L>* in,
                                       const Lanes<L>* data, Lanes<L>* out) {
  detail::execute<Execution<L, Pass::Complete>, detail::Inputs::increment>(law, context, in, data, out);
}

/// After `start` with context.plain: out[i] = d out[i] / d in[column] at L points, the linear response to a
/// unit vector (docs/theory/taylor.md, Tangents in lanes). On a kink (abs, min, max) one side's, as with Fad
/// types.
template <int L, class Law>
KOKKOS_INLINE_FUNCTION void tangentColumn(const Law& law, Context<L>& context, int column,
                                          const Lanes<L>* data, Lanes<L>* out) {
  Lanes<L> unit[Law::numInputs];
  for (int i = 0; i < Law::numInputs; ++i) unit[i] = i == column ? 1.0 : 0.0;
  context.order = 1;
  detail::execute<Execution<L, Pass::Linear>, detail::Inputs::given>(law, context, unit, data, out);
}

/// out = law(in) and jacobian[i * numInputs + j] = d out[i] / d in[j] at L points. context.memory holds
/// shape.doubles<L>(0) doubles; the order is ignored.
template <int L, class Law>
KOKKOS_INLINE_FUNCTION void tangent(const Law& law, Context<L> context, const Lanes<L>* in,
                                    const Lanes<L>* data, Lanes<L>* out, Lanes<L>* jacobian) {
  context.plain = true;
  context.order = 0;
  start(law, context, in, data, out);
  for (int j = 0; j < Law::numInputs; ++j) {
    Lanes<L> column[Law::numOutputs];
    tangentColumn(law, context, j, data, column);
    for (int i = 0; i < Law::numOutputs; ++i) jacobian[i * Law::numInputs + j] = column[i];
  }
}

/// What the law needs to keep at a point, counted by executing it. Host.
template <class Law>
HistoryShape historyShape(const Law& law) {
  using X = Execution<1, Pass::Start, true>;
  constexpr int largestBlock = 16;  // slots that an operation may read at once beyond those there are
  Context<1> context;
  context.shape.slots = 64;
  for (;;) {
    std::vector<double> memory(context.shape.slots + largestBlock + Law::numInputs, 1.0);
    context.memory = memory.data();
    Lanes<1> in[Law::numInputs], data[Law::numData + 1];
    for (auto& x : in) x = 1.0;
    for (auto& x : data) x = 1.0;
    detail::execute<X, detail::Inputs::given>(law, context, in, data, static_cast<Lanes<1>*>(nullptr));
    if (context.taken.slots <= context.shape.slots) break;
    context.shape.slots = context.taken.slots;
  }
  HistoryShape shape = context.taken;
  // Orders a multiple of 16 slots (1 kB and more) apart would fall on the same few sets of a cache.
  if (shape.slots % 16 == 0) ++shape.slots;
  return shape;
}

}  // namespace atrapos::taylor
