#pragma once

#include <Kokkos_Macros.hpp>
#include <string>

#include "atrapos/contact/Requirements.hpp"

namespace atrapos::contact {

/// Plane through `point` with unit `normal` pointing to the free side; paper (10).
struct Plane {
  static constexpr int numUnknowns = 4;
  static constexpr bool symmetric = true;
  double point[3] = {0, 0, 0};
  double normal[3] = {0, 0, 1};

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* x, const T* y, T* g) const {
    g[0] = y[0] -
           (normal[0] * (x[0] - point[0]) + normal[1] * (x[1] - point[1]) + normal[2] * (x[2] - point[2]));
    for (int i = 0; i < 3; ++i) g[1 + i] = y[1 + i] - normal[i];
  }

  KOKKOS_INLINE_FUNCTION void start(const double* x, double* y) const {
    y[0] = 0;
    for (int i = 0; i < 3; ++i) {
      y[0] += normal[i] * (x[i] - point[i]);
      y[1 + i] = normal[i];
    }
  }

  void validate() const {
    detail::requireFinite("plane", "point", point);
    detail::requireUnit("plane", "normal", normal);
  }
  std::string ambiguity(const double*) const { return {}; }
};

}  // namespace atrapos::contact
