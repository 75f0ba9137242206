#pragma once

#include <string>
#include <utility>
#include <vector>

#include <Tpetra_Vector.hpp>

#include "JetProblem.hpp"
#include "atrapos/path/PathFollower.hpp"

/// Ends of a path, and what is read there.
inline atrapos::path::Stops loads(std::vector<double> values) {
  atrapos::path::Stops stops;
  stops.loadFactors = std::move(values);
  return stops;
}

template <class Law>
atrapos::path::Stops unknown(const Law& law, int i, double value) {
  JetProblem<Law> problem(law);
  std::vector<double> weights(law.size(), 0.0);
  weights[i] = 1;
  atrapos::path::Stops stops;
  stops.functionals.push_back({"unknown", problem.vector(weights), value});
  return stops;
}

inline double at(const atrapos::path::State& state, int i) { return state.u->getData()[i]; }
