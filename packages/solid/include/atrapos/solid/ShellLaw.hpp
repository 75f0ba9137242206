#pragma once

#include <string>
#include <vector>

#include "atrapos/solid/Strain.hpp"
#include "atrapos/taylor/FunctionMarks.hpp"
#include "atrapos/taylor/Law.hpp"

namespace atrapos::solid {

/// A material of solids at a point of a shell, paper (32)-(34) (docs/theory/shell.md):
///
///     E = (H + H^T + H^T H)/2 + e g x g,   S = S(E),   P = (I + H) S,   s = S : g x g
///
/// in: H_ij = du_i/dX_j by rows (9, dimensionless), e (length^2, as g is 1/length).
///
/// out: first Piola-Kirchhoff stress P_ij by rows (9, force per reference area), s (conjugate of e).
///
/// data: g (3), the scaled contravariant base vector of shellPoints.
///
/// Material: `template <class T> taylor::Symmetric3<T> secondPiola(const taylor::Symmetric3<T>& E) const`,
/// the second Piola-Kirchhoff stress of the Green-Lagrange strain.
template <class Material>
struct ShellLaw {
  static constexpr int numInputs = 10, numOutputs = 10, numData = 3;
  static constexpr bool symmetric = Material::symmetric;

  Material material;

  /// S of (H, e).
  template <class T>
  ATRAPOS_FORCEINLINE taylor::Symmetric3<T> stress(const taylor::Matrix3<T>& H, const T& e,
                                                   const taylor::Passive<T>* g) const {
    return material.secondPiola(plusDyad(greenLagrange(H), e, g));
  }

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* in, const taylor::Passive<T>* g, T* out) const {
    const taylor::Matrix3<T> H(in);
    const taylor::Symmetric3<T> S = stress(H, in[9], g);
    const taylor::Matrix3<T> P = full(S) + H * S;
    P.store(out);
    out[9] = projection(S, g);
  }

  static constexpr int numObserved = 6;
  static std::vector<std::string> observedNames() {
    return {"stress_xx", "stress_yy", "stress_zz", "stress_xy", "stress_yz", "stress_zx"};
  }
  /// Cauchy stress F S F^T / det F with the deformation gradient F = I + H of the nodes.
  KOKKOS_INLINE_FUNCTION void observe(const double* in, const double* g, double* sigma) const {
    double out[10];
    (*this)(in, g, out);
    cauchyStress(out, in, sigma);
  }
};

}  // namespace atrapos::solid
