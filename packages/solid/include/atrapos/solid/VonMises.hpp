#pragma once

#include <cmath>

#include "atrapos/fem/PointLaw.hpp"
#include "atrapos/solid/Metal.hpp"
#include "atrapos/solid/Strain.hpp"
#include "atrapos/taylor/FunctionMarks.hpp"
#include "atrapos/taylor/Law.hpp"

namespace atrapos::solid {

/// Von Mises plasticity for small strains and any rotations (docs/theory/plasticity.md): with Green-Lagrange
/// strain E, plastic strain p, backstress X and accumulated plastic strain gamma
///
///     S = lambda tr(E) I + 2 mu (E - p),   xi = dev S - X,   q = sqrt(3/2 xi : xi),
///     q <= R(gamma),   p' = 3/2 xi/q gamma',   X' = 2/3 C p' - b X gamma',   gamma' >= 0,
///
/// as a rate law along the path: a point is elastic (free) or it yields (active), and changes at events
/// (fem::LawShape::events): 1 of q^2/R0^2 over R^2/R0^2, and gamma' = 0. In plane stress, where H_iz = H_zi
/// = 0, S_zz = 0 gives E_zz.
///
/// in:  H_ij = du_i/dX_j, row-major, 9 entries, dimensionless.
/// data: 1 where the point yields, else 0; then the variables.
/// out: first Piola-Kirchhoff stress, 9 entries by rows; event function; gamma, p (xx yy zz xy yz zx), X.
template <bool kinematic, bool planeStress = false>
struct VonMises {
  using Flow = detail::FlowRule<kinematic, planeStress>;
  static constexpr int numVariables = Flow::numVariables;
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
    T stress[6];
    detail::metalStress<kinematic, planeStress>(metal, E, data, data + 1, stress, out + 9);
    const taylor::Symmetric3<T> S(stress);
    const taylor::Matrix3<T> P = full(S) + H * S;
    P.store(out);
  }

  static constexpr int numObserved = Metal::numObserved;
  static auto observedNames() { return Metal::observedNames(); }
  /// Cauchy stress F S F^T / det F, and gamma.
  KOKKOS_INLINE_FUNCTION void observe(const double* H, const double* data, double* shown) const {
    double out[numOutputs];
    (*this)(H, data, out);
    double all[9];
    for (int i = 0; i < 9; ++i) all[i] = H[i];
    if constexpr (planeStress) {
      double E[6];
      const taylor::Symmetric3<double> strain = greenLagrange(taylor::Matrix3<double>(H));
      strain.store(E);
      all[8] = std::sqrt(1 + 2 * Flow{metal}.across(E, out + 10)) - 1;
    }
    cauchyStress(out, all, shown);
    shown[6] = out[10];
  }
};

}  // namespace atrapos::solid

ATRAPOS_DECLARE_POINT_LAW(atrapos::solid::VonMises<false>)
ATRAPOS_DECLARE_POINT_LAW(atrapos::solid::VonMises<true>)
ATRAPOS_DECLARE_POINT_LAW(atrapos::solid::VonMises<false, true>)
ATRAPOS_DECLARE_POINT_LAW(atrapos::solid::VonMises<true, true>)
