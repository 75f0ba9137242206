#pragma once

#include <Kokkos_Macros.hpp>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "atrapos/fem/PointLaw.hpp"
#include "atrapos/solid/Strain.hpp"
#include "atrapos/taylor/Law.hpp"
#include "atrapos/taylor/Rate.hpp"

namespace atrapos::solid {

/// What a metal is made of: elasticity, yield stress and how it hardens.
struct Metal {
  double lambda = 0, mu = 0;    ///< Lame constants, stress units
  double yieldStress = 0;       ///< in tension, > 0
  double modulus = 0;           ///< H, of the linear part of isotropic hardening, stress units
  double saturation = 0;        ///< Q, of its Voce part: what it adds in the end, stress units
  double exponent = 0;          ///< beta, of its Voce part
  double kinematicModulus = 0;  ///< C of Armstrong and Frederick's backstress, stress units
  double recall = 0;            ///< b of it; 0: Prager's linear rule

  /// R = yieldStress + H gamma + Q (1 - exp(-beta gamma)).
  template <class T>
  KOKKOS_FORCEINLINE_FUNCTION T strength(const T& gamma) const {
    using std::exp;
    const T decay = exp(-exponent * gamma);
    return (yieldStress + saturation) + modulus * gamma - saturation * decay;
  }
  /// dR/d gamma.
  template <class T>
  KOKKOS_FORCEINLINE_FUNCTION T hardening(const T& gamma) const {
    using std::exp;
    const T decay = exp(-exponent * gamma);
    return modulus + (saturation * exponent) * decay;
  }
};

/// Throws std::invalid_argument where the constants make no metal: elasticity as SaintVenantKirchhoff, a
/// yield stress that is not positive, hardening that softens without end or faster than elasticity allows.
Metal metalFromYoung(double E, double nu, const Metal& plastic);

namespace detail {

/// Rates of (gamma; plastic strain; backstress) of an active point, zero of a free one; data: active or not.
template <bool kinematic>
struct FlowRule {
  static constexpr int numVariables = kinematic ? 13 : 7;
  Metal metal;

  /// s - X, deviatoric, from strain and variables.
  template <class T>
  KOKKOS_FORCEINLINE_FUNCTION void relativeStress(const T* E, const T* z, T* xi) const {
    const T mean = (1.0 / 3) * (E[0] + E[1] + E[2]);
    for (int i = 0; i < 6; ++i) {
      T elastic = E[i] - z[1 + i];
      if (i < 3) elastic = elastic - mean;
      xi[i] = (2 * metal.mu) * elastic;
      if constexpr (kinematic) xi[i] = xi[i] - z[7 + i];
    }
  }
  template <class T>
  static KOKKOS_FORCEINLINE_FUNCTION T square(const T* xi) {
    return 1.5 * (xi[0] * xi[0] + xi[1] * xi[1] + xi[2] * xi[2]) +
           3.0 * (xi[3] * xi[3] + xi[4] * xi[4] + xi[5] * xi[5]);
  }

  template <class T, class P, class R>
  KOKKOS_INLINE_FUNCTION void operator()(const T* E, const T* z, const P* data, const R* dE, const R* dz,
                                         R* g) const {
    using std::sqrt;
    T xi[6];
    relativeStress(E, z, xi);
    // A free point may be without stress: its q is any positive number.
    const P beyond = (metal.yieldStress * metal.yieldStress) * (1.0 - data[0]);
    const T q = sqrt(square(xi) + beyond);
    T resistance = metal.hardening(z[0]) + (3 * metal.mu + metal.kinematicModulus);
    if constexpr (kinematic) {
      const T along =
          xi[0] * z[7] + xi[1] * z[8] + xi[2] * z[9] + 2.0 * (xi[3] * z[10] + xi[4] * z[11] + xi[5] * z[12]);
      resistance = resistance - (1.5 * metal.recall) * (along / q);
    }
    const T share = (3 * metal.mu) * data[0] / (q * resistance);
    const T direction = 1.5 / q;
    g[0] = dz[0];
    for (int i = 0; i < 6; ++i) {
      const T normal = xi[i] * direction;
      const T pushed = (i < 3 ? 1.0 : 2.0) * (share * xi[i]);
      g[0] = g[0] - pushed * dE[i];
      g[1 + i] = dz[1 + i] - normal * dz[0];
      if constexpr (kinematic)
        g[7 + i] =
            dz[7 + i] - (2.0 / 3 * metal.kinematicModulus) * dz[1 + i] + metal.recall * z[7 + i] * dz[0];
    }
  }
};

}  // namespace detail

/// Von Mises plasticity for small strains and any rotations (docs/theory/plasticity.md): with Green-Lagrange
/// strain E, plastic strain p, backstress X and accumulated plastic strain gamma
///
///     S = lambda tr(E) I + 2 mu (E - p),   xi = dev S - X,   q = sqrt(3/2 xi : xi),
///     q <= R(gamma),   p' = 3/2 xi/q gamma',   X' = 2/3 C p' - b X gamma',   gamma' >= 0,
///
/// as a rate law along the path: a point is elastic (free) or it yields (active), and changes at events
/// (fem::LawShape::events): 1 of q^2/R0^2 over R^2/R0^2, and gamma' = 0.
///
/// in:  H_ij = du_i/dX_j, row-major, 9 entries, dimensionless.
/// data: 1 where the point yields, else 0; then the variables.
/// out: first Piola-Kirchhoff stress, 9 entries by rows; event function; gamma, p (xx yy zz xy yz zx), X.
template <bool kinematic>
struct VonMises {
  static constexpr int numVariables = detail::FlowRule<kinematic>::numVariables;
  static constexpr int numEvents = 1;
  static constexpr int numInputs = 9, numOutputs = 10 + numVariables, numData = 1 + numVariables;
  static constexpr bool symmetric = true;
  Metal metal;

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* in, const taylor::Passive<T>* data, T* out) const {
    const taylor::Matrix3<T> H(in);
    const taylor::Symmetric3<T> strain = greenLagrange(H);
    T E[6];
    for (int i = 0; i < 3; ++i)
      for (int j = i; j < 3; ++j) E[taylor::symmetricIndex(i, j)] = strain(i, j);
    T* const z = out + 10;
    for (int i = 0; i < numVariables; ++i) z[i] = T(data[1 + i]);
    const detail::FlowRule<kinematic> flow{metal};
    taylor::solveRate<6, numVariables, 1>(flow, E, data, z);

    const T spherical = metal.lambda * (E[0] + E[1] + E[2]);
    T stress[6];
    for (int i = 0; i < 6; ++i) {
      stress[i] = (2 * metal.mu) * (E[i] - z[1 + i]);
      if (i < 3) stress[i] = stress[i] + spherical;
    }
    const taylor::Symmetric3<T> S(stress);
    const taylor::Matrix3<T> P = full(S) + H * S;
    P.store(out);

    T xi[6];
    flow.relativeStress(E, z, xi);
    const T strength = metal.strength(z[0]) * (1 / metal.yieldStress);
    const T equivalent = flow.square(xi) * (1 / (metal.yieldStress * metal.yieldStress));
    const T within = strength * strength - equivalent;
    const taylor::Passive<T> free = 1.0 - data[0];
    const taylor::Passive<T> active = (3 * metal.mu / metal.yieldStress) * data[0];
    out[9] = free * within + active * z[0];
  }

  static constexpr int numObserved = 7;
  static std::vector<std::string> observedNames() {
    return {"stress_xx",
            "stress_yy",
            "stress_zz",
            "stress_xy",
            "stress_yz",
            "stress_zx",
            "equivalent_plastic_strain"};
  }
  /// Cauchy stress F S F^T / det F, and gamma.
  KOKKOS_INLINE_FUNCTION void observe(const double* H, const double* data, double* shown) const {
    double out[numOutputs];
    (*this)(H, data, out);
    cauchyStress(out, H, shown);
    shown[6] = out[10];
  }
};

}  // namespace atrapos::solid

ATRAPOS_DECLARE_POINT_LAW(atrapos::solid::VonMises<false>)
ATRAPOS_DECLARE_POINT_LAW(atrapos::solid::VonMises<true>)
