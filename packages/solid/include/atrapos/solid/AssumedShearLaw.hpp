#pragma once

#include <string>
#include <vector>

#include "atrapos/solid/ShellBase.hpp"
#include "atrapos/solid/Strain.hpp"
#include "atrapos/taylor/FunctionMarks.hpp"
#include "atrapos/taylor/Law.hpp"

namespace atrapos::solid {

/// A material of solids at a point of a shell with assumed transverse shear strains (docs/theory/shell.md,
/// "Assumed transverse shear"): the element of ShellLaw without its locking where thin plates are clamped.
///
///     E_ij = (g_i.g_j - G_i.G_j)/2,   E_13, E_23 with the directors d_1, d_2 of the assumed shear,
///     E = E_ij G^i x G^j + e g x g,   S = S(E),   s = S : g x g
///
/// in: changes of the four vectors x_,xi, x_,eta, d_1, d_2 (length, 12: [component][vector]), e (length^2, as
/// g is 1/length).
///
/// out: their work conjugates per reference volume (12), s (conjugate of e).
///
/// data: the four vectors at rest (12, the same order), the contravariant base G^i ([component][i], 9), the
/// scaled contravariant vector g of the enhanced strain (3).
///
/// Material: `template <class T> taylor::Symmetric3<T> secondPiola(const taylor::Symmetric3<T>& E) const`,
/// the second Piola-Kirchhoff stress of the Green-Lagrange strain, Cartesian components.
template <class Material>
struct AssumedShearLaw {
  static constexpr int numInputs = 13, numOutputs = 13, numData = 24;
  static constexpr bool symmetric = Material::symmetric;

  Material material;

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* in, const taylor::Passive<T>* data, T* out) const {
    const ShellBase<T> h(in);
    const taylor::Symmetric3<T> S = stress(h, in[12], data);
    const ShellBase<T> f = shellForces(h, S, data, data + 12);
    f.store(out);
    out[12] = projection(S, data + 21);
  }

  static constexpr int numObserved = 6;
  static std::vector<std::string> observedNames() {
    return {"stress_xx", "stress_yy", "stress_zz", "stress_xy", "stress_yz", "stress_zx"};
  }
  /// Cauchy stress F S F^T / det F with F = g_i x G^i, g_3 the mean of the two directors, without the
  /// enhanced part.
  KOKKOS_INLINE_FUNCTION void observe(const double* in, const double* data, double* sigma) const {
    const taylor::Symmetric3<double> S = stress(ShellBase<double>(in), in[12], data);
    double H[9];
    const double* A = data + 12;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        H[3 * i + j] = in[4 * i] * A[3 * j] + in[4 * i + 1] * A[3 * j + 1] +
                       0.5 * (in[4 * i + 2] + in[4 * i + 3]) * A[3 * j + 2];
    cauchyStress(S, H, sigma);
  }

 private:
  template <class T>
  ATRAPOS_FORCEINLINE taylor::Symmetric3<T> stress(const ShellBase<T>& h, const T& e,
                                                   const taylor::Passive<T>* data) const {
    return material.secondPiola(plusDyad(shellStrain(h, data, data + 12), e, data + 21));
  }
};

}  // namespace atrapos::solid
