#pragma once

#include "atrapos/solid/Mitc3Base.hpp"
#include "atrapos/solid/Mitc4Base.hpp"
#include "atrapos/solid/ShellMetal.hpp"

namespace atrapos::solid {

/// A metal (VonMises) at a point of a shell of four or three nodes (TiedShellLaw; ShellMetal for the rest).
///
/// in: changes of the element's vectors (length, 3 n); out: their work conjugates per reference volume (3 n),
/// event function; gamma, p, X in the axes. data: 1 where the point yields, else 0; the vectors at rest (3
/// n); the Element's Place; the contravariant base G^i in axes of which 3 is the normal at rest ([axis][i],
/// 9); the variables.
template <bool kinematic, class Element>
struct TiedShellMetal {
  static constexpr int numVariables = detail::FlowRule<kinematic, true>::numVariables;
  static constexpr int numEvents = 1, numInputs = 3 * Element::vectors,
                       numOutputs = numInputs + 1 + numVariables;
  static constexpr int firstPlace = 1 + numInputs,
                       firstBase = firstPlace + Element::template Place<double>::numData,
                       firstVariable = firstBase + 9, numData = firstVariable + numVariables;
  static constexpr bool symmetric = true;
  Metal metal;

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* in, const taylor::Passive<T>* data, T* out) const {
    const TiedPoint<Element, T> point(in, data + 1, data + firstPlace);
    const auto stress = detail::shellMetalStress<kinematic>(metal, point.strain(data + firstBase), data,
                                                            data + firstVariable, out + numInputs);
    point.forces(stress, data + firstBase, out);
  }

  static constexpr int numObserved = Metal::numObserved;
  static auto observedNames() { return Metal::observedNames(); }
  KOKKOS_INLINE_FUNCTION void observe(const double* in, const double* data, double* shown) const {
    double now[numInputs], F[9];
    for (int i = 0; i < numInputs; ++i) now[i] = data[1 + i] + in[i];
    detail::tiedGradient<Element>(now, data + firstPlace, data + firstBase, F);
    const TiedPoint<Element, double> point(in, data + 1, data + firstPlace);
    detail::shellMetalShown<kinematic>(metal, point.strain(data + firstBase), data, data + firstVariable, F,
                                       shown);
  }
};

template <bool kinematic>
using Mitc4Metal = TiedShellMetal<kinematic, Mitc4>;
template <bool kinematic>
using Mitc3Metal = TiedShellMetal<kinematic, Mitc3>;

}  // namespace atrapos::solid

ATRAPOS_DECLARE_POINT_LAW(atrapos::solid::Mitc4Metal<false>)
ATRAPOS_DECLARE_POINT_LAW(atrapos::solid::Mitc4Metal<true>)
ATRAPOS_DECLARE_POINT_LAW(atrapos::solid::Mitc3Metal<false>)
ATRAPOS_DECLARE_POINT_LAW(atrapos::solid::Mitc3Metal<true>)
