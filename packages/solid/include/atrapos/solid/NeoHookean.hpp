#pragma once

#include "atrapos/solid/Material.hpp"
#include "atrapos/solid/Rubber.hpp"

namespace atrapos::solid {

/// Compressible neo-Hookean rubber (docs/theory/rubber.md),
///
///     W = mu/2 (I_1 - 3) - mu ln J + lambda/2 (ln J)^2,   J = det F > 0
///
/// in:  H_ij = du_i/dX_j, row-major, 9 entries, dimensionless.
/// out: first Piola-Kirchhoff stress P_ij, row-major, force per reference area.
struct NeoHookean : RubberLaw<NeoHookean> {
  double lambda = 0;  ///< first Lame constant at rest, stress units
  double mu = 0;      ///< shear modulus at rest, stress units

  /// From Young's modulus E > 0 and Poisson's ratio -1 < nu < 1/2 at rest; throws std::invalid_argument
  /// otherwise.
  static NeoHookean fromYoung(double E, double nu) {
    detail::requirePositive(E, "Young's modulus");
    if (!(nu > -1 && nu < 0.5)) throw std::invalid_argument("Poisson's ratio must lie between -1 and 0.5");
    return fromLame(E * nu / ((1 + nu) * (1 - 2 * nu)), E / (2 * (1 + nu)));
  }

  /// From the shear modulus and the bulk modulus lambda + 2 mu/3 at rest, both > 0; throws
  /// std::invalid_argument otherwise.
  static NeoHookean fromModuli(double shear, double bulk) {
    detail::requirePositive(shear, "the shear modulus");
    detail::requirePositive(bulk, "the bulk modulus");
    return fromLame(bulk - 2 * shear / 3, shear);
  }

  /// S = mu (I - C^-1) + lambda ln J C^-1 from the Green-Lagrange strain.
  template <class T>
  ATRAPOS_FORCEINLINE taylor::Symmetric3<T> secondPiola(const taylor::Symmetric3<T>& E) const {
    using std::log1p, atrapos::taylor::log1p;
    const taylor::Symmetric3<T> A = 2.0 * E;
    const taylor::Symmetric3<T> K = detail::cofactorChange(A);
    const T d = detail::determinantChange(A, K);
    const T logarithm = log1p(d);
    const T J2 = 1.0 + d;
    const T b = (mu * d + (0.5 * lambda) * logarithm) / J2;
    return plusIdentity(scaled(K, b) - mu * K, b);
  }

  /// P = mu (F - cof F) + b cof F, b = (mu (J - 1) + lambda ln J)/J: without C, and J itself must be
  /// positive.
  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* in, const taylor::Passive<T>*, T* out) const {
    using std::log1p, atrapos::taylor::log1p;
    const taylor::Matrix3<T> H(in);
    const taylor::Matrix3<T> K = detail::cofactorChange(H);
    const T j = detail::determinantChange(H, K);
    const T logarithm = log1p(j);
    const T J = 1.0 + j;
    const T b = (mu * j + lambda * logarithm) / J;
    const taylor::Matrix3<T> P = plusIdentity(mu * (H - K) + scaled(K, b), b);
    P.store(out);
  }

  /// What MixedLaw is made of: lambda ln J is scale times the last input.
  template <class T>
  ATRAPOS_FORCEINLINE void mixed(const T* in, double scale, T* out) const {
    using std::log1p, atrapos::taylor::log1p;
    const taylor::Matrix3<T> H(in);
    const taylor::Matrix3<T> K = detail::cofactorChange(H);
    const T j = detail::determinantChange(H, K);
    const T logarithm = log1p(j);
    const T J = 1.0 + j;
    const T b = (mu * j + scale * in[9]) / J;
    const taylor::Matrix3<T> P = plusIdentity(mu * (H - K) + scaled(K, b), b);
    P.store(out);
    out[9] = scale * logarithm - (scale * (scale / lambda)) * in[9];
  }

  double shearModulus() const { return mu; }  ///< at rest

 private:
  static NeoHookean fromLame(double lambda, double mu) {
    NeoHookean law;
    law.lambda = lambda;
    law.mu = mu;
    return law;
  }
};

}  // namespace atrapos::solid

ATRAPOS_DECLARE_MATERIAL(atrapos::solid::NeoHookean)
