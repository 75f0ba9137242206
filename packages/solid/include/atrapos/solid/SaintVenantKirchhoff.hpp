#pragma once

#include <Kokkos_Macros.hpp>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

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

  /// S in the order xx, yy, zz, xy, yz, zx.
  template <class T>
  KOKKOS_INLINE_FUNCTION void secondPiolaKirchhoff(const T* H, T* S) const {
    // Twice the Green-Lagrange strain.
    const T xx = 2.0 * H[0] + (H[0] * H[0] + H[3] * H[3] + H[6] * H[6]);
    const T yy = 2.0 * H[4] + (H[1] * H[1] + H[4] * H[4] + H[7] * H[7]);
    const T zz = 2.0 * H[8] + (H[2] * H[2] + H[5] * H[5] + H[8] * H[8]);
    const T xy = H[1] + H[3] + (H[0] * H[1] + H[3] * H[4] + H[6] * H[7]);
    const T yz = H[5] + H[7] + (H[1] * H[2] + H[4] * H[5] + H[7] * H[8]);
    const T zx = H[2] + H[6] + (H[0] * H[2] + H[3] * H[5] + H[6] * H[8]);
    const T trace = (0.5 * lambda) * (xx + yy + zz);
    S[0] = trace + mu * xx;
    S[1] = trace + mu * yy;
    S[2] = trace + mu * zz;
    S[3] = mu * xy;
    S[4] = mu * yz;
    S[5] = mu * zx;
  }

  /// S of a Green-Lagrange strain E, both in the order xx, yy, zz, xy, yz, zx (tensor shear strains).
  template <class T>
  KOKKOS_INLINE_FUNCTION void secondPiola(const T* E, T* S) const {
    const T trace = lambda * (E[0] + E[1] + E[2]);
    for (int i = 0; i < 3; ++i) S[i] = trace + (2 * mu) * E[i];
    for (int i = 3; i < 6; ++i) S[i] = (2 * mu) * E[i];
  }

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* H, const taylor::Passive<T>*, T* P) const {
    T S[6];
    secondPiolaKirchhoff(H, S);
    for (int i = 0; i < 3; ++i) {
      const T* h = H + 3 * i;
      P[3 * i + 0] = h[0] * S[0] + h[1] * S[3] + h[2] * S[5];
      P[3 * i + 1] = h[0] * S[3] + h[1] * S[1] + h[2] * S[4];
      P[3 * i + 2] = h[0] * S[5] + h[1] * S[4] + h[2] * S[2];
    }
    P[0] += S[0];
    P[1] += S[3];
    P[2] += S[5];
    P[3] += S[3];
    P[4] += S[1];
    P[5] += S[4];
    P[6] += S[5];
    P[7] += S[4];
    P[8] += S[2];
  }

  static constexpr int numObserved = 6;
  static std::vector<std::string> observedNames() {
    return {"stress_xx", "stress_yy", "stress_zz", "stress_xy", "stress_yz", "stress_zx"};
  }
  /// Cauchy stress F S F^T / det F.
  KOKKOS_INLINE_FUNCTION void observe(const double* H, const double*, double* sigma) const {
    double P[9], F[9];
    (*this)(H, static_cast<const double*>(nullptr), P);
    for (int i = 0; i < 9; ++i) F[i] = H[i] + (i % 4 == 0);
    const double J = F[0] * (F[4] * F[8] - F[5] * F[7]) - F[1] * (F[3] * F[8] - F[5] * F[6]) +
                     F[2] * (F[3] * F[7] - F[4] * F[6]);
    const auto component = [&](int i, int j) {
      return (P[3 * i] * F[3 * j] + P[3 * i + 1] * F[3 * j + 1] + P[3 * i + 2] * F[3 * j + 2]) / J;
    };
    sigma[0] = component(0, 0);
    sigma[1] = component(1, 1);
    sigma[2] = component(2, 2);
    sigma[3] = component(0, 1);
    sigma[4] = component(1, 2);
    sigma[5] = component(2, 0);
  }
};

}  // namespace atrapos::solid
