#pragma once

#include "atrapos/solid/Material.hpp"
#include "atrapos/solid/Rubber.hpp"

namespace atrapos::solid {

/// Yeoh's rubber (docs/theory/rubber.md),
///
///     W = c1 x + c2 x^2 + c3 x^3 + (bulk/4) (J^2 - 1 - 2 ln J),   x = J^(-2/3) I_1 - 3,   J = det F > 0
///
/// in:  H_ij = du_i/dX_j, row-major, 9 entries, dimensionless.
/// out: first Piola-Kirchhoff stress P_ij, row-major, force per reference area.
struct Yeoh : FirstInvariantLaw<Yeoh> {
  double c1 = 0, c2 = 0, c3 = 0;  ///< stress units; the shear modulus at rest is 2 c1

  /// c1 > 0 and bulk > 0; throws std::invalid_argument otherwise. c2 and c3 may be negative: then the law
  /// softens, and is unstable where c1 + 2 c2 x + 3 c3 x^2 is negative.
  static Yeoh fromModuli(double c1, double c2, double c3, double bulk) {
    detail::requirePositive(c1, "c1, half the shear modulus at rest,");
    detail::requirePositive(bulk, "the bulk modulus");
    if (!std::isfinite(c2) || !std::isfinite(c3)) throw std::invalid_argument("c2 and c3 must be finite");
    Yeoh law;
    law.c1 = c1;
    law.c2 = c2;
    law.c3 = c3;
    law.bulk = bulk;
    return law;
  }

  double shearModulus() const { return 2 * c1; }  ///< at rest

  template <class T>
  ATRAPOS_FORCEINLINE T slope(const T& x) const {
    const T curvature = 2 * c2 + (3 * c3) * x;
    return c1 + curvature * x;
  }
};

}  // namespace atrapos::solid

ATRAPOS_DECLARE_MATERIAL(atrapos::solid::Yeoh)
