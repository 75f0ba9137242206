#pragma once

#include <memory>

#include "atrapos/fem/PointLaw.hpp"
#include "atrapos/solid/Metal.hpp"
#include "atrapos/solid/ShellKinematics.hpp"
#include "atrapos/taylor/Law.hpp"

/// Laws of shells in three stages: strain, material, forces. Each is compiled once, strains and forces for a
/// Kinematics, materials for themselves.
namespace atrapos::solid {

/// in: x of the Kinematics; out: the strain, 6; data: the Kinematics'.
template <class Kinematics>
struct ShellStrainStage {
  static constexpr bool stage = true, symmetric = false;
  static constexpr int numInputs = Kinematics::numInputs, numOutputs = 6, numData = Kinematics::numData;

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* in, const taylor::Passive<T>* data, T* out) const {
    Kinematics::strain(in, data).store(out);
  }
};

/// in: x of the Kinematics, the stress, 6; out: the forces; data: the Kinematics'.
template <class Kinematics>
struct ShellForceStage {
  static constexpr bool stage = true, symmetric = false;
  static constexpr int numInputs = Kinematics::numInputs + 6, numOutputs = Kinematics::numInputs,
                       numData = Kinematics::numData;

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* in, const taylor::Passive<T>* data, T* out) const {
    Kinematics::forces(in, taylor::Symmetric3<T>(in + Kinematics::numInputs), data, out);
  }
};

/// A material of solids in a shell. in: the strain, 6, and e (ShellLaw); out: the stress, 6, and s; data: g.
template <class Material>
struct ShellMaterialStage {
  static constexpr bool stage = true, symmetric = Material::symmetric;
  static constexpr int numInputs = 7, numOutputs = 7, numData = 3;

  Material material;

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* in, const taylor::Passive<T>* g, T* out) const {
    const taylor::Symmetric3<T> S = material.secondPiola(plusDyad(taylor::Symmetric3<T>(in), in[6], g));
    S.store(out);
    out[6] = projection(S, g);
  }
};

/// A metal in a shell, in axes of which 3 is the normal at rest (docs/theory/plasticity.md, "Shells"): plane
/// stress, and for the director's E_33 an elastic stress of its own, so that the director turns and does not
/// stretch.
///
/// in: the strain, 6; out: the stress, 6, the event function; gamma, p, X. data: 1 where the point yields,
/// else 0; the variables.
template <bool kinematic>
struct ShellMetalStage {
  static constexpr bool stage = true, symmetric = true;
  static constexpr int numVariables = detail::FlowRule<kinematic, true>::numVariables, numEvents = 1;
  static constexpr int numInputs = 6, numOutputs = 7 + numVariables, numData = 1 + numVariables;

  Metal metal;

  bool freeGrow() const { return metal.isSmoothed(); }

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* in, const taylor::Passive<T>* data, T* out) const {
    T E[6];
    for (int m = 0; m < 6; ++m) E[m] = in[m];
    const T ofDirector = (metal.lambda + 2 * metal.mu) * E[2];
    detail::metalStress<kinematic, true>(metal, E, data, data + 1, out, out + 6);
    out[2] = ofDirector;
  }
};

}  // namespace atrapos::solid

#define ATRAPOS_SHELL_STAGES(MACRO, ...)                               \
  MACRO(atrapos::solid::ShellStrainStage<atrapos::solid::__VA_ARGS__>) \
  MACRO(atrapos::solid::ShellForceStage<atrapos::solid::__VA_ARGS__>)

ATRAPOS_SHELL_STAGES(ATRAPOS_DECLARE_POINT_LAW, PlainShell)
ATRAPOS_SHELL_STAGES(ATRAPOS_DECLARE_POINT_LAW, AssumedShearShell)
ATRAPOS_SHELL_STAGES(ATRAPOS_DECLARE_POINT_LAW, TiedShell<atrapos::solid::Mitc4>)
ATRAPOS_SHELL_STAGES(ATRAPOS_DECLARE_POINT_LAW, TiedShell<atrapos::solid::Mitc3>)
ATRAPOS_SHELL_STAGES(ATRAPOS_DECLARE_POINT_LAW, TiedShell<atrapos::solid::Mitc6>)
ATRAPOS_DECLARE_POINT_LAW(atrapos::solid::ShellMetalStage<false>)
ATRAPOS_DECLARE_POINT_LAW(atrapos::solid::ShellMetalStage<true>)
