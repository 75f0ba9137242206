#pragma once

#include <cmath>

#include "atrapos/fem/PointLaw.hpp"
#include "atrapos/solid/MooneyRivlin.hpp"
#include "atrapos/solid/NeoHookean.hpp"
#include "atrapos/solid/SaintVenantKirchhoff.hpp"
#include "atrapos/solid/Strain.hpp"

namespace atrapos::physics {

/// A material in an electric field (docs/theory/dielectric.md): with the potential phi in the undeformed body
///
///     Omega = W(F) - (eps/2) J |F^-T grad phi|^2,
///
/// stationary: least in the displacements, greatest in the potential.
///
/// in:  H_ij = du_i/dX_j by rows (9); grad phi (3), by the undeformed place
/// out: dOmega/dF = P + Maxwell's stress, by rows (9); dOmega/d(grad phi) (3), the displacement field
///      D = -eps J C^-1 grad phi by the undeformed area
template <class Material>
struct Dielectric {
  static constexpr int numInputs = 12, numOutputs = 12, numData = 0;
  static constexpr bool symmetric = true;

  Material material;
  double permittivity = 1;

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* in, const taylor::Passive<T>* data, T* out) const {
    T P[9], F[9], cof[9], d[3], m[3];
    material(in, data, P);
    for (int i = 0; i < 9; ++i) F[i] = i % 4 == 0 ? T(1.0 + in[i]) : in[i];
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        const int a = (i + 1) % 3, b = (i + 2) % 3, p = (j + 1) % 3, q = (j + 2) % 3;
        cof[3 * i + j] = T(F[3 * a + p] * F[3 * b + q] - F[3 * a + q] * F[3 * b + p]);
      }
    const T J = T(F[0] * cof[0] + F[1] * cof[1] + F[2] * cof[2]);
    // F^-T grad phi = d/J, F^-1 of it m/J^2.
    for (int i = 0; i < 3; ++i)
      d[i] = T(cof[3 * i] * in[9] + cof[3 * i + 1] * in[10] + cof[3 * i + 2] * in[11]);
    for (int j = 0; j < 3; ++j) m[j] = T(cof[j] * d[0] + cof[3 + j] * d[1] + cof[6 + j] * d[2]);
    const T inverse = T(1.0 / J);
    const T share = T(permittivity * (inverse * inverse));
    const T half = T(0.5 * (share * T(d[0] * d[0] + d[1] * d[1] + d[2] * d[2])));
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        out[3 * i + j] = T(P[3 * i + j] + share * T(d[i] * m[j]) - half * cof[3 * i + j]);
    for (int j = 0; j < 3; ++j) out[9 + j] = T((-permittivity) * (inverse * m[j]));
  }

  /// The material's stress and Maxwell's, which cancel everywhere in a body that is free.
  void sizes(const double* in, const double* data, double* out) const {
    double P[9];
    material(in, data, P);
    (*this)(in, data, out);
    for (int i = 0; i < 9; ++i) out[i] = std::fabs(P[i]) + std::fabs(out[i] - P[i]);
  }

  static constexpr int numObserved = 6;
  static std::vector<std::string> observedNames() { return Material::observedNames(); }
  /// Cauchy stress, Maxwell's with it.
  KOKKOS_INLINE_FUNCTION void observe(const double* in, const double* data, double* sigma) const {
    double out[numOutputs];
    (*this)(in, data, out);
    solid::cauchyStress(out, in, sigma);
  }
};

}  // namespace atrapos::physics

ATRAPOS_DECLARE_POINT_LAW(atrapos::physics::Dielectric<atrapos::solid::SaintVenantKirchhoff>)
ATRAPOS_DECLARE_POINT_LAW(atrapos::physics::Dielectric<atrapos::solid::NeoHookean>)
ATRAPOS_DECLARE_POINT_LAW(atrapos::physics::Dielectric<atrapos::solid::MooneyRivlin>)
