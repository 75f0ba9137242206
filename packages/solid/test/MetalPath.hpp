#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "atrapos/fem/FeProblem.hpp"
#include "atrapos/fem/PointLaw.hpp"
#include "atrapos/fem/PointSet.hpp"
#include "atrapos/linear/MakeTangentSolver.hpp"
#include "atrapos/path/PathFollower.hpp"
#include "atrapos/solid/Metal.hpp"
#include "support/Steps.hpp"

/// What tests of metals share.
namespace atrapos::solid::test {

inline constexpr double E = 200e3, nu = 0.3, yield = 250;

inline Metal metal(double modulus, double saturation, double exponent, double kinematic, double recall) {
  Metal m;
  m.yieldStress = yield;
  m.modulus = modulus;
  m.saturation = saturation;
  m.exponent = exponent;
  m.kinematicModulus = kinematic;
  m.recall = recall;
  return metalFromYoung(E, nu, m);
}

/// The same with a smoothed yield surface.
inline Metal smoothed(Metal m, double width) {
  m.width = width;
  return m;
}

/// The start of every point: free, without plastic strain.
inline std::vector<double> virgin(const fem::PointSet& points, const fem::PointLaw& law) {
  return std::vector<double>(static_cast<std::size_t>(points.numPoints()) * law.shape().data, 0.0);
}

using fem::test::Steps;

struct Followed {
  Steps steps;
  path::Outcome outcome;
  Followed(fem::FeProblem& problem, const path::State& start, double loadFactor, double direction = 1) {
    path::Options options;
    options.delta = options.residualBound = 1e-9;
    options.direction = direction;
    path::Stops stops;
    stops.loadFactors = {loadFactor};
    const auto solver = linear::makeTangentSolver();
    outcome = path::PathFollower(problem, *solver, options, stops).run(start, steps);
  }
};

/// Stress and strain of a bar in tension and compression, with the sense of the last plastic strain;
/// Armstrong and Frederick's backstress in closed form: a' = C p' - b a gamma' for a = 3/2 X_xx.
struct Uniaxial {
  Metal m;
  double gamma = 0, plastic = 0, back = 0;  // at the last change of sense
  /// Of gamma from there on in this sense.
  double backAt(double g, double sense) const {
    if (m.recall == 0) return back + sense * m.kinematicModulus * (g - gamma);
    const double end = sense * m.kinematicModulus / m.recall;
    return end + (back - end) * std::exp(-m.recall * (g - gamma));
  }
  double stress(double g, double sense) const { return sense * m.strength(g) + backAt(g, sense); }
  double strain(double g, double sense) const { return stress(g, sense) / E + plastic + sense * (g - gamma); }
  /// Goes on in the other sense, after the first way out to this gamma.
  void turnBack(double g) {
    back = backAt(g, 1);
    plastic = gamma = g;
  }
};

/// Strain and shown stress of bars stretched by 1 + lambda are the closed form's, where they yield in this
/// sense; also(state, S, step) looks at more there.
template <class Also>
void expectBar(const fem::FeProblem& problem, const Steps& steps, const Uniaxial& exact, double sense,
               const Also& also) {
  int yielding = 0;
  for (std::size_t s = 0; s < steps.reports.size(); ++s)
    for (int i = 1; i <= 4; ++i) {
      const path::State state = steps.series[s].state(steps.reports[s].length * i / 4);
      const auto shown = problem.observe(0, state);
      const double gamma = shown.values.at(6);
      if (gamma == exact.gamma) continue;
      ++yielding;
      // Series of an accuracy of 1e-9 of forces; a dozen of steps.
      const double strain = state.lambda + 0.5 * state.lambda * state.lambda;
      EXPECT_NEAR(strain, exact.strain(gamma, sense), 1e-7 * yield / E) << "step " << s;
      // sigma = F S F^T/J, (1 + 2 E) of which across is what the closed form's lateral strain says.
      const double S = exact.stress(gamma, sense), across = -nu * S / E - 0.5 * (strain - S / E);
      EXPECT_NEAR(shown.values.at(0), S * (1 + state.lambda) / (1 + 2 * across), 1e-6 * yield)
          << "step " << s;
      also(state, S, s);
    }
  EXPECT_GE(yielding, 4);
}

}  // namespace atrapos::solid::test
