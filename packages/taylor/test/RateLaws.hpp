#pragma once

#include "atrapos/taylor/Rate.hpp"

using atrapos::taylor::Passive;

// Rate laws of the tests: g = A z' - B v'.

/// z' = z v'
struct Growth {
  static constexpr int numInputs = 1, numStates = 1;
  template <class T, class R>
  void operator()(const T*, const T* z, const R* dv, const R* dz, R* g) const {
    g[0] = dz[0] - z[0] * dv[0];
  }
};

/// z' = (1 + z^2) v': the tangent
struct TangentLaw {
  static constexpr int numInputs = 1, numStates = 1;
  template <class T, class R>
  void operator()(const T*, const T* z, const R* dv, const R* dz, R* g) const {
    g[0] = dz[0] - (1.0 + z[0] * z[0]) * dv[0];
  }
};

/// z' = M z v', M = (d -w; w d): a spiral
struct Spiral {
  static constexpr int numInputs = 1, numStates = 2;
  double d = -0.3, w = 1.7;
  template <class T, class R>
  void operator()(const T*, const T* z, const R* dv, const R* dz, R* g) const {
    g[0] = dz[0] - (d * z[0] - w * z[1]) * dv[0];
    g[1] = dz[1] - (w * z[0] + d * z[1]) * dv[0];
  }
};

/// (1 + z) z' = v'
struct ImplicitRate {
  static constexpr int numInputs = 1, numStates = 1;
  template <class T, class R>
  void operator()(const T*, const T* z, const R* dv, const R* dz, R* g) const {
    g[0] = (1.0 + z[0]) * dz[0] - dv[0];
  }
};

/// r' = r v_0', phi' = v_1' of the point z = r (cos phi, sin phi): A = (z_0 z_1; -z_1 z_0), B = r^2
struct Polar {
  static constexpr int numInputs = 2, numStates = 2;
  template <class T, class R>
  void operator()(const T*, const T* z, const R* dv, const R* dz, R* g) const {
    const T square = z[0] * z[0] + z[1] * z[1];
    g[0] = z[0] * dz[0] + z[1] * dz[1] - square * dv[0];
    g[1] = z[0] * dz[1] - z[1] * dz[0] - square * dv[1];
  }
};

/// z' = z v_0 v_1': what z is depends on the way between two places
struct Swept {
  static constexpr int numInputs = 2, numStates = 1;
  template <class T, class R>
  void operator()(const T* v, const T* z, const R* dv, const R* dz, R* g) const {
    g[0] = dz[0] - z[0] * v[0] * dv[1];
  }
};

/// sigma' = E e' - sigma t' / tau; v = (e, t)
struct Maxwell {
  static constexpr int numInputs = 2, numStates = 1;
  double modulus = 3, tau = 0.7;
  template <class T, class R>
  void operator()(const T*, const T* z, const R* dv, const R* dz, R* g) const {
    g[0] = dz[0] - modulus * dv[0] + z[0] / tau * dv[1];
  }
};

/// Endochronic plasticity of one dimension: sigma' = E (e' - sigma/strength |e'|), data = sign of e'
struct Endochronic {
  static constexpr int numInputs = 1, numStates = 1, numParameters = 1;
  double modulus = 3, strength = 0.4;
  template <class T, class R>
  void operator()(const T*, const T* z, const Passive<T>* data, const R* dv, const R* dz, R* g) const {
    g[0] = dz[0] - modulus * (1.0 - data[0] / strength * z[0]) * dv[0];
  }
};

/// Plastic flow (J2, linear hardening) while it goes on: z = deviatoric stress s (xx yy zz xy yz zx) and
/// plastic strain p, v = deviatoric strain, q = sqrt(3/2 s:s), N = 3/2 s/q: s' = 2 G (e' - N p'), 2 G N:e' =
/// (3 G + h) p', so that q - h p stays
struct PlasticFlow {
  static constexpr int numInputs = 6, numStates = 7;
  double shear = 2, hardening = 0.5;
  template <class T>
  T stress(const T* s) const {
    using std::sqrt;
    const T square = s[0] * s[0] + s[1] * s[1] + s[2] * s[2] + 2 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]);
    return sqrt(1.5 * square);
  }
  template <class T, class R>
  void operator()(const T*, const T* z, const R* dv, const R* dz, R* g) const {
    const T factor = 1.5 / stress(z);
    R along;
    for (int i = 0; i < 6; ++i) {
      const T normal = factor * z[i];
      g[i] = dz[i] - 2 * shear * (dv[i] - normal * dz[6]);
      along += (i < 3 ? 1 : 2) * (normal * dv[i]);
    }
    g[6] = 2 * shear * along - (3 * shear + hardening) * dz[6];
  }
};

namespace detail {
template <class G, class = void>
struct NumParameters : std::integral_constant<int, 0> {};
template <class G>
struct NumParameters<G, std::void_t<decltype(G::numParameters)>>
    : std::integral_constant<int, G::numParameters> {};
}  // namespace detail

template <class G>
constexpr int numParameters = detail::NumParameters<G>::value;

/// A law that gives the internal variables themselves; data: their values at order 0, then the rate law's.
template <class G>
struct StateLaw {
  static constexpr int numInputs = G::numInputs, numOutputs = G::numStates,
                       numData = G::numStates + numParameters<G>;
  G rate = {};
  template <class T>
  void operator()(const T* in, const Passive<T>* data, T* out) const {
    using atrapos::taylor::solveRate;
    for (int j = 0; j < numOutputs; ++j) out[j] = T(data[j]);
    if constexpr (numParameters < G >> 0)
      solveRate<numInputs, numOutputs, numParameters<G>>(rate, in, data + numOutputs, out);
    else
      solveRate<numInputs, numOutputs>(rate, in, out);
  }
};
