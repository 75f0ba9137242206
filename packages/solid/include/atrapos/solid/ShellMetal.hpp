#pragma once

#include <cmath>

#include "atrapos/fem/PointLaw.hpp"
#include "atrapos/solid/Metal.hpp"
#include "atrapos/solid/ShellBase.hpp"
#include "atrapos/solid/Strain.hpp"
#include "atrapos/taylor/FunctionMarks.hpp"
#include "atrapos/taylor/Law.hpp"

namespace atrapos::solid {
namespace detail {

/// Second Piola-Kirchhoff stress of a metal in a shell and its event function and variables, all in axes of
/// which 3 is the normal at rest (docs/theory/plasticity.md, "Shells"): plane stress, and for the director's
/// E_33 an elastic stress of its own, so that the director turns and does not stretch.
template <bool kinematic, class T>
KOKKOS_FORCEINLINE_FUNCTION taylor::Symmetric3<T> shellMetalStress(const Metal& metal,
                                                                   const taylor::Symmetric3<T>& strain,
                                                                   const taylor::Passive<T>* data,
                                                                   const taylor::Passive<T>* variables,
                                                                   T* event) {
  T E[6], S[6];
  strain.store(E);
  const T ofDirector = (metal.lambda + 2 * metal.mu) * E[2];
  metalStress<kinematic, true>(metal, E, data, variables, S, event);
  S[2] = ofDirector;
  return taylor::Symmetric3<T>(S);
}

/// What a point shows: Cauchy stress without that of the director, and gamma. F, by rows, takes those axes to
/// space; the director's stretch in it is not that of the metal.
template <bool kinematic>
KOKKOS_INLINE_FUNCTION void shellMetalShown(const Metal& metal, const taylor::Symmetric3<double>& strain,
                                            const double* data, const double* variables, const double* F,
                                            double* shown) {
  double E[6], S[6], event[1 + FlowRule<kinematic, true>::numVariables];
  strain.store(E);
  const double director = std::sqrt(1 + 2 * E[2]);
  metalStress<kinematic, true>(metal, E, data, variables, S, event);
  const double volume = std::sqrt(1 + 2 * E[2]) / director *
                        (F[0] * (F[4] * F[8] - F[5] * F[7]) - F[1] * (F[3] * F[8] - F[5] * F[6]) +
                         F[2] * (F[3] * F[7] - F[4] * F[6]));
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j) {
      double sum = 0;
      for (int k = 0; k < 3; ++k)
        for (int l = 0; l < 3; ++l) sum += F[3 * i + k] * S[taylor::symmetricIndex(k, l)] * F[3 * j + l];
      shown[taylor::symmetricIndex(i, j)] = sum / volume;
    }
  shown[6] = event[1];
}

}  // namespace detail

/// A metal (VonMises) at a point of a shell; transverse shear strains are those of the displacements.
///
/// in: H_ij = du_i/dX_j by rows, 9 entries, dimensionless.
/// data: 1 where the point yields, else 0; the axes at rest, 3 the normal, [component][axis]; the variables.
/// out: first Piola-Kirchhoff stress, 9 entries by rows; event function; gamma, p, X in the axes.
template <bool kinematic>
struct ShellMetal {
  static constexpr int numVariables = detail::FlowRule<kinematic, true>::numVariables;
  static constexpr int numEvents = 1, numInputs = 9, numOutputs = 10 + numVariables;
  static constexpr int firstVariable = 10, numData = firstVariable + numVariables;
  static constexpr bool symmetric = true;
  Metal metal;

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* in, const taylor::Passive<T>* data, T* out) const {
    using P = taylor::Passive<T>;
    const taylor::Matrix3<T> H(in);
    taylor::Symmetric3<T> inAxes, S;
    taylor::detail::linear(detail::ToCartesian<P>{turned(data + 1).entries}, greenLagrange(H), inAxes);
    const auto stress =
        detail::shellMetalStress<kinematic>(metal, inAxes, data, data + firstVariable, out + 9);
    taylor::detail::linear(detail::ToCartesian<P>{data + 1}, stress, S);
    const taylor::Matrix3<T> first = full(S) + H * S;
    first.store(out);
  }

  static constexpr int numObserved = Metal::numObserved;
  static auto observedNames() { return Metal::observedNames(); }
  KOKKOS_INLINE_FUNCTION void observe(const double* in, const double* data, double* shown) const {
    const double* axes = data + 1;
    double F[9];
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k)
        F[3 * i + k] =
            axes[3 * i + k] + in[3 * i] * axes[k] + in[3 * i + 1] * axes[3 + k] + in[3 * i + 2] * axes[6 + k];
    taylor::Symmetric3<double> inAxes;
    taylor::detail::linear(detail::ToCartesian<double>{turned(axes).entries},
                           greenLagrange(taylor::Matrix3<double>(in)), inAxes);
    detail::shellMetalShown<kinematic>(metal, inAxes, data, data + firstVariable, F, shown);
  }

 private:
  /// The transpose.
  template <class P>
  struct Turned {
    P entries[9];
  };
  template <class P>
  static KOKKOS_FORCEINLINE_FUNCTION Turned<P> turned(const P* axes) {
    return {{axes[0], axes[3], axes[6], axes[1], axes[4], axes[7], axes[2], axes[5], axes[8]}};
  }
};

/// The same with assumed transverse shear strains (AssumedShearLaw).
///
/// in: changes of the four vectors (length, 12: [component][vector]); out: their work conjugates per
/// reference volume (12), event function; gamma, p, X in the axes. data: 1 where the point yields, else 0;
/// the four vectors at rest (12); the contravariant base G^i in axes of which 3 is the normal at rest
/// ([axis][i], 9); the variables.
template <bool kinematic>
struct AssumedShearMetal {
  static constexpr int numVariables = detail::FlowRule<kinematic, true>::numVariables;
  static constexpr int numEvents = 1, numInputs = 12, numOutputs = 13 + numVariables;
  static constexpr int firstVariable = 22, numData = firstVariable + numVariables;
  static constexpr bool symmetric = true;
  Metal metal;

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* in, const taylor::Passive<T>* data, T* out) const {
    const ShellBase<T> h(in);
    const auto stress = detail::shellMetalStress<kinematic>(metal, shellStrain(h, data + 1, data + 13), data,
                                                            data + firstVariable, out + 12);
    const ShellBase<T> f = shellForces(h, stress, data + 1, data + 13);
    f.store(out);
  }

  static constexpr int numObserved = Metal::numObserved;
  static auto observedNames() { return Metal::observedNames(); }
  /// With F = g_i x G^i, g_3 the mean of the two directors.
  KOKKOS_INLINE_FUNCTION void observe(const double* in, const double* data, double* shown) const {
    const double *G = data + 1, *base = data + 13;
    double F[9];
    for (int i = 0; i < 3; ++i) {
      double g[4];
      for (int v = 0; v < 4; ++v) g[v] = G[4 * i + v] + in[4 * i + v];
      for (int k = 0; k < 3; ++k)
        F[3 * i + k] = g[0] * base[3 * k] + g[1] * base[3 * k + 1] + 0.5 * (g[2] + g[3]) * base[3 * k + 2];
    }
    detail::shellMetalShown<kinematic>(metal, shellStrain(ShellBase<double>(in), G, base), data,
                                       data + firstVariable, F, shown);
  }
};

}  // namespace atrapos::solid

ATRAPOS_DECLARE_POINT_LAW(atrapos::solid::ShellMetal<false>)
ATRAPOS_DECLARE_POINT_LAW(atrapos::solid::ShellMetal<true>)
ATRAPOS_DECLARE_POINT_LAW(atrapos::solid::AssumedShearMetal<false>)
ATRAPOS_DECLARE_POINT_LAW(atrapos::solid::AssumedShearMetal<true>)
