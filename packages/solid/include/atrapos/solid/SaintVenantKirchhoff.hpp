#pragma once

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "atrapos/solid/Material.hpp"
#include "atrapos/solid/Strain.hpp"
#include "atrapos/taylor/FunctionMarks.hpp"
#include "atrapos/taylor/Law.hpp"

namespace atrapos::solid {

/// Saint Venant-Kirchhoff elasticity in total-Lagrangian form, paper (4)-(6):
///
///     gamma = (H + H^T + H^T H)/2,   S = lambda tr(gamma) I + 2 mu gamma,   T = (I + H) S
///
/// in:  H_ij = du_i/dX_j, row-major, 9 entries, dimensionless.
/// out: first Piola-Kirchhoff stress T_ij, row-major, force per reference area.
/// Products are written as T = S + H S so that only H and S are operands: 9 + 6 histories, 45 products.
struct SaintVenantKirchhoff {
  static constexpr int numInputs = 9, numOutputs = 9, numData = 0;
  static constexpr bool symmetric = true;

  double lambda = 0;  ///< first Lame constant, stress units
  double mu = 0;      ///< shear modulus, stress units

  /// From Young's modulus E > 0 and Poisson's ratio -1 < nu < 1/2; throws std::invalid_argument otherwise.
  static SaintVenantKirchhoff fromYoung(double E, double nu) {
    if (!(E > 0) || !std::isfinite(E)) throw std::invalid_argument("Young's modulus must be positive");
    if (!(nu > -1 && nu < 0.5)) throw std::invalid_argument("Poisson's ratio must lie between -1 and 0.5");
    return {E * nu / ((1 + nu) * (1 - 2 * nu)), E / (2 * (1 + nu))};
  }

  /// S from the Green-Lagrange strain.
  template <class T>
  ATRAPOS_FORCEINLINE taylor::Symmetric3<T> secondPiola(const taylor::Symmetric3<T>& E) const {
    const T spherical = lambda * trace(E);
    return plusIdentity((2 * mu) * E, spherical);
  }

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* in, const taylor::Passive<T>*, T* out) const {
    const taylor::Matrix3<T> H(in);
    const taylor::Symmetric3<T> S = secondPiola(greenLagrange(H));
    const taylor::Matrix3<T> P = full(S) + H * S;
    P.store(out);
  }

  static constexpr int numObserved = 6;
  static std::vector<std::string> observedNames() {
    return {"stress_xx", "stress_yy", "stress_zz", "stress_xy", "stress_yz", "stress_zx"};
  }
  /// Cauchy stress F S F^T / det F.
  KOKKOS_INLINE_FUNCTION void observe(const double* H, const double*, double* sigma) const {
    double P[9];
    (*this)(H, static_cast<const double*>(nullptr), P);
    cauchyStress(P, H, sigma);
  }
};

}  // namespace atrapos::solid

ATRAPOS_DECLARE_MATERIAL(atrapos::solid::SaintVenantKirchhoff)
