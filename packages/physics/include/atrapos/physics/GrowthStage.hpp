#pragma once

#include "atrapos/fem/PointLaw.hpp"
#include "atrapos/formula/Program.hpp"
#include "atrapos/physics/Formulas.hpp"

namespace atrapos::physics {

/// How much lengths grow in a shell, by a formula. in: the fields, of which those that there are none of are
/// not read, and the load factor; out: e, and 0, for nothing acts on fields; data: the place x, y, z, and
/// zeta through the thickness.
struct GrowthStage {
  static constexpr bool stage = true, symmetric = false;
  static constexpr int numInputs = mostFields + 1, numOutputs = 2, numData = 4;

  formula::Program program;

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* in, const taylor::Passive<T>* data, T* out) const {
    T e[1];
    formula::evaluate(program, in, data, e);
    out[0] = e[0];
    out[1] = T(0.0);
  }
};

}  // namespace atrapos::physics

ATRAPOS_DECLARE_POINT_LAW(atrapos::physics::GrowthStage)
