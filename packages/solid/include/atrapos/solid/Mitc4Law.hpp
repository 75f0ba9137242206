#pragma once

#include <Kokkos_Macros.hpp>
#include <string>
#include <vector>

#include "atrapos/solid/Mitc4Base.hpp"
#include "atrapos/solid/Strain.hpp"
#include "atrapos/taylor/Law.hpp"

namespace atrapos::solid {

/// A material of solids at a point of a four-node shell, free of shear and membrane locking
/// (docs/theory/shell_mitc4.md): E of assumed strains, plus e g x g, S = S(E), s = S : g x g.
///
/// in: changes of the element's seven vectors (length, 21: [component][vector], Mitc4Base.hpp), e (length^2,
/// as g is 1/length).
///
/// out: their work conjugates per reference volume (21), s (conjugate of e).
///
/// data: the seven vectors at rest (21, the same order), the place (Mitc4Place, 11), the contravariant base
/// G^i
/// ([component][i], 9), the scaled contravariant vector g of the enhanced strain (3).
///
/// Material: `template <class T> taylor::Symmetric3<T> secondPiola(const taylor::Symmetric3<T>& E) const`,
/// the second Piola-Kirchhoff stress of the Green-Lagrange strain, Cartesian components.
template <class Material>
struct Mitc4Law {
  static constexpr int numInputs = 22, numOutputs = 22;
  static constexpr int firstPlace = 21, firstBase = firstPlace + Mitc4Place<double>::numData,
                       firstEnhanced = firstBase + 9, numData = firstEnhanced + 3;
  static constexpr bool symmetric = Material::symmetric;

  Material material;

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* in, const taylor::Passive<T>* data, T* out) const {
    const Mitc4Point<T> point(in, data, data + firstPlace);
    const taylor::Symmetric3<T> S =
        material.secondPiola(plusDyad(point.strain(data + firstBase), in[21], data + firstEnhanced));
    point.forces(S, data + firstBase, out);
    out[21] = projection(S, data + firstEnhanced);
  }

  static constexpr int numObserved = 6;
  static std::vector<std::string> observedNames() {
    return {"stress_xx", "stress_yy", "stress_zz", "stress_xy", "stress_yz", "stress_zx"};
  }
  /// Cauchy stress F S F^T / det F with F = g_i x G^i of the nodes, without the enhanced part.
  KOKKOS_INLINE_FUNCTION void observe(const double* in, const double* data, double* sigma) const {
    const double* A = data + firstBase;
    const Mitc4Point<double> point(in, data, data + firstPlace);
    const taylor::Symmetric3<double> S =
        material.secondPiola(plusDyad(point.strain(A), in[21], data + firstEnhanced));
    double H[9];
    detail::mitc4Gradient(in, data + firstPlace, A, H);
    cauchyStress(S, H, sigma);
  }
};

}  // namespace atrapos::solid
