#pragma once

#include "atrapos/solid/ShellStages.hpp"

namespace atrapos::solid::test {

/// The stages of a metal in a shell as one law, as shellMetalLaw has them.
template <class Kinematics, bool kinematic = true>
struct WholeMetal {
  using Stage = ShellMetalStage<kinematic>;
  static constexpr int n = Kinematics::numInputs, numVariables = Stage::numVariables, numEvents = 1;
  static constexpr int firstVariable = 1 + Kinematics::numData;
  static constexpr int numInputs = n, numOutputs = n + 1 + numVariables,
                       numData = firstVariable + numVariables;
  static constexpr bool symmetric = true;
  Metal metal;

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* in, const taylor::Passive<T>* data, T* out) const {
    T E[6], stage[Stage::numOutputs];
    taylor::Passive<T> own[Stage::numData];
    own[0] = data[0];
    for (int v = 0; v < numVariables; ++v) own[1 + v] = data[firstVariable + v];
    Kinematics::strain(in, data + 1).store(E);
    Stage{metal}(E, own, stage);
    Kinematics::forces(in, taylor::Symmetric3<T>(stage), data + 1, out);
    for (int o = 0; o <= numVariables; ++o) out[n + o] = stage[6 + o];
  }
};

}  // namespace atrapos::solid::test
