#pragma once

#include <cmath>

#include "atrapos/contact/RegularisedPressure.hpp"
#include "atrapos/taylor/Law.hpp"
#include "atrapos/taylor/Tensor.hpp"

/// Laws that the benchmark needs and the packages do not have. One source for all scalars: double, Sacado's
/// Fad and Taylor types, ADOL-C's adouble and the project's own.
namespace atrapos::bench {

/// Compressible neo-Hookean elasticity,
///
///     S = mu (I - C^-1) + lambda ln J C^-1,   P = F S = mu F + (lambda ln J - mu) / J cof F
///
/// (F^-T = cof F / J). in: H = F - I, row-major, dimensionless; out: P, row-major, force per reference area.
/// cof(I + H) = cof H - H^T + (1 + tr H) I: H alone needs a history, F does not.
struct NeoHookean {
  static constexpr int numInputs = 9, numOutputs = 9, numData = 0;

  double lambda = 0;  ///< stress units
  double mu = 0;      ///< stress units

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* in, const taylor::Passive<T>*, T* out) const {
    using std::log;
    const taylor::Matrix3<T> H(in);
    const T diagonal = trace(H) + 1.0;
    const taylor::Matrix3<T> cof = plusIdentity(cofactor(H) - transpose(H), diagonal);
    const T J = cof(0, 0) + determinant(H, cof);  // the first row of F times that of its cofactor
    const T q = (lambda * log(J) - mu) / J;
    const taylor::Matrix3<T> P = plusIdentity(scaled(cof, q) + mu * H, T(mu));
    P.store(out);
  }
};

/// Radius of a roll along its axis, y: constant.
struct CylinderProfile {
  double radius = 1;

  template <class T>
  KOKKOS_INLINE_FUNCTION T operator()(const T&) const {
    return T(radius);
  }
};

/// Radius of the tapered roll, paper (37) in consistent units:
///
///     r_p(y) = r - (tan p / 2) (y - l1) (1 + tanh((y - l1) sharpness))
///
/// r up to y = l1, a cone of angle p beyond. The printed formula multiplies the whole by r, widens the roll
/// and divides by epsilon; the text describes a convex roll, and epsilon = 23 fits as the sharpness per
/// length.
struct TaperedProfile {
  double radius = 1;
  double start = 0;      ///< l1, length
  double angle = 0;      ///< p, rad
  double sharpness = 1;  ///< 1/length

  template <class T>
  KOKKOS_INLINE_FUNCTION T operator()(const T& y) const {
    using std::tanh;
    const T beyond = y - start;
    return radius - (0.5 * std::tan(angle)) * beyond * (1.0 + tanh(sharpness * beyond));
  }
};

/// The tapered roll as a tool (contact/Tools.hpp), axis along y through (center[0], *, center[2]):
/// (h + r_p(y)) n - (x - C) = 0 without its y component, <n, n> - 1 = 0; paper (37).
struct TaperedRoll {
  static constexpr int numUnknowns = 4;
  static constexpr bool symmetric = false;  // n is radial, not grad h
  double center[3] = {0, 0, 0};
  TaperedProfile profile;

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* x, const T* y, T* g) const {
    const T distance = y[0] + profile(x[1]);
    g[0] = distance * y[1] - (x[0] - center[0]);
    g[1] = distance * y[2];
    g[2] = distance * y[3] - (x[2] - center[2]);
    g[3] = y[1] * y[1] + y[2] * y[2] + y[3] * y[3] - 1.0;
  }

  KOKKOS_INLINE_FUNCTION void start(const double* x, double* y) const {
    const double dx = x[0] - center[0], dz = x[2] - center[2], distance = std::sqrt(dx * dx + dz * dz);
    y[0] = distance - profile(x[1]);
    y[1] = dx / distance;
    y[2] = 0;
    y[3] = dz / distance;
  }
};

/// What ContactLaw gives for a roll along y, solved by hand: h = |x - C| - r_p(y), n = (x - C)/|x - C|, and
/// the positive root R of the contact law (15), written without cancellation for h > 0. The form in which
/// types without implicit functions can run the law at all. in: current position; data: reference gap Delta;
/// out: -R n.
template <class Profile>
struct ContactClosedForm {
  static constexpr int numInputs = 3, numOutputs = 3, numData = 1;

  double center[3] = {0, 0, 0};
  Profile profile;
  contact::RegularisedPressure pressure;

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* x, const taylor::Passive<T>* data, T* out) const {
    using std::sqrt;
    const T dx = x[0] - center[0], dz = x[2] - center[2];
    const T distance = sqrt(dx * dx + dz * dz);
    const T h = distance - profile(x[1]);
    const T load = pressure.eta * (data[0] - h);
    const T root = sqrt(h * h + (4 * pressure.compliance) * load);
    const T factor = -2.0 * load / ((h + root) * distance);  // -R / distance
    out[0] = factor * dx;
    out[1] = T(0.0);
    out[2] = factor * dz;
  }
};

}  // namespace atrapos::bench
