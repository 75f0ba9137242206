#pragma once

#include <Kokkos_Macros.hpp>
#include <string>
#include <vector>

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
/// Material: `template <class T> void secondPiola(const T* E, T* S) const`, both in the order xx, yy, zz, xy,
/// yz, zx with tensor (not engineering) shear strains.
template <class Material>
struct ShellLaw {
  static constexpr int numInputs = 10, numOutputs = 10, numData = 3;
  static constexpr bool symmetric = Material::symmetric;

  Material material;

  /// S of (H, e).
  template <class T>
  KOKKOS_INLINE_FUNCTION void stress(const T* in, const taylor::Passive<T>* g, T* S) const {
    const T* H = in;
    const T& e = in[9];
    T E[6];
    E[0] = H[0] + 0.5 * (H[0] * H[0] + H[3] * H[3] + H[6] * H[6]) + e * (g[0] * g[0]);
    E[1] = H[4] + 0.5 * (H[1] * H[1] + H[4] * H[4] + H[7] * H[7]) + e * (g[1] * g[1]);
    E[2] = H[8] + 0.5 * (H[2] * H[2] + H[5] * H[5] + H[8] * H[8]) + e * (g[2] * g[2]);
    E[3] = 0.5 * (H[1] + H[3] + (H[0] * H[1] + H[3] * H[4] + H[6] * H[7])) + e * (g[0] * g[1]);
    E[4] = 0.5 * (H[5] + H[7] + (H[1] * H[2] + H[4] * H[5] + H[7] * H[8])) + e * (g[1] * g[2]);
    E[5] = 0.5 * (H[2] + H[6] + (H[0] * H[2] + H[3] * H[5] + H[6] * H[8])) + e * (g[2] * g[0]);
    material.secondPiola(E, S);
  }

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* in, const taylor::Passive<T>* g, T* out) const {
    T S[6];
    stress(in, g, S);
    for (int i = 0; i < 3; ++i) {
      const T* h = in + 3 * i;
      out[3 * i + 0] = h[0] * S[0] + h[1] * S[3] + h[2] * S[5];
      out[3 * i + 1] = h[0] * S[3] + h[1] * S[1] + h[2] * S[4];
      out[3 * i + 2] = h[0] * S[5] + h[1] * S[4] + h[2] * S[2];
    }
    out[0] += S[0];
    out[1] += S[3];
    out[2] += S[5];
    out[3] += S[3];
    out[4] += S[1];
    out[5] += S[4];
    out[6] += S[5];
    out[7] += S[4];
    out[8] += S[2];
    out[9] = conjugate(S, g);
  }

  /// s alone: what the enhanced parameters' own equation needs.
  template <class T>
  KOKKOS_INLINE_FUNCTION T enhancedStress(const T* in, const taylor::Passive<T>* g) const {
    T S[6];
    stress(in, g, S);
    return conjugate(S, g);
  }

  /// Strain per unit of e.
  KOKKOS_INLINE_FUNCTION double enhancedStrainSize(const double* g) const {
    return g[0] * g[0] + g[1] * g[1] + g[2] * g[2];
  }

  static constexpr int numObserved = 6;
  static std::vector<std::string> observedNames() {
    return {"stress_xx", "stress_yy", "stress_zz", "stress_xy", "stress_yz", "stress_zx"};
  }
  /// Cauchy stress F S F^T / det F with the deformation gradient F = I + H of the nodes.
  KOKKOS_INLINE_FUNCTION void observe(const double* in, const double* g, double* sigma) const {
    double out[10], F[9];
    (*this)(in, g, out);
    for (int i = 0; i < 9; ++i) F[i] = in[i] + (i % 4 == 0);
    const double J = F[0] * (F[4] * F[8] - F[5] * F[7]) - F[1] * (F[3] * F[8] - F[5] * F[6]) +
                     F[2] * (F[3] * F[7] - F[4] * F[6]);
    const auto component = [&](int i, int j) {
      return (out[3 * i] * F[3 * j] + out[3 * i + 1] * F[3 * j + 1] + out[3 * i + 2] * F[3 * j + 2]) / J;
    };
    sigma[0] = component(0, 0);
    sigma[1] = component(1, 1);
    sigma[2] = component(2, 2);
    sigma[3] = component(0, 1);
    sigma[4] = component(1, 2);
    sigma[5] = component(2, 0);
  }

 private:
  template <class T, class G>
  KOKKOS_INLINE_FUNCTION static T conjugate(const T* S, const G* g) {
    return S[0] * (g[0] * g[0]) + S[1] * (g[1] * g[1]) + S[2] * (g[2] * g[2]) + S[3] * (2.0 * (g[0] * g[1])) +
           S[4] * (2.0 * (g[1] * g[2])) + S[5] * (2.0 * (g[2] * g[0]));
  }
};

}  // namespace atrapos::solid
