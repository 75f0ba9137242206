#pragma once

#include <string>
#include <vector>

#include "atrapos/solid/Mitc3Base.hpp"
#include "atrapos/solid/Mitc4Base.hpp"
#include "atrapos/solid/Strain.hpp"
#include "atrapos/taylor/FunctionMarks.hpp"
#include "atrapos/taylor/Law.hpp"

namespace atrapos::solid {

/// A material of solids at a point of a shell of four or three nodes, free of shear locking
/// (docs/theory/shell_mitc4.md, shell_triangles.md): E of assumed strains, plus e g x g, S = S(E), s = S : g
/// x g. n: the element's vectors, 7 or 5 (Mitc4Base.hpp, Mitc3Base.hpp).
///
/// in: changes of the element's vectors (length, 3 n: [component][vector]), e (length^2, as g is 1/length).
///
/// out: their work conjugates per reference volume (3 n), s (conjugate of e).
///
/// data: the vectors at rest (3 n, the same order), the Element's Place, the contravariant base G^i
/// ([component][i], 9), the scaled contravariant vector g of the enhanced strain (3).
///
/// Material: `template <class T> taylor::Symmetric3<T> secondPiola(const taylor::Symmetric3<T>& E) const`,
/// the second Piola-Kirchhoff stress of the Green-Lagrange strain, Cartesian components.
template <class Material, class Element>
struct TiedShellLaw {
  static constexpr int numVectors = 3 * Element::vectors, numInputs = numVectors + 1, numOutputs = numInputs;
  static constexpr int firstPlace = numVectors,
                       firstBase = firstPlace + Element::template Place<double>::numData,
                       firstEnhanced = firstBase + 9, numData = firstEnhanced + 3;
  static constexpr bool symmetric = Material::symmetric;

  Material material;

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* in, const taylor::Passive<T>* data, T* out) const {
    const TiedPoint<Element, T> point(in, data, data + firstPlace);
    const taylor::Symmetric3<T> S =
        material.secondPiola(plusDyad(point.strain(data + firstBase), in[numVectors], data + firstEnhanced));
    point.forces(S, data + firstBase, out);
    out[numVectors] = projection(S, data + firstEnhanced);
  }

  static constexpr int numObserved = 6;
  static std::vector<std::string> observedNames() {
    return {"stress_xx", "stress_yy", "stress_zz", "stress_xy", "stress_yz", "stress_zx"};
  }
  /// Cauchy stress F S F^T / det F with F = g_i x G^i of the nodes, without the enhanced part.
  KOKKOS_INLINE_FUNCTION void observe(const double* in, const double* data, double* sigma) const {
    const double* A = data + firstBase;
    const TiedPoint<Element, double> point(in, data, data + firstPlace);
    const taylor::Symmetric3<double> S =
        material.secondPiola(plusDyad(point.strain(A), in[numVectors], data + firstEnhanced));
    double H[9];
    detail::tiedGradient<Element>(in, data + firstPlace, A, H);
    cauchyStress(S, H, sigma);
  }
};

template <class Material>
using Mitc4Law = TiedShellLaw<Material, Mitc4>;
template <class Material>
using Mitc3Law = TiedShellLaw<Material, Mitc3>;

}  // namespace atrapos::solid
