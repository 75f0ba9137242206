#pragma once

#include <cmath>

#include "atrapos/fem/PointLaw.hpp"
#include "atrapos/formula/Program.hpp"
#include "atrapos/solid/MooneyRivlin.hpp"
#include "atrapos/solid/NeoHookean.hpp"
#include "atrapos/solid/SaintVenantKirchhoff.hpp"
#include "atrapos/solid/Strain.hpp"

namespace atrapos::physics {

/// A material whose lengths are 1 + e times as large where it has no stress (docs/theory/balance.md,
/// Expansion): heat, moisture, growth.
///
///     W = (1 + e)^3 W_0(F/(1 + e)),   P = (1 + e)^2 P_0(F/(1 + e)),   e > -1 a formula
///
/// in:   H_ij = du_i/dX_j by rows (9); the field, where Fields = 1; the load factor
/// data: the place x, y, z
/// out:  P_ij by rows (9); 0: deformation has no part in the field's balance
template <class Material, int Fields>
struct Expanding {
  static constexpr int numInputs = 10 + Fields, numOutputs = 9 + Fields, numData = 3;
  static constexpr bool symmetric = Fields == 0;

  Material material;
  formula::Program program;  ///< result e of the inputs behind H, and `data`

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* in, const taylor::Passive<T>* data, T* out) const {
    T e;
    formula::evaluate(program, in + 9, data, &e);
    const T stretch = T(1.0 + e);
    T H[9], P[9];
    for (int i = 0; i < 9; ++i) H[i] = i % 4 == 0 ? T((in[i] - e) / stretch) : T(in[i] / stretch);
    material(H, static_cast<const taylor::Passive<T>*>(nullptr), P);
    const T area = T(stretch * stretch);
    for (int i = 0; i < 9; ++i) out[i] = T(area * P[i]);
    for (int f = 0; f < Fields; ++f) out[9 + f] = T(0.0);
  }

  /// The stresses of the deformation without the expansion and of the expansion without a deformation, which
  /// cancel everywhere in a body that is free.
  void sizes(const double* in, const double* data, double* out) const {
    double e, deformed[9], expanded[9] = {}, P[9];
    formula::evaluate(program, in + 9, data, &e);
    material(in, static_cast<const double*>(nullptr), deformed);
    for (int i = 0; i < 9; i += 4) expanded[i] = -e / (1 + e);
    material(expanded, static_cast<const double*>(nullptr), P);
    for (int i = 0; i < 9; ++i) out[i] = std::fabs(deformed[i]) + (1 + e) * (1 + e) * std::fabs(P[i]);
    for (int f = 0; f < Fields; ++f) out[9 + f] = 0;
  }

  static constexpr int numObserved = 6;
  static std::vector<std::string> observedNames() { return Material::observedNames(); }
  /// Cauchy stress.
  KOKKOS_INLINE_FUNCTION void observe(const double* in, const double* data, double* sigma) const {
    double out[numOutputs];
    (*this)(in, data, out);
    solid::cauchyStress(out, in, sigma);
  }
};

}  // namespace atrapos::physics

#define ATRAPOS_DECLARE_EXPANDING(M)                           \
  ATRAPOS_DECLARE_POINT_LAW(atrapos::physics::Expanding<M, 0>) \
  ATRAPOS_DECLARE_POINT_LAW(atrapos::physics::Expanding<M, 1>)
ATRAPOS_DECLARE_EXPANDING(atrapos::solid::SaintVenantKirchhoff)
ATRAPOS_DECLARE_EXPANDING(atrapos::solid::NeoHookean)
ATRAPOS_DECLARE_EXPANDING(atrapos::solid::MooneyRivlin)
