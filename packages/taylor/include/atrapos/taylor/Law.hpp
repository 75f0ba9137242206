#pragma once

#include <Sacado.hpp>
#include <cstddef>

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
/// several points. They may depend on the law's own members.
namespace atrapos::taylor {

/// out = law(in): numInputs, numData and numOutputs doubles.
template <class Law>
KOKKOS_INLINE_FUNCTION void value(const Law& law, const double* in, const double* data, double* out) {
  law(in, data, out);
}

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

/// Executes the law once for the pass and order in context. Shapes: in[numInputs], data[numData],
/// out[numOutputs]. In Pass::Start `in` holds values; in Pass::Sweep coefficient `order` of the inputs
/// (zeros to get the nonlinear part of the outputs, paper (16)-(20)); in Pass::Complete an increment of
/// that coefficient, whose linear effect is added to the histories and returned in `out`.
/// Orders must come one after the other, each Sweep before its Completes; histories need no initial value.
/// Values outside an operation's domain give NaN or infinity in their lane.
template <int L, class Law>
KOKKOS_INLINE_FUNCTION void sweep(const Law& law, Context<L>& context, const Lanes<L>* in,
                                  const Lanes<L>* data, Lanes<L>* out) {
  context.cursor = 0;
  Sweep<L> x[Law::numInputs];
  Sweep<L> y[Law::numOutputs];
  for (int j = 0; j < Law::numInputs; ++j) {
    x[j] = Sweep<L>(in[j], &context);
    x[j].slot();  // inputs come first, in their order
  }
  law(x, data, y);
  for (int i = 0; i < Law::numOutputs; ++i) out[i] = y[i].coefficient(context.pass);
}

/// Number of history slots that one execution of the law takes, counted by executing it. Host.
template <int L, class Law>
int historySlots(const Law& law) {
  // With maxOrder = -1 slots are 0 doubles apart: all of them share this one.
  double scratch[L];
  Context<L> context{scratch, -1, 0, Pass::Start, 0};
  Lanes<L> in[Law::numInputs], data[Law::numData + 1], out[Law::numOutputs];
  for (auto& x : in) x = 1.0;
  for (auto& x : data) x = 1.0;
  sweep<L>(law, context, in, data, out);
  return context.cursor;
}

/// Number of doubles of the histories of L points.
template <int L>
constexpr std::size_t historyDoubles(int slots, int maxOrder) {
  return static_cast<std::size_t>(slots) * (maxOrder + 1) * L;
}

}  // namespace atrapos::taylor
