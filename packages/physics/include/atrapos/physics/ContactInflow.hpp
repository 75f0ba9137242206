#pragma once

#include "atrapos/fem/PointLaw.hpp"
#include "atrapos/formula/Program.hpp"
#include "atrapos/physics/Formulas.hpp"

namespace atrapos::physics {

/// What flows into a body through a contact, by a formula (contact::Passage).
///
/// in:   the fields, the load factor, the contact's pressure and gap; fields that the place has none of are
///       not read
/// data: the place x, y, z
/// out:  -q
struct ContactInflow {
  static constexpr bool stage = true, symmetric = false;
  static constexpr int numInputs = mostFields + 3, numOutputs = 1, numData = 3;

  formula::Program program, magnitudes;

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* in, const taylor::Passive<T>* data, T* out) const {
    T q[1];
    formula::evaluate(program, in, data, q);
    out[0] = T(-q[0]);
  }
  void sizes(const double* in, const double* data, double* out) const {
    formula::evaluate<double>(magnitudes, in, data, out);
  }
};

}  // namespace atrapos::physics

ATRAPOS_DECLARE_POINT_LAW(atrapos::physics::ContactInflow)
