#pragma once

#include <cmath>

#include "atrapos/fem/PointLaw.hpp"
#include "atrapos/solid/Metal.hpp"
#include "atrapos/solid/Rubber.hpp"
#include "atrapos/solid/Strain.hpp"
#include "atrapos/taylor/FunctionMarks.hpp"
#include "atrapos/taylor/Law.hpp"
#include "atrapos/taylor/Rate.hpp"

namespace atrapos::solid {
namespace detail {

/// What stress and flow are made of, of small numbers where strains are small: with A = C - I and the
/// variables z = G - I behind the first one, G = (F_p^T F_p)^-1,
///
///     D = dev(C G),  mean = tr(C G - I)/3,  d = J^2 - 1,  C^-1 - I,  m = mu J^(-2/3),  q^2 = 3/2 m^2 tr(D D)
template <class T>
struct ElasticPart {
  T D[9], mean, d, inverse[6], m, square;

  ATRAPOS_FORCEINLINE ElasticPart(double mu, const T* E, const T* z) {
    using std::pow, atrapos::taylor::pow;
    const taylor::Symmetric3<T> strain(E);
    const taylor::Symmetric3<T> A = 2.0 * strain;
    const taylor::Symmetric3<T> K = cofactorChange(A);
    d = determinantChange(A, K);
    const T J2 = 1.0 + d;
    for (int n = 0; n < 6; ++n) {
      T change = K.entry(n);
      if (n < 3) change = change - d;
      inverse[n] = change / J2;
    }
    m = mu * pow(J2, -1.0 / 3);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        const int ij = taylor::symmetricIndex(i, j);
        T sum = A.entry(ij) + z[1 + ij];
        for (int k = 0; k < 3; ++k)
          sum = sum + A.entry(taylor::symmetricIndex(i, k)) * z[1 + taylor::symmetricIndex(k, j)];
        D[3 * i + j] = sum;
      }
    mean = (1.0 / 3) * (D[0] + D[4] + D[8]);
    for (int i = 0; i < 3; ++i) D[4 * i] = D[4 * i] - mean;
    square = D[0] * D[0] + D[4] * D[4] + D[8] * D[8] + 2.0 * (D[1] * D[3] + D[2] * D[6] + D[5] * D[7]);
  }
};

/// Rates of (gamma; G - I); data: which condition the point has (Metal::flows).
struct FiniteFlowRule {
  static constexpr int numVariables = 7;
  Metal metal;

  template <class T, class P, class R>
  KOKKOS_INLINE_FUNCTION void operator()(const T* E, const T* z, const P* data, const R* dE, const R* dz,
                                         R* g) const {
    const ElasticPart<T> e(metal.mu, E, z);
    const T m2 = e.m * e.m;
    const T squareOfQ = 1.5 * (m2 * e.square);
    const Yielding<T> y(metal, squareOfQ, z[0], data[0]);
    // M = G D and tr(D C G D).
    T M[6];
    T cubic = (1.0 + e.mean) * e.square;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        T row = e.D[3 * i] * e.D[j] + e.D[3 * i + 1] * e.D[3 + j] + e.D[3 * i + 2] * e.D[6 + j];
        cubic = cubic + row * e.D[3 * j + i];
        if (j < i) continue;
        T sum = e.D[3 * i + j];
        for (int k = 0; k < 3; ++k) sum = sum + z[1 + taylor::symmetricIndex(i, k)] * e.D[3 * k + j];
        M[taylor::symmetricIndex(i, j)] = sum;
      }
    const T perStress = e.m / y.size;
    const T resistance = y.hardening + 4.5 * (perStress * perStress * e.m * cubic);
    const T share = y.share / resistance;
    const T ofM = 1.5 * (e.m * perStress);
    const T ofInverse = (1.0 / 3) * (squareOfQ / y.size);
    // K, the size of flow.
    R flow = 0.0 * dE[0];
    for (int n = 0; n < 6; ++n) {
      T normal = ofM * M[n] - ofInverse * e.inverse[n];
      if (n < 3) normal = normal - ofInverse;
      flow = flow + (n < 3 ? 2.0 : 4.0) * (share * normal) * dE[n];
    }
    g[0] = dz[0] - y.ratio * flow;
    for (int n = 0; n < 6; ++n) g[1 + n] = dz[1 + n] + (3.0 * (perStress * M[n])) * flow;
  }
};

}  // namespace detail

/// Von Mises plasticity for any strains (docs/theory/plasticity.md): F = F_e F_p with G = (F_p^T F_p)^-1,
///
///     W = mu/2 (J^(-2/3) tr(C G) - 3) + kappa/2 ((J^2 - 1)/2 - ln J),   tau = dev part + kappa/2 (J^2 - 1)
///     I, q = sqrt(3/2) |dev tau| <= R(gamma),   G' = -(3 mu J^(-2/3)/q) gamma' G dev(C G),   gamma' >= 0,
///
/// as a rate law along the path with the events of VonMises. tau: Kirchhoff stress; kappa = lambda + 2 mu/3.
///
/// in:  H_ij = du_i/dX_j, row-major, 9 entries, dimensionless.
/// data: 1 where the point yields, else 0; then the variables.
/// out: first Piola-Kirchhoff stress, 9 entries by rows; event function; gamma, G - I (xx yy zz xy yz zx).
struct FiniteVonMises {
  static constexpr int numVariables = detail::FiniteFlowRule::numVariables;
  static constexpr int numEvents = 1;
  static constexpr int numInputs = 9, numOutputs = 10 + numVariables, numData = 1 + numVariables;
  static constexpr bool symmetric = true;
  Metal metal;

  bool freeGrow() const { return metal.isSmoothed(); }

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* in, const taylor::Passive<T>* data, T* out) const {
    const taylor::Matrix3<T> H(in);
    const taylor::Symmetric3<T> strain = greenLagrange(H);
    T E[6];
    strain.store(E);
    T* const z = out + 10;
    for (int i = 0; i < numVariables; ++i) z[i] = T(data[1 + i]);
    taylor::solveRate<6, numVariables, 1>(detail::FiniteFlowRule{metal}, E, data, z);

    // S = m (G - (1 + mean) C^-1) + kappa/2 d C^-1
    const detail::ElasticPart<T> e(metal.mu, E, z);
    const T ofInverse = (0.5 * metal.lambda + metal.mu / 3) * e.d - e.m * e.mean;
    T stress[6];
    for (int n = 0; n < 6; ++n) {
      stress[n] = e.m * (z[1 + n] - e.inverse[n]) + ofInverse * e.inverse[n];
      if (n < 3) stress[n] = stress[n] + ofInverse;
    }
    const taylor::Symmetric3<T> S(stress);
    const taylor::Matrix3<T> P = full(S) + H * S;
    P.store(out);

    const T squareOfQ = 1.5 * (e.m * e.m * e.square);
    out[9] = metal.event(squareOfQ, z[0], data[0]);
  }

  static constexpr int numObserved = Metal::numObserved;
  static auto observedNames() { return Metal::observedNames(); }
  /// Cauchy stress F S F^T / det F, and gamma.
  KOKKOS_INLINE_FUNCTION void observe(const double* H, const double* data, double* shown) const {
    double out[numOutputs];
    (*this)(H, data, out);
    cauchyStress(out, H, shown);
    shown[6] = out[10];
  }
};

}  // namespace atrapos::solid

ATRAPOS_DECLARE_POINT_LAW(atrapos::solid::FiniteVonMises)
