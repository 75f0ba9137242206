#pragma once

#include "atrapos/solid/Mitc4Base.hpp"
#include "atrapos/solid/ShellMetal.hpp"

namespace atrapos::solid {

/// A metal (VonMises) at a point of a four-node shell (Mitc4Law; ShellMetal for the rest).
///
/// in: changes of the element's seven vectors (length, 21); out: their work conjugates per reference volume
/// (21), event function; gamma, p, X in the axes. data: 1 where the point yields, else 0; the seven vectors
/// at rest (21); the place (11); the contravariant base G^i in axes of which 3 is the normal at rest
/// ([axis][i], 9); the variables.
template <bool kinematic>
struct Mitc4Metal {
  static constexpr int numVariables = detail::FlowRule<kinematic, true>::numVariables;
  static constexpr int numEvents = 1, numInputs = 21, numOutputs = 22 + numVariables;
  static constexpr int firstPlace = 22, firstBase = firstPlace + Mitc4Place<double>::numData,
                       firstVariable = firstBase + 9, numData = firstVariable + numVariables;
  static constexpr bool symmetric = true;
  Metal metal;

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* in, const taylor::Passive<T>* data, T* out) const {
    const Mitc4Point<T> point(in, data + 1, data + firstPlace);
    const auto stress = detail::shellMetalStress<kinematic>(metal, point.strain(data + firstBase), data,
                                                            data + firstVariable, out + 21);
    point.forces(stress, data + firstBase, out);
  }

  static constexpr int numObserved = Metal::numObserved;
  static auto observedNames() { return Metal::observedNames(); }
  KOKKOS_INLINE_FUNCTION void observe(const double* in, const double* data, double* shown) const {
    double now[21], F[9];
    for (int i = 0; i < 21; ++i) now[i] = data[1 + i] + in[i];
    detail::mitc4Gradient(now, data + firstPlace, data + firstBase, F);
    const Mitc4Point<double> point(in, data + 1, data + firstPlace);
    detail::shellMetalShown<kinematic>(metal, point.strain(data + firstBase), data, data + firstVariable, F,
                                       shown);
  }
};

}  // namespace atrapos::solid

ATRAPOS_DECLARE_POINT_LAW(atrapos::solid::Mitc4Metal<false>)
ATRAPOS_DECLARE_POINT_LAW(atrapos::solid::Mitc4Metal<true>)
