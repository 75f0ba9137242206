#pragma once

#include "atrapos/taylor/Tensor.hpp"

namespace atrapos::solid {

/// Green-Lagrange strain (H + H^T + H^T H)/2 of the displacement gradient, paper (5).
template <class T>
KOKKOS_FORCEINLINE_FUNCTION taylor::Symmetric3<T> greenLagrange(const taylor::Matrix3<T>& H) {
  return symmetricPart(H) + 0.5 * gramian(H);
}

}  // namespace atrapos::solid
