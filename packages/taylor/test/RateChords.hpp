#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "RateLaws.hpp"
#include "atrapos/taylor/RateChord.hpp"

using atrapos::taylor::chordOrder, atrapos::taylor::Context, atrapos::taylor::Failures;

constexpr double eps = 2.2e-16;

template <class G>
using State = std::array<double, G::numStates>;
template <class G>
using Place = std::array<double, G::numInputs>;

/// A law with memory of its own; NaN there would show what is read before it is written.
template <class G, int L>
struct Chords {
  G law;
  std::vector<double> memory;
  Failures<L> failures;
  Context<L> context;

  explicit Chords(const G& g = {}) : law(g) {
    context.shape = atrapos::taylor::chordShape<G::numInputs, G::numStates, numParameters<G>>(law);
    memory.assign(context.shape.template doubles<L>(chordOrder, 0), std::nan(""));
    context.memory = memory.data();
    context.failures = &failures;
  }
  Chords(const Chords&) = delete;

  template <class V>
  bool operator()(const V* from, const V* to, const V* data, V* z, int maxSteps = 1000) const {
    return atrapos::taylor::integrateRate<G::numInputs, G::numStates, numParameters<G>>(
        law, context, from, to, data, z, maxSteps);
  }
};

/// z at the end of a chord that must be passable.
template <class G>
State<G> follow(const G& law, const Place<G>& from, const Place<G>& to, State<G> z,
                const double* data = nullptr) {
  const Chords<G, 1> chords(law);
  EXPECT_TRUE(chords(from.data(), to.data(), data, z.data()));
  return z;
}

/// n classical steps of Runge's fourth-order method along the chord.
template <class G>
State<G> runge(const G& law, const Place<G>& from, const Place<G>& to, State<G> z, int n,
               const double* data = nullptr) {
  constexpr int I = G::numInputs, S = G::numStates;
  const auto rate = [&](double a, const State<G>& at) {
    double v[I], right[S];
    State<G> dz;
    for (int j = 0; j < I; ++j) v[j] = from[j] + a * (to[j] - from[j]);
    atrapos::taylor::detail::RateMatrices<I, S, numParameters<G>> matrices;
    EXPECT_TRUE(matrices.evaluate(law, v, at.data(), data));
    for (int i = 0; i < S; ++i) {
      right[i] = 0;
      for (int j = 0; j < I; ++j) right[i] += matrices.b[i][j] * (to[j] - from[j]);
    }
    matrices.lu.solve(right, dz.data());
    return dz;
  };
  const auto plus = [](State<G> x, double h, const State<G>& dx) {
    for (int i = 0; i < S; ++i) x[i] += h * dx[i];
    return x;
  };
  const double h = 1.0 / n;
  for (int step = 0; step < n; ++step) {
    const double a = step * h;
    const State<G> k1 = rate(a, z), k2 = rate(a + h / 2, plus(z, h / 2, k1));
    const State<G> k3 = rate(a + h / 2, plus(z, h / 2, k2)), k4 = rate(a + h, plus(z, h, k3));
    for (int i = 0; i < S; ++i) z[i] += h / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
  }
  return z;
}

template <std::size_t N>
double distance(const std::array<double, N>& a, const std::array<double, N>& b) {
  double d = 0;
  for (std::size_t i = 0; i < N; ++i) d = std::max(d, std::fabs(a[i] - b[i]));
  return d;
}
