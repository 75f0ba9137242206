#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <type_traits>
#include <vector>

#include "atrapos/solid/Gent.hpp"
#include "atrapos/solid/MooneyRivlin.hpp"
#include "atrapos/solid/NeoHookean.hpp"
#include "atrapos/solid/Ogden.hpp"
#include "atrapos/solid/Yeoh.hpp"

/// The laws of rubber with numbers, and what docs/theory/rubber.md says of them in principal stretches, which
/// the laws themselves do not know.
namespace atrapos::solid::test {

using RubberTypes = testing::Types<NeoHookean, MooneyRivlin, Yeoh, Gent, Ogden>;

// Stresses of size one; volumes that change enough to be seen.
template <class Law>
Law rubber();
template <>
inline NeoHookean rubber() {
  return NeoHookean::fromYoung(2.1, 0.3);
}
template <>
inline MooneyRivlin rubber() {
  return MooneyRivlin::fromModuli(0.5, 0.2, 3);
}
template <>
inline Yeoh rubber() {
  return Yeoh::fromModuli(0.6, -0.05, 0.01, 4);
}
template <>
inline Gent rubber() {
  return Gent::fromModuli(1.2, 20, 1);
}

template <>
inline Ogden rubber() {
  return Ogden::fromModuli({0.9, 0.1, -0.1}, {1, 3, -1}, 3);  // powers of sqrt(C), of which there are series
}

/// Moduli at rest.
struct AtRest {
  double shear, bulk;
};
inline AtRest atRest(const NeoHookean& m) { return {m.mu, m.lambda + 2 * m.mu / 3}; }
inline AtRest atRest(const MooneyRivlin& m) { return {2 * (m.c1 + m.c2), m.bulk}; }
inline AtRest atRest(const Yeoh& m) { return {2 * m.c1, m.bulk}; }
inline AtRest atRest(const Gent& m) { return {m.mu, m.bulk}; }

inline AtRest atRest(const Ogden& m) { return {m.shearModulus(), m.bulk}; }

using Real = long double;
using Numbers = std::vector<double>;

// Values of size one to ten from some hundred operations.
constexpr double rounding = 4e-14;

template <class Law>
Numbers stress(const Law& law, const Numbers& H) {
  Numbers P(9);
  taylor::value(law, H.data(), nullptr, P.data());
  return P;
}

/// H of principal stretches.
inline Numbers diagonal(Real x, Real y, Real z) {
  return {static_cast<double>(x - 1), 0, 0, 0, static_cast<double>(y - 1), 0, 0, 0,
          static_cast<double>(z - 1)};
}

/// dW/dI_1 and dW/dI_2 of the isochoric invariants.
struct Slopes {
  Real first, second;
};
inline Slopes slopes(const MooneyRivlin& m, Real) { return {m.c1, m.c2}; }
inline Slopes slopes(const Yeoh& m, Real x) { return {m.c1 + 2 * m.c2 * x + 3 * m.c3 * x * x, 0}; }
inline Slopes slopes(const Gent& m, Real x) { return {m.mu / 2 * m.limit / (m.limit - x), 0}; }

struct Stretches {
  Real x, y, z;
};

/// Principal first Piola-Kirchhoff stress along x.
inline Real principalStress(const NeoHookean& m, const Stretches& s) {
  const Real J = s.x * s.y * s.z;
  return m.mu * (s.x - 1 / s.x) + m.lambda * std::log(J) / s.x;
}
template <class Law>
Real principalStress(const Law& m, const Stretches& s) {
  const Real J = s.x * s.y * s.z, r = std::pow(J, -Real(1) / 3);
  const Real a = std::pow(r * s.x, 2), b = std::pow(r * s.y, 2), c = std::pow(r * s.z, 2);
  const Slopes w = slopes(m, a + b + c - 3);
  // Kirchhoff stress: 2 (W_1 a_i - W_2 / a_i), its deviator, and J dU/dJ
  const auto of = [&](Real q) { return 2 * (w.first * q - w.second / q); };
  return (of(a) - (of(a) + of(b) + of(c)) / 3 + Real(m.bulk) / 2 * (J * J - 1)) / s.x;
}

inline Real principalStress(const Ogden& m, const Stretches& s) {
  const Real J = s.x * s.y * s.z, r = std::pow(J, -Real(1) / 3);
  const auto of = [&](Real stretch) {
    Real sum = 0;
    for (int i = 0; i < m.numTerms; ++i) sum += m.terms[i].mu * std::pow(r * stretch, Real(m.terms[i].alpha));
    return sum;
  };
  return (of(s.x) - (of(s.x) + of(s.y) + of(s.z)) / 3 + Real(m.bulk) / 2 * (J * J - 1)) / s.x;
}

/// Shear stress of simple shear by g.
inline Real shearStress(const NeoHookean& m, Real g) { return m.mu * g; }
template <class Law>
Real shearStress(const Law& m, Real g) {
  const Slopes w = slopes(m, g * g);
  return 2 * (w.first + w.second) * g;
}
inline Real shearStress(const Ogden& m, Real g) {  // principal stretches l, 1, 1/l with l - 1/l = g
  const Real l = (g + std::sqrt(g * g + 4)) / 2;
  Real sum = 0;
  for (int i = 0; i < m.numTerms; ++i) {
    const Real alpha = m.terms[i].alpha;
    sum += m.terms[i].mu * (std::pow(l, alpha) - std::pow(l, -alpha)) / (l + 1 / l);
  }
  return sum;
}

/// The root of an increasing function.
template <class F>
Real rootOf(const F& f, Real low, Real high) {
  for (int i = 0; i < 200; ++i) {
    const Real middle = (low + high) / 2;
    (f(middle) < 0 ? low : high) = middle;
  }
  return low;
}

/// The stretch along z (and y where `both`) that leaves no stress there.
template <class Law>
Real freeStretch(const Law& m, Real x, Real y, bool both) {
  return rootOf([&](Real z) { return principalStress(m, Stretches{z, both ? z : y, x}); }, 0.1L, 5.0L);
}

}  // namespace atrapos::solid::test
