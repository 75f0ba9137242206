#pragma once

#include "atrapos/solid/Gent.hpp"
#include "atrapos/solid/MooneyRivlin.hpp"
#include "atrapos/solid/NeoHookean.hpp"
#include "atrapos/solid/Ogden.hpp"
#include "atrapos/solid/Yeoh.hpp"

namespace atrapos::solid {

/// A law of rubber whose volumetric stress is an unknown of its own (docs/theory/mixed.md): the material is
/// the same, its bulk modulus may be as large as one likes, and infinite.
///
/// in: H_ij by rows (9), pi (length): pi times `scale` is the volumetric part of the stress, U'(J) (of
/// NeoHookean J U'(J)), > 0 in tension.
///
/// out: P_ij by rows (9), and the conjugate of pi: scale times what the volume has too much for that stress.
///
/// Material: `template <class T> void mixed(const T* in, double scale, T* out) const`.
template <class Material>
struct MixedLaw {
  static constexpr int numInputs = 10, numOutputs = 10, numData = 0;
  static constexpr bool symmetric = true;

  Material material;
  double scale = 1;  ///< stress per length

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* in, const taylor::Passive<T>*, T* out) const {
    material.mixed(in, scale, out);
  }

  static constexpr int numObserved = 6;
  static std::vector<std::string> observedNames() { return Material::observedNames(); }
  /// Cauchy stress P F^T / det F.
  KOKKOS_INLINE_FUNCTION void observe(const double* in, const double*, double* sigma) const {
    double out[10];
    material.mixed(in, scale, out);
    cauchyStress(out, in, sigma);
  }
};

}  // namespace atrapos::solid

ATRAPOS_DECLARE_POINT_LAW(atrapos::solid::MixedLaw<atrapos::solid::NeoHookean>)
ATRAPOS_DECLARE_POINT_LAW(atrapos::solid::MixedLaw<atrapos::solid::MooneyRivlin>)
ATRAPOS_DECLARE_POINT_LAW(atrapos::solid::MixedLaw<atrapos::solid::Yeoh>)
ATRAPOS_DECLARE_POINT_LAW(atrapos::solid::MixedLaw<atrapos::solid::Gent>)
ATRAPOS_DECLARE_POINT_LAW(atrapos::solid::MixedLaw<atrapos::solid::Ogden>)
