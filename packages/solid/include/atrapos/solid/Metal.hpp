#pragma once

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "atrapos/taylor/FunctionMarks.hpp"
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
  double width = 0;             ///< w of a smoothed yield surface, as a share of R; 0: a sharp one

  /// R = yieldStress + H gamma + Q (1 - exp(-beta gamma)).
  template <class T>
  ATRAPOS_FORCEINLINE T strength(const T& gamma) const {
    using std::exp;
    const T decay = exp(-exponent * gamma);
    return (yieldStress + saturation) + modulus * gamma - saturation * decay;
  }
  /// dR/d gamma.
  template <class T>
  ATRAPOS_FORCEINLINE T hardening(const T& gamma) const {
    using std::exp;
    const T decay = exp(-exponent * gamma);
    return modulus + (saturation * exponent) * decay;
  }
  bool isSmoothed() const { return width > 0; }
  /// Of a point's datum: 1 where it may flow, 0 where it is elastic. The points of a smoothed surface start
  /// as ones that flow, those of a sharp one as elastic ones.
  template <class P>
  ATRAPOS_FORCEINLINE P flows(const P& datum) const {
    return width > 0 ? 1.0 - datum : 1.0 * datum;
  }
  /// G: 1 of a sharp surface, exp((q^2/R^2 - 1)/(2 w)) of a smoothed one.
  template <class T>
  ATRAPOS_FORCEINLINE T nearness(const T& ratioSquared) const {
    using std::exp;
    const double steepness = width > 0 ? 0.5 / width : 0;
    const T exponent = steepness * (ratioSquared - 1.0);
    return exp(exponent);
  }
  /// The event function of a point: the growing gamma where it flows; of an elastic one (R^2 - q^2)/R0^2 at a
  /// sharp surface, minus its share of flow at a smoothed one.
  template <class T>
  ATRAPOS_FORCEINLINE T event(const T& squareOfQ, const T& gamma, const taylor::Passive<T>& datum) const {
    const T relative = strength(gamma) * (1 / yieldStress);
    const T bound = relative * relative, reached = squareOfQ * (1 / (yieldStress * yieldStress));
    const T ratio = reached / bound;
    const T share = ratio * nearness(ratio);
    const double sharp = width > 0 ? 0 : 1;
    const taylor::Passive<T> flow = flows(datum);
    const taylor::Passive<T> within = sharp * (1.0 - flow), leaves = (1 - sharp) * (1.0 - flow),
                             grows = (3 * mu / yieldStress) * flow;
    return within * (bound - reached) - leaves * share + grows * gamma;
  }

  /// What a point shows: Cauchy stress, and gamma.
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
};

/// Throws std::invalid_argument where the constants make no metal: elasticity as SaintVenantKirchhoff, a
/// yield stress that is not positive, hardening that softens without end or faster than elasticity allows.
Metal metalFromYoung(double E, double nu, const Metal& plastic);

namespace detail {

/// How a point yields at q^2 and gamma, for all rules of flow: K, the size of flow, is share (...)/D.
template <class T>
struct Yielding {
  T size;       ///< q, at a smoothed surface R: what directions and shares are made of
  T hardening;  ///< dR/d gamma
  T ratio;      ///< q^2/R^2, at a sharp surface 1: gamma'/K (R gamma' is the power of what yields)
  T share;      ///< 0 of an elastic point, G of others

  ATRAPOS_FORCEINLINE Yielding(const Metal& metal, const T& squareOfQ, const T& gamma,
                               const taylor::Passive<T>& datum) {
    using std::sqrt;
    const double smooth = metal.width > 0 ? 1 : 0, sharp = 1 - smooth;
    const taylor::Passive<T> flows = metal.flows(datum);
    // An elastic point at a sharp surface may be without stress: its q is any positive number.
    const taylor::Passive<T> beyond = (sharp * metal.yieldStress * metal.yieldStress) * (1.0 - flows);
    const T strength = metal.strength(gamma);
    const T bound = strength * strength;
    size = sqrt(sharp * squareOfQ + smooth * bound + beyond);
    hardening = metal.hardening(gamma);
    ratio = smooth * (squareOfQ / bound) + sharp;
    share = flows * metal.nearness(ratio);
  }
};

/// Rates of (gamma; plastic strain; backstress); data: which condition the point has (Metal::flows). In plane
/// stress E_zz is what follows from the others and the plastic strain, in place of E[2].
template <bool kinematic, bool planeStress>
struct FlowRule {
  static constexpr int numVariables = kinematic ? 13 : 7;
  Metal metal;

  /// dE_zz/dp_zz in plane stress: S_zz = 0.
  ATRAPOS_FORCEINLINE double thinning() const { return 2 * metal.mu / (metal.lambda + 2 * metal.mu); }
  /// E_zz.
  template <class T>
  ATRAPOS_FORCEINLINE T across(const T* E, const T* z) const {
    if constexpr (planeStress)
      return thinning() * z[3] - (metal.lambda / (metal.lambda + 2 * metal.mu)) * (E[0] + E[1]);
    else
      return E[2];
  }
  /// s - X, deviatoric, from strain and variables.
  template <class T>
  ATRAPOS_FORCEINLINE void relativeStress(const T* E, const T* z, T* xi) const {
    const T zz = across(E, z);
    const T mean = (1.0 / 3) * (E[0] + E[1] + zz);
    for (int i = 0; i < 6; ++i) {
      T elastic = (i == 2 ? zz : E[i]) - z[1 + i];
      if (i < 3) elastic = elastic - mean;
      xi[i] = (2 * metal.mu) * elastic;
      if constexpr (kinematic) xi[i] = xi[i] - z[7 + i];
    }
  }
  template <class T>
  static ATRAPOS_FORCEINLINE T square(const T* xi) {
    return 1.5 * (xi[0] * xi[0] + xi[1] * xi[1] + xi[2] * xi[2]) +
           3.0 * (xi[3] * xi[3] + xi[4] * xi[4] + xi[5] * xi[5]);
  }

  template <class T, class P, class R>
  KOKKOS_INLINE_FUNCTION void operator()(const T* E, const T* z, const P* data, const R* dE, const R* dz,
                                         R* g) const {
    T xi[6];
    relativeStress(E, z, xi);
    const Yielding<T> y(metal, square(xi), z[0], data[0]);
    T resistance = y.hardening + (3 * metal.mu + metal.kinematicModulus);
    if constexpr (kinematic) {
      const T along =
          xi[0] * z[7] + xi[1] * z[8] + xi[2] * z[9] + 2.0 * (xi[3] * z[10] + xi[4] * z[11] + xi[5] * z[12]);
      resistance = resistance - (1.5 * metal.recall) * (along / y.size);
    }
    if constexpr (planeStress) {
      const T lateral = xi[2] / y.size;
      resistance = resistance - (4.5 * metal.mu * thinning()) * (y.share * (lateral * lateral));
    }
    const T pushed = (3 * metal.mu) * y.share / (y.size * resistance);
    const T direction = 1.5 / y.size;
    // K, the size of flow.
    const double lateralShare = metal.lambda / (metal.lambda + 2 * metal.mu);
    R flow = (pushed * xi[0]) * dE[0];
    for (int i = 1; i < 6; ++i) {
      const T by = (i < 3 ? 1.0 : 2.0) * (pushed * xi[i]);
      if constexpr (planeStress) {
        if (i == 2)
          flow = flow - lateralShare * (by * (dE[0] + dE[1]));
        else
          flow = flow + by * dE[i];
      } else {
        flow = flow + by * dE[i];
      }
    }
    g[0] = dz[0] - y.ratio * flow;
    for (int i = 0; i < 6; ++i) {
      g[1 + i] = dz[1 + i] - (xi[i] * direction) * flow;
      if constexpr (kinematic)
        g[7 + i] =
            dz[7 + i] - (2.0 / 3 * metal.kinematicModulus) * dz[1 + i] + metal.recall * z[7 + i] * dz[0];
    }
  }
};

/// A point of the metal at the Green-Lagrange strain E (xx yy zz xy yz zx): second Piola-Kirchhoff stress,
/// the event function and the variables behind it. In plane stress E[2] is E_zz afterwards. data: whether the
/// point yields; variables: those at the start.
template <bool kinematic, bool planeStress, class T>
ATRAPOS_FORCEINLINE void metalStress(const Metal& metal, T* E, const taylor::Passive<T>* data,
                                     const taylor::Passive<T>* variables, T* stress, T* event) {
  using Flow = FlowRule<kinematic, planeStress>;
  T* const z = event + 1;
  for (int i = 0; i < Flow::numVariables; ++i) z[i] = T(variables[i]);
  const Flow flow{metal};
  taylor::solveRate<6, Flow::numVariables, 1>(flow, E, data, z);
  if constexpr (planeStress) E[2] = flow.across(E, z);
  const T spherical = metal.lambda * (E[0] + E[1] + E[2]);
  for (int i = 0; i < 6; ++i) {
    stress[i] = (2 * metal.mu) * (E[i] - z[1 + i]);
    if (i < 3) stress[i] = stress[i] + spherical;
  }
  if constexpr (planeStress) stress[2] = T(0.0);
  T xi[6];
  flow.relativeStress(E, z, xi);
  event[0] = metal.event(flow.square(xi), z[0], data[0]);
}

}  // namespace detail
}  // namespace atrapos::solid
