#pragma once

#include <Kokkos_Macros.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "atrapos/taylor/Law.hpp"

/// Laws of the finite-element tests: made for having infinite series, not for any material.
namespace atrapos::fem::test {

/// Energy scale * [ (a/b)(exp(b tr g) - b tr g) + mu g:g ] of the Green-Lagrange strain g = (H + H^T + H^T
/// H)/2, hence S = scale * [ a (exp(b tr g) - 1) I + 2 mu g ] and T = (I + H) S. The scale is the point's
/// datum.
struct ExponentialSolid {
  static constexpr int numInputs = 9, numOutputs = 9, numData = 1;
  static constexpr bool symmetric = true;

  double a = 1.0, b = 0.7, mu = 0.8;

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* H, const taylor::Passive<T>* scale, T* P) const {
    using std::exp;
    T g[9], S[9];
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        g[3 * i + j] =
            0.5 * (H[3 * i + j] + H[3 * j + i] + (H[i] * H[j] + H[3 + i] * H[3 + j] + H[6 + i] * H[6 + j]));
    const T volumetric = a * exp(b * (g[0] + g[4] + g[8])) - a;
    for (int m = 0; m < 9; ++m) S[m] = (2 * mu) * g[m];
    for (int i = 0; i < 3; ++i) S[4 * i] = S[4 * i] + volumetric;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        P[3 * i + j] =
            scale[0] * (S[3 * i + j] + H[3 * i] * S[j] + H[3 * i + 1] * S[3 + j] + H[3 * i + 2] * S[6 + j]);
  }

  static constexpr int numObserved = 2;
  static std::vector<std::string> observedNames() { return {"trace", "scale"}; }
  /// Trace of H, and the point's datum.
  KOKKOS_INLINE_FUNCTION void observe(const double* H, const double* scale, double* observed) const {
    observed[0] = H[0] + H[4] + H[8];
    observed[1] = scale[0];
  }
};

/// A body with a temperature theta, in: H (9), theta, grad theta (3); potential
///     mu g:g + a/2 (tr g)^2 + c (e^theta - 1) tr g + (k/2) e^theta |grad theta|^2
/// of which the derivative by theta counts `source` times: symmetric where that is 1.
template <int source>
struct HeatedSolid {
  static constexpr int numInputs = 13, numOutputs = 13, numData = 0;
  static constexpr bool symmetric = source == 1;

  double a = 1.0, mu = 0.8, c = 0.4, k = 0.6;

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* in, const taylor::Passive<T>*, T* out) const {
    using std::exp;
    const T* H = in;
    const T* q = in + 10;
    T g[9], S[9];
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        g[3 * i + j] =
            0.5 * (H[3 * i + j] + H[3 * j + i] + (H[i] * H[j] + H[3 + i] * H[3 + j] + H[6 + i] * H[6 + j]));
    const T e = exp(in[9]), trace = g[0] + g[4] + g[8];
    const T volumetric = a * trace + c * e - c;
    for (int m = 0; m < 9; ++m) S[m] = (2 * mu) * g[m];
    for (int i = 0; i < 3; ++i) S[4 * i] = S[4 * i] + volumetric;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        out[3 * i + j] = S[3 * i + j] + H[3 * i] * S[j] + H[3 * i + 1] * S[3 + j] + H[3 * i + 2] * S[6 + j];
    const T square = q[0] * q[0] + q[1] * q[1] + q[2] * q[2];
    out[9] = double(source) * (e * (c * trace + (k / 2) * square));
    for (int i = 0; i < 3; ++i) out[10 + i] = k * (e * q[i]);
  }
};

/// A force towards the origin that saturates, c x / (1 + x.x): energy (c/2) log(1 + x.x).
struct CentralForce {
  static constexpr int numInputs = 3, numOutputs = 3, numData = 0;
  static constexpr bool symmetric = true;

  double c = 0.3;

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* x, const taylor::Passive<T>*, T* f) const {
    const T r = 1.0 + (x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
    for (int i = 0; i < 3; ++i) f[i] = c * (x[i] / r);
  }

  static constexpr int numObserved = 3;
  static std::vector<std::string> observedNames() { return {"x", "y", "z"}; }
  /// The position itself.
  KOKKOS_INLINE_FUNCTION void observe(const double* x, const double*, double* observed) const {
    for (int i = 0; i < 3; ++i) observed[i] = x[i];
  }
};

/// A swirl about the z axis, which has no energy: c (-y, x, 0) (1 + z).
struct Swirl {
  static constexpr int numInputs = 3, numOutputs = 3, numData = 0;
  static constexpr bool symmetric = false;

  double c = 0.3;

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* x, const taylor::Passive<T>*, T* f) const {
    const T z = 1.0 + x[2];
    f[0] = -c * (x[1] * z);
    f[1] = c * (x[0] * z);
    f[2] = 0.0;
  }

  static constexpr int numObserved = 0;
  static std::vector<std::string> observedNames() { return {}; }
  KOKKOS_INLINE_FUNCTION void observe(const double*, const double*, double*) const {}
};

/// A pull towards the place (lambda, 0, 0) whose strength grows with the load factor: (c + lambda^2) (x -
/// lambda e_1).
struct MovingPull {
  static constexpr int numInputs = 4, numOutputs = 3, numData = 0;
  static constexpr bool symmetric = true;

  double c = 0.3;

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* in, const taylor::Passive<T>*, T* f) const {
    const T strength = c + in[3] * in[3];
    f[0] = strength * (in[0] - in[3]);
    f[1] = strength * in[1];
    f[2] = strength * in[2];
  }

  static constexpr int numObserved = 1;
  static std::vector<std::string> observedNames() { return {"strength"}; }
  KOKKOS_INLINE_FUNCTION void observe(const double* in, const double*, double* observed) const {
    observed[0] = c + in[3] * in[3];
  }
};

}  // namespace atrapos::fem::test
