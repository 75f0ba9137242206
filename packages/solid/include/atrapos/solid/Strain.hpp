#pragma once

#include "atrapos/taylor/Tensor.hpp"

namespace atrapos::solid {

/// Green-Lagrange strain (H + H^T + H^T H)/2 of the displacement gradient, paper (5).
template <class T>
ATRAPOS_FORCEINLINE taylor::Symmetric3<T> greenLagrange(const taylor::Matrix3<T>& H) {
  return symmetricPart(H) + 0.5 * gramian(H);
}

/// Cauchy stress P F^T / det F (xx, yy, zz, xy, yz, zx) from the first Piola-Kirchhoff stress P and the
/// displacement gradient H = F - I, both by rows.
KOKKOS_INLINE_FUNCTION void cauchyStress(const double* P, const double* H, double* sigma) {
  double F[9];
  for (int i = 0; i < 9; ++i) F[i] = H[i] + (i % 4 == 0);
  const double J = F[0] * (F[4] * F[8] - F[5] * F[7]) - F[1] * (F[3] * F[8] - F[5] * F[6]) +
                   F[2] * (F[3] * F[7] - F[4] * F[6]);
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j)
      sigma[taylor::symmetricIndex(i, j)] =
          (P[3 * i] * F[3 * j] + P[3 * i + 1] * F[3 * j + 1] + P[3 * i + 2] * F[3 * j + 2]) / J;
}

/// The same from the second Piola-Kirchhoff stress.
KOKKOS_INLINE_FUNCTION void cauchyStress(const taylor::Symmetric3<double>& S, const double* H,
                                         double* sigma) {
  double P[9];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      P[3 * i + j] = S(i, j) + H[3 * i] * S(0, j) + H[3 * i + 1] * S(1, j) + H[3 * i + 2] * S(2, j);
  cauchyStress(P, H, sigma);
}

}  // namespace atrapos::solid
