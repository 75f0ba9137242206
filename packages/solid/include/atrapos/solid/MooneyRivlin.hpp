#pragma once

#include "atrapos/solid/Material.hpp"
#include "atrapos/solid/Rubber.hpp"

namespace atrapos::solid {

/// Mooney-Rivlin rubber (docs/theory/rubber.md),
///
///     W = c1 (J^(-2/3) I_1 - 3) + c2 (J^(-4/3) I_2 - 3) + (bulk/4) (J^2 - 1 - 2 ln J),   J = det F > 0
///
/// in:  H_ij = du_i/dX_j, row-major, 9 entries, dimensionless.
/// out: first Piola-Kirchhoff stress P_ij, row-major, force per reference area.
struct MooneyRivlin : SecondInvariantLaw<MooneyRivlin> {
  double c1 = 0, c2 = 0;  ///< stress units; the shear modulus at rest is 2 (c1 + c2)

  /// c1 + c2 > 0 and bulk > 0; throws std::invalid_argument otherwise. One of c1 and c2 may be negative: then
  /// there are strains at which the law is unstable.
  static MooneyRivlin fromModuli(double c1, double c2, double bulk) {
    detail::requirePositive(c1 + c2, "c1 + c2, half the shear modulus at rest,");
    detail::requirePositive(bulk, "the bulk modulus");
    MooneyRivlin law;
    law.c1 = c1;
    law.c2 = c2;
    law.bulk = bulk;
    return law;
  }

  double shearModulus() const { return 2 * (c1 + c2); }  ///< at rest

  template <class T>
  ATRAPOS_FORCEINLINE void factors(const detail::Dilated<T>& x, const T& pressure, T& ofI, T& ofK,
                                   T& ofA) const {
    const T n = x.m / x.J2;
    const T p = x.m * n;
    const T first = x.d - (1.0 / 3) * x.i1;
    const T second = x.i1 + 2.0 * x.d + x.d * x.i1 - (2.0 / 3) * x.i2;
    ofI = pressure + (2 * c1) * (n * first) + (2 * c2) * (p * second);
    ofK = pressure - (2 * c1) * n - (2 * c1 / 3) * (n * x.i1) - (4 * c2) * p - (4 * c2 / 3) * (p * x.i2);
    ofA = (-2 * c2) * p - (2 * c2) * (p * x.d);
  }
};

}  // namespace atrapos::solid

ATRAPOS_DECLARE_MATERIAL(atrapos::solid::MooneyRivlin)
