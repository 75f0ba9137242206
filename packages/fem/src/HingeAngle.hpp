#pragma once

#include <cmath>

#include "atrapos/fem/PointLaw.hpp"
#include "atrapos/taylor/Trigonometric.hpp"

namespace atrapos::fem {

/// m g with g = -sin(phi) e.Fe + cos(phi) f.Fe, F = I + H: where g = 0 the rotation F about e x f turns e by
/// the angle phi, and the moment about that axis is m.
///
/// in, out: H_ij [3 i + j], m, phi; dimensionless.
struct HingeAngle {
  static constexpr int numInputs = 11, numOutputs = 11, numData = 0;
  static constexpr bool symmetric = true;

  double e[3] = {1, 0, 0}, f[3] = {0, 1, 0};  ///< orthonormal, across the axis

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* in, const taylor::Passive<T>*, T* out) const {
    using std::cos;
    using std::sin;
    T alongE = in[0] * (e[0] * e[0]) + 1.0, alongF = in[0] * (f[0] * e[0]);  // of F e
    for (int k = 1; k < 9; ++k) {
      const int i = k / 3, j = k % 3;
      alongE = alongE + in[k] * (e[i] * e[j]);
      alongF = alongF + in[k] * (f[i] * e[j]);
    }
    const T& m = in[9];
    const T s = sin(in[10]), c = cos(in[10]);
    const T ms = m * s, mc = m * c;
    for (int k = 0; k < 9; ++k) out[k] = mc * (f[k / 3] * e[k % 3]) - ms * (e[k / 3] * e[k % 3]);
    out[9] = c * alongF - s * alongE;
    out[10] = -(mc * alongE + ms * alongF);
  }
};

}  // namespace atrapos::fem

ATRAPOS_DECLARE_POINT_LAW(atrapos::fem::HingeAngle)
