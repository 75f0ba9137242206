#pragma once

#include "atrapos/taylor/Implicit.hpp"

using atrapos::taylor::Passive;

/// P = (I + H) S, S = lambda tr(E) I + 2 mu E, E = (H + H^T + H^T H)/2; H and P by rows.
struct SaintVenantKirchhoff {
  static constexpr int numInputs = 9, numOutputs = 9, numData = 0;
  double lambda = 1.3, mu = 0.7;
  template <class T>
  void operator()(const T* H, const Passive<T>*, T* P) const {
    T E[3][3], S[3][3];
    for (int i = 0; i < 3; ++i)
      for (int j = i; j < 3; ++j) {
        E[i][j] = 0.5 * (H[3 * i + j] + H[3 * j + i]);
        for (int k = 0; k < 3; ++k) E[i][j] += 0.5 * (H[3 * k + i] * H[3 * k + j]);
      }
    const T spherical = lambda * (E[0][0] + E[1][1] + E[2][2]);
    for (int i = 0; i < 3; ++i)
      for (int j = i; j < 3; ++j) {
        S[i][j] = 2 * mu * E[i][j];
        if (i == j) S[i][j] += spherical;
      }
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        P[3 * i + j] = S[std::min(i, j)][std::max(i, j)];
        for (int k = 0; k < 3; ++k) P[3 * i + j] += H[3 * i + k] * S[std::min(k, j)][std::max(k, j)];
      }
  }
};

/// Paper (17): f(x) = x^2 + exp(3x).
struct SquarePlusExponential {
  static constexpr int numInputs = 1, numOutputs = 1, numData = 0;
  template <class T>
  void operator()(const T* x, const Passive<T>*, T* f) const {
    using std::exp;
    f[0] = x[0] * x[0] + exp(3 * x[0]);
  }
};

/// Paper (12): (h + r) n = X - C in the plane of n_x and n_z, n_y = 0, n.n = 1; x = X - C, y = (h, n),
/// data = radius.
struct CylinderProjection {
  template <class T>
  void operator()(const T* x, const T* y, const Passive<T>* radius, T* g) const {
    const T distance = y[0] + radius[0];
    g[0] = distance * y[1] - x[0];
    g[1] = y[2];
    g[2] = distance * y[3] - x[2];
    g[3] = y[1] * y[1] + y[2] * y[2] + y[3] * y[3] - 1;
  }
};

/// in = X - C, data = radius, out = gap and normal.
struct CylinderLaw {
  static constexpr int numInputs = 3, numOutputs = 4, numData = 1;
  template <class T>
  void operator()(const T* in, const Passive<T>* data, T* out) const {
    out[0] = T(1.0);
    out[1] = T(0.6);
    out[2] = T(0.0);
    out[3] = T(0.8);
    atrapos::taylor::solveImplicit<3, 4, 1>(CylinderProjection{}, in, data, out);
  }
};

/// The same in closed form.
struct CylinderClosedForm {
  static constexpr int numInputs = 3, numOutputs = 4, numData = 1;
  template <class T, class P>
  void operator()(const T* in, const P* data, T* out) const {
    using std::sqrt;
    const T distance = sqrt(in[0] * in[0] + in[2] * in[2]);
    out[0] = distance - data[0];
    out[1] = in[0] / distance;
    out[2] = 0.0 * in[1];
    out[3] = in[2] / distance;
  }
};

/// Paper (15): R (R/alpha + h) = eta (Delta - h); x = (h, Delta) with Delta passive, y = R.
struct ContactEquation {
  double alpha, eta;
  template <class T>
  void operator()(const T* x, const T* y, T* g) const {
    g[0] = y[0] * (y[0] / alpha + x[0]) - eta * (x[1] - x[0]);
  }
};

struct ContactLaw {
  static constexpr int numInputs = 1, numOutputs = 1, numData = 1;
  double alpha = 1000, eta = 0.1;
  template <class T>
  void operator()(const T* in, const Passive<T>* data, T* out) const {
    const T x[2] = {in[0], T(data[0])};
    out[0] =
        T(alpha);  // above the positive root for every gap here: Newton comes down without leaving the branch
    atrapos::taylor::solveImplicit<2, 1>(ContactEquation{alpha, eta}, x, out);
  }
};

/// The positive root, the branch with R = 0 at h = Delta.
struct ContactClosedForm {
  static constexpr int numInputs = 1, numOutputs = 1, numData = 1;
  double alpha = 1000, eta = 0.1;
  template <class T, class P>
  void operator()(const T* in, const P* data, T* out) const {
    using std::sqrt;
    const T h = in[0];
    out[0] = 0.5 * alpha * (sqrt(h * h + 4 * eta / alpha * (data[0] - h)) - h);
  }
};

/// Force on a node over the cylinder: the implicit gap and normal feed the implicit pressure, and products of
/// them.
struct ContactForce {
  static constexpr int numInputs = 3, numOutputs = 3, numData = 2;  // data = radius, initial gap
  ContactLaw contact;
  template <class T>
  void operator()(const T* in, const Passive<T>* data, T* out) const {
    T projection[4], pressure[1];
    CylinderLaw{}(in, data, projection);
    contact(projection, data + 1, pressure);
    for (int i = 0; i < 3; ++i) out[i] = pressure[0] * projection[i + 1];
  }
};

struct ContactForceClosedForm {
  static constexpr int numInputs = 3, numOutputs = 3, numData = 2;
  ContactClosedForm contact;
  template <class T, class P>
  void operator()(const T* in, const P* data, T* out) const {
    T projection[4], pressure[1];
    CylinderClosedForm{}(in, data, projection);
    contact(projection, data + 1, pressure);
    for (int i = 0; i < 3; ++i) out[i] = pressure[0] * projection[i + 1];
  }
};
