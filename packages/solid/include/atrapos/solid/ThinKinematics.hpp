#pragma once

#include <cmath>

#include "atrapos/taylor/Tensor.hpp"

/// Kinematics (ShellKinematics.hpp) of bodies that resist stretching alone (docs/theory/thin.md). Stress that
/// is there at rest, second Piola-Kirchhoff, is added to that of the strains. `free`: the last of x is h, the
/// stretch across the body less 1, and its conjugate the force across it; else a material has eliminated
/// them.
namespace atrapos::solid {

namespace detail {

/// Of a direction across the body: E = h + h^2/2, and the conjugate of h.
template <class T>
ATRAPOS_FORCEINLINE T strainAcross(const T& h) {
  return h + 0.5 * (h * h);
}
template <class T>
ATRAPOS_FORCEINLINE T forceAcross(const T& h, const T& S) {
  return S + h * S;
}

}  // namespace detail

/// A membrane. x: du_i/dX_b along two axes at rest, [component][axis], h; data: these axes,
/// [component][axis], and the stress at rest, the same in all directions of the surface.
template <bool free>
struct MembraneKinematics {
  static constexpr int numInputs = free ? 7 : 6, numData = 7;

  template <class T>
  static ATRAPOS_FORCEINLINE taylor::Symmetric3<T> strain(const T* x, const taylor::Passive<T>* data) {
    taylor::Symmetric3<T> E;
    E.set(0, 0, change(x, data, 0, 0));
    E.set(1, 1, change(x, data, 1, 1));
    E.set(0, 1, change(x, data, 0, 1));
    E.set(0, 2, T(0.0));
    E.set(1, 2, T(0.0));
    if constexpr (free)
      E.set(2, 2, detail::strainAcross(x[6]));
    else
      E.set(2, 2, T(0.0));
    return E;
  }
  template <class T>
  static ATRAPOS_FORCEINLINE void forces(const T* x, const taylor::Symmetric3<T>& S,
                                         const taylor::Passive<T>* data, T* out) {
    const T s00 = S(0, 0) + data[6], s11 = S(1, 1) + data[6], s01 = S(0, 1);
    for (int i = 0; i < 3; ++i) {
      const T a0 = x[2 * i] + data[2 * i], a1 = x[2 * i + 1] + data[2 * i + 1];
      out[2 * i] = s00 * a0 + s01 * a1;
      out[2 * i + 1] = s01 * a0 + s11 * a1;
    }
    if constexpr (free) out[6] = detail::forceAcross(x[6], S(2, 2));
  }
  static KOKKOS_INLINE_FUNCTION void gradient(const double* x, const double* data, double* F) {
    for (int i = 0; i < 3; ++i)
      for (int b = 0; b < 2; ++b) F[3 * i + b] = data[2 * i + b] + x[2 * i + b];
    double n[3], square = 0;
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      n[i] = F[3 * j] * F[3 * k + 1] - F[3 * k] * F[3 * j + 1];
      square += n[i] * n[i];
    }
    double stretch = 1;
    if constexpr (free) stretch += x[6];
    for (int i = 0; i < 3; ++i) F[3 * i + 2] = stretch * n[i] / std::sqrt(square);
  }

 private:
  /// (a_b.h_c + h_b.a_c + h_b.h_c)/2
  template <class T>
  static ATRAPOS_FORCEINLINE T change(const T* x, const taylor::Passive<T>* a, int b, int c) {
    const T quadratic = x[b] * x[c] + x[2 + b] * x[2 + c] + x[4 + b] * x[4 + c];
    const T left = a[b] * x[c] + a[2 + b] * x[2 + c] + a[4 + b] * x[4 + c];
    const T right = a[c] * x[b] + a[2 + c] * x[2 + b] + a[4 + c] * x[4 + b];
    return 0.5 * (left + right + quadratic);
  }
};

/// A bar, of a material that is the same in all directions. x: du_i/dS along it, 3, h; data: its direction at
/// rest, 3, and its stress there.
template <bool free>
struct BarKinematics {
  static constexpr int numInputs = free ? 4 : 3, numData = 4;

  template <class T>
  static ATRAPOS_FORCEINLINE taylor::Symmetric3<T> strain(const T* x, const taylor::Passive<T>* data) {
    const T quadratic = x[0] * x[0] + x[1] * x[1] + x[2] * x[2];
    const T along = data[0] * x[0] + data[1] * x[1] + data[2] * x[2] + 0.5 * quadratic;
    taylor::Symmetric3<T> E;
    E.set(0, 0, along);
    for (int m = 3; m < 6; ++m) E.set(m, T(0.0));
    for (int m = 1; m < 3; ++m)
      if constexpr (free)
        E.set(m, detail::strainAcross(x[3]));
      else
        E.set(m, T(0.0));
    return E;
  }
  template <class T>
  static ATRAPOS_FORCEINLINE void forces(const T* x, const taylor::Symmetric3<T>& S,
                                         const taylor::Passive<T>* data, T* out) {
    const T s = S(0, 0) + data[3];
    for (int i = 0; i < 3; ++i) {
      const T t = x[i] + data[i];
      out[i] = s * t;
    }
    if constexpr (free) {
      const T both = S(1, 1) + S(2, 2);
      out[3] = detail::forceAcross(x[3], both);
    }
  }
  static KOKKOS_INLINE_FUNCTION void gradient(const double* x, const double* data, double* F) {
    double t[3];
    for (int i = 0; i < 3; ++i) t[i] = data[i] + x[i];
    // Across t and the axis of space that is farthest from it.
    int farthest = 0;
    for (int i = 1; i < 3; ++i)
      if (std::abs(t[i]) < std::abs(t[farthest])) farthest = i;
    const int j = (farthest + 1) % 3, k = (farthest + 2) % 3;
    double n[3];
    n[farthest] = 0;
    n[j] = t[k];
    n[k] = -t[j];
    double stretch = 1;
    if constexpr (free) stretch += x[3];
    const double length = std::sqrt(t[0] * t[0] + t[1] * t[1] + t[2] * t[2]),
                 across = stretch / std::sqrt(n[j] * n[j] + n[k] * n[k]);
    for (int i = 0; i < 3; ++i) n[i] *= across;
    for (int i = 0; i < 3; ++i) {
      const int a = (i + 1) % 3, b = (i + 2) % 3;
      F[3 * i] = t[i];
      F[3 * i + 1] = n[i];
      F[3 * i + 2] = (t[a] * n[b] - t[b] * n[a]) / length;
    }
  }
};

}  // namespace atrapos::solid
