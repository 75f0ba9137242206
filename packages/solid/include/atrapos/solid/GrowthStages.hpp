#pragma once

#include "atrapos/fem/PointLaw.hpp"
#include "atrapos/taylor/Law.hpp"

/// Around a material whose lengths are 1 + e times as large where it has no stress (docs/theory/balance.md,
/// Expansion): in strains, W(E) = (1 + e)^3 W_0(E_e) with E_e = (E - (e + e^2/2) I)/(1 + e)^2.
namespace atrapos::solid {

/// in: the strain E, 6, the enhanced part along g g^T, e; out: E_e, 6, its enhanced part; data: I, or what an
/// element with assumed strains has in its place, 6.
struct ElasticStrainStage {
  static constexpr bool stage = true, symmetric = false;
  static constexpr int numInputs = 8, numOutputs = 7, numData = 6;

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* in, const taylor::Passive<T>* unit, T* out) const {
    const T& e = in[7];
    const T stretch = 1.0 + e;
    const T perSquare = 1.0 / (stretch * stretch);
    const T grown = e + 0.5 * (e * e);
    for (int m = 0; m < 6; ++m) out[m] = (in[m] - unit[m] * grown) * perSquare;
    out[6] = in[6] * perSquare;
  }
};

/// in: the stress of the material there, 6, its part along g g^T, e; out: both as they belong to E.
struct GrownStressStage {
  static constexpr bool stage = true, symmetric = false;
  static constexpr int numInputs = 8, numOutputs = 7, numData = 0;

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* in, const taylor::Passive<T>*, T* out) const {
    const T stretch = 1.0 + in[7];
    for (int m = 0; m < 7; ++m) out[m] = stretch * in[m];
  }
};

}  // namespace atrapos::solid

ATRAPOS_DECLARE_POINT_LAW(atrapos::solid::ElasticStrainStage)
ATRAPOS_DECLARE_POINT_LAW(atrapos::solid::GrownStressStage)
