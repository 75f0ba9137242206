#pragma once

#include "atrapos/solid/Material.hpp"
#include "atrapos/solid/Rubber.hpp"

namespace atrapos::solid {

/// Gent's rubber, whose chains have an end (docs/theory/rubber.md),
///
///     W = -(mu limit/2) ln(1 - x/limit) + (bulk/4) (J^2 - 1 - 2 ln J),   x = J^(-2/3) I_1 - 3 < limit,   J =
///     det F > 0
///
/// in:  H_ij = du_i/dX_j, row-major, 9 entries, dimensionless.
/// out: first Piola-Kirchhoff stress P_ij, row-major, force per reference area.
struct Gent : FirstInvariantLaw<Gent> {
  double mu = 0;     ///< shear modulus at rest, stress units
  double limit = 0;  ///< Gent's J_m, dimensionless: x where the stress is infinite

  /// All > 0; throws std::invalid_argument otherwise.
  static Gent fromModuli(double shear, double limit, double bulk) {
    detail::requirePositive(shear, "the shear modulus");
    detail::requirePositive(limit, "the limit J_m");
    detail::requirePositive(bulk, "the bulk modulus");
    Gent law;
    law.mu = shear;
    law.limit = limit;
    law.bulk = bulk;
    return law;
  }

  double shearModulus() const { return mu; }  ///< at rest

  /// (mu/2)/(1 - x/limit), by the logarithm of the energy: beyond the limit there is no value, where a
  /// quotient would have a negative one.
  template <class T>
  ATRAPOS_FORCEINLINE T slope(const T& x) const {
    using std::exp;
    using std::log1p, atrapos::taylor::log1p;
    const T left = log1p((-1.0 / limit) * x);
    const T minusLeft = -left;
    const T growth = exp(minusLeft);
    return (0.5 * mu) * growth;
  }
};

}  // namespace atrapos::solid

ATRAPOS_DECLARE_MATERIAL(atrapos::solid::Gent)
