#pragma once

#include "atrapos/fem/PointLaw.hpp"
#include "atrapos/formula/Program.hpp"
#include "atrapos/physics/Formulas.hpp"

namespace atrapos::physics {

/// Balances of scalar fields u_f in a body (docs/theory/balance.md):
///
///     -div(k_f grad u_f) = s_f,    k_f and s_f formulas
///
/// in:   for each field grad u (3) and u; the load factor
/// data: the place x, y, z
/// out:  for each field k grad u (3) and -s: a negative flux, amounts per volume
///
/// program: results k_0, s_0, k_1, ... of `in` and `data`; magnitudes: what k_0, |s_0|, k_1, ... are the sums
/// of.
template <int Fields>
struct BalanceLaw {
  static constexpr int numInputs = 4 * Fields + 1, numOutputs = 4 * Fields, numData = 3;
  bool symmetric = false;  ///< d out/d in is: no k depends on fields, no s on other fields than its own
  formula::Program program, magnitudes;

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* in, const taylor::Passive<T>* data, T* out) const {
    balance(program, in, data, out);
  }
  void sizes(const double* in, const double* data, double* out) const {
    balance<double>(magnitudes, in, data, out);
  }

 private:
  template <class T>
  static KOKKOS_INLINE_FUNCTION void balance(const formula::Program& of, const T* in,
                                             const taylor::Passive<T>* data, T* out) {
    T result[2 * Fields];
    formula::evaluate(of, in, data, result);
    for (int f = 0; f < Fields; ++f) {
      for (int i = 0; i < 3; ++i) out[4 * f + i] = T(result[2 * f] * in[4 * f + i]);
      out[4 * f + 3] = T(-result[2 * f + 1]);
    }
  }
};

/// What flows into a body through its surface, a formula for each scalar field:
///
///     k_f du_f/dn = q_f
///
/// in:   the fields; the load factor
/// data: the place x, y, z
/// out:  -q of each field
template <int Fields>
struct InflowLaw {
  static constexpr int numInputs = Fields + 1, numOutputs = Fields, numData = 3;
  bool symmetric = false;  ///< no q depends on another field than its own
  formula::Program program, magnitudes;

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* in, const taylor::Passive<T>* data, T* out) const {
    inflow(program, in, data, out);
  }
  void sizes(const double* in, const double* data, double* out) const {
    inflow<double>(magnitudes, in, data, out);
  }

 private:
  template <class T>
  static KOKKOS_INLINE_FUNCTION void inflow(const formula::Program& of, const T* in,
                                            const taylor::Passive<T>* data, T* out) {
    T result[Fields];
    formula::evaluate(of, in, data, result);
    for (int f = 0; f < Fields; ++f) out[f] = T(-result[f]);
  }
};

}  // namespace atrapos::physics

ATRAPOS_DECLARE_POINT_LAW(atrapos::physics::BalanceLaw<1>)
ATRAPOS_DECLARE_POINT_LAW(atrapos::physics::BalanceLaw<2>)
ATRAPOS_DECLARE_POINT_LAW(atrapos::physics::BalanceLaw<3>)
ATRAPOS_DECLARE_POINT_LAW(atrapos::physics::BalanceLaw<4>)
ATRAPOS_DECLARE_POINT_LAW(atrapos::physics::InflowLaw<1>)
ATRAPOS_DECLARE_POINT_LAW(atrapos::physics::InflowLaw<2>)
ATRAPOS_DECLARE_POINT_LAW(atrapos::physics::InflowLaw<3>)
ATRAPOS_DECLARE_POINT_LAW(atrapos::physics::InflowLaw<4>)
