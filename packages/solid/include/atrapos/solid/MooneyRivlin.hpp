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
struct MooneyRivlin : RubberLaw<MooneyRivlin> {
  double c1 = 0, c2 = 0;  ///< stress units; the shear modulus at rest is 2 (c1 + c2)
  double bulk = 0;        ///< bulk modulus, stress units

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

  /// S from the Green-Lagrange strain.
  template <class T>
  KOKKOS_FORCEINLINE_FUNCTION taylor::Symmetric3<T> secondPiola(const taylor::Symmetric3<T>& E) const {
    using std::pow;
    const taylor::Symmetric3<T> A = 2.0 * E;
    const taylor::Symmetric3<T> K = detail::cofactorChange(A);
    const T d = detail::determinantChange(A, K);
    const T J2 = 1.0 + d;
    const T m = pow(J2, -1.0 / 3);
    const T pressure = d / J2;
    return stress(A, K, d, J2, m, 0.5 * bulk, pressure);
  }

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* in, const taylor::Passive<T>*, T* out) const {
    stressOfGradient(in, 0.5 * bulk, detail::BulkPressure{}, out);
  }

  /// What MixedLaw is made of.
  template <class T>
  KOKKOS_FORCEINLINE_FUNCTION void mixed(const T* in, double scale, T* out) const {
    const T j = stressOfGradient(in, scale, detail::GivenPressure<T>{in[9]}, out);
    const T q = (scale / bulk) * in[9];
    out[9] = scale * (j - detail::volumeChangeAt(q));
  }

 private:
  /// P = F S: the second invariant needs C anyway. J comes from F, for its sign. U'(J)/J as in
  /// FirstInvariantLaw. Returns J - 1.
  template <class T, class Volumetric>
  KOKKOS_FORCEINLINE_FUNCTION T stressOfGradient(const T* in, double modulus, const Volumetric& volumetric,
                                                 T* out) const {
    using std::pow;
    const taylor::Matrix3<T> H(in);
    // The first row of cof F - I
    const T K0 = in[4] + in[8] + (in[4] * in[8] - in[5] * in[7]);
    const T K1 = in[5] * in[6] - in[3] * in[8] - in[3];
    const T K2 = in[3] * in[7] - in[4] * in[6] - in[6];
    const T j = in[0] + K0 + (in[0] * K0 + in[1] * K1 + in[2] * K2);
    const T J = 1.0 + j;
    const T m = pow(J, -2.0 / 3);
    const T d = j + j * J;
    const T J2 = 1.0 + d;
    const T pressure = volumetric(J, d, J2);
    const taylor::Symmetric3<T> A = 2.0 * greenLagrange(H);
    const taylor::Symmetric3<T> S = stress(A, detail::cofactorChange(A), d, J2, m, modulus, pressure);
    const taylor::Matrix3<T> P = full(S) + H * S;
    P.store(out);
    return j;
  }

  /// S from A = C - I, K = cof C - I, d = J^2 - 1, J2 = J^2, m = J^(-2/3), U'(J)/J = modulus pressure.
  template <class T>
  KOKKOS_FORCEINLINE_FUNCTION taylor::Symmetric3<T> stress(const taylor::Symmetric3<T>& A,
                                                           const taylor::Symmetric3<T>& K, const T& d,
                                                           const T& J2, const T& m, double modulus,
                                                           const T& pressure) const {
    const T i1 = trace(A);
    const T i2 = trace(K);
    const T n = m / J2;
    const T p = m * n;
    const T first = d - (1.0 / 3) * i1;
    const T second = i1 + 2.0 * d + d * i1 - (2.0 / 3) * i2;
    const T ofI = modulus * pressure + (2 * c1) * (n * first) + (2 * c2) * (p * second);
    const T ofK =
        modulus * pressure - (2 * c1) * n - (2 * c1 / 3) * (n * i1) - (4 * c2) * p - (4 * c2 / 3) * (p * i2);
    const T ofA = (-2 * c2) * p - (2 * c2) * (p * d);
    return plusIdentity(scaled(K, ofK) + scaled(A, ofA), ofI);
  }
};

}  // namespace atrapos::solid

ATRAPOS_DECLARE_MATERIAL(atrapos::solid::MooneyRivlin)
