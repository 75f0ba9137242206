#pragma once

#include "atrapos/fem/PointLaw.hpp"
#include "atrapos/formula/Program.hpp"

namespace atrapos::physics {

/// How much lengths grow in a shell, by a formula. in: the load factor; out: e; data: the place x, y, z, and
/// zeta through the thickness.
struct GrowthStage {
  static constexpr bool stage = true, symmetric = false;
  static constexpr int numInputs = 1, numOutputs = 1, numData = 4;

  formula::Program program;

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* in, const taylor::Passive<T>* data, T* out) const {
    formula::evaluate(program, in, data, out);
  }
};

}  // namespace atrapos::physics

ATRAPOS_DECLARE_POINT_LAW(atrapos::physics::GrowthStage)
