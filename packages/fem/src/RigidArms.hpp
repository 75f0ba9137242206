#pragma once

#include "atrapos/fem/PointLaw.hpp"
#include "atrapos/taylor/Tensor.hpp"

namespace atrapos::fem {

/// M : E(H) with the Green-Lagrange strain E = (H + H^T + H^T H)/2 of the arms and the multipliers M: the
/// stationary value over M is E = 0.
///
/// in, out: H_ij [3 i + j], then [i][M_ii, M_i,i+1], dimensionless.
struct RigidArms {
  static constexpr int numInputs = 15, numOutputs = 15, numData = 0;
  static constexpr bool symmetric = true;

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* in, const taylor::Passive<T>*, T* out) const {
    T h[9], m[6];
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) h[3 * i + j] = in[3 * i + j];
      m[i] = in[9 + 2 * i];
      m[3 + i] = in[9 + 2 * i + 1];
    }
    const taylor::Matrix3<T> H(h);
    const taylor::Symmetric3<T> M(m);
    const taylor::Symmetric3<T> E = symmetricPart(H) + 0.5 * gramian(H);
    const taylor::Matrix3<T> P = full(M) + H * M;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) out[3 * i + j] = P(i, j);
      out[9 + 2 * i] = E(i, i);
      const T shear = E(i, (i + 1) % 3);
      out[9 + 2 * i + 1] = 2.0 * shear;
    }
  }
};

}  // namespace atrapos::fem

ATRAPOS_DECLARE_POINT_LAW(atrapos::fem::RigidArms)
