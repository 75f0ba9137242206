#pragma once

#include "atrapos/solid/ShellStages.hpp"
#include "atrapos/solid/ThinKinematics.hpp"

namespace atrapos::solid {

namespace detail {

/// Rates of (gamma; plastic strain along the bar; chi) under uniaxial stress, chi = 3/2 X_11: those of
/// FlowRule there.
template <bool kinematic>
struct BarFlowRule {
  static constexpr int numVariables = kinematic ? 3 : 2;
  Metal metal;

  ATRAPOS_FORCEINLINE double youngsModulus() const {
    return metal.mu * (3 * metal.lambda + 2 * metal.mu) / (metal.lambda + metal.mu);
  }
  /// S_11 - chi.
  template <class T>
  ATRAPOS_FORCEINLINE T relativeStress(const T* E, const T* z) const {
    T xi = youngsModulus() * (E[0] - z[1]);
    if constexpr (kinematic) xi = xi - z[2];
    return xi;
  }

  template <class T, class P, class R>
  KOKKOS_INLINE_FUNCTION void operator()(const T* E, const T* z, const P* data, const R* dE, const R* dz,
                                         R* g) const {
    const T xi = relativeStress(E, z);
    const Yielding<T> y(metal, T(xi * xi), z[0], data[0]);
    const T direction = xi / y.size;
    // FlowRule's D with what moves across put in: E takes the place of 3 mu where all flows.
    T resistance = y.hardening + (3 * metal.mu + metal.kinematicModulus) -
                   (3 * metal.mu - youngsModulus()) * (y.share * y.ratio);
    if constexpr (kinematic) resistance = resistance - metal.recall * (direction * z[2]);
    const T pushed = youngsModulus() * (y.share * direction) / resistance;
    const R flow = pushed * dE[0];
    g[0] = dz[0] - y.ratio * flow;
    g[1] = dz[1] - direction * flow;
    if constexpr (kinematic) g[2] = dz[2] - metal.kinematicModulus * dz[1] + metal.recall * z[2] * dz[0];
  }
};

}  // namespace detail

/// A metal in a bar (docs/theory/plasticity.md). in: the strain, 6, of which the first counts; out: the
/// stress, 6, the event function; gamma, p, chi. data: 1 where the point yields, else 0; the variables.
template <bool kinematic>
struct BarMetalStage {
  using Flow = detail::BarFlowRule<kinematic>;
  static constexpr bool stage = true, symmetric = true;
  static constexpr int numVariables = Flow::numVariables, numEvents = 1;
  static constexpr int numInputs = 6, numOutputs = 7 + numVariables, numData = 1 + numVariables;

  Metal metal;

  bool freeGrow() const { return metal.isSmoothed(); }

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* in, const taylor::Passive<T>* data, T* out) const {
    T* const z = out + 7;
    for (int i = 0; i < numVariables; ++i) z[i] = T(data[1 + i]);
    const Flow flow{metal};
    taylor::solveRate<1, numVariables, 1>(flow, in, data, z);
    out[0] = flow.youngsModulus() * (in[0] - z[1]);
    for (int m = 1; m < 6; ++m) out[m] = T(0.0);
    const T xi = flow.relativeStress(in, z);
    const T square = xi * xi;
    out[6] = metal.event(square, z[0], data[0]);
  }
};

}  // namespace atrapos::solid

#define ATRAPOS_THIN_STAGES(MACRO)                       \
  ATRAPOS_SHELL_STAGES(MACRO, MembraneKinematics<true>)  \
  ATRAPOS_SHELL_STAGES(MACRO, MembraneKinematics<false>) \
  ATRAPOS_SHELL_STAGES(MACRO, BarKinematics<true>)       \
  ATRAPOS_SHELL_STAGES(MACRO, BarKinematics<false>)      \
  MACRO(atrapos::solid::BarMetalStage<false>) MACRO(atrapos::solid::BarMetalStage<true>)

ATRAPOS_THIN_STAGES(ATRAPOS_DECLARE_POINT_LAW)
