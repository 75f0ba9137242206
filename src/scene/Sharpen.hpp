#pragma once

#include <memory>
#include <string>
#include <vector>

#include "atrapos/linear/TangentSolver.hpp"
#include "atrapos/path/PathFollower.hpp"
#include "scene/Scene.hpp"

namespace atrapos {

/// The end of a continuation towards hard contact.
struct Sharpened {
  bool reached = false;  ///< the factor was reached
  std::string text;      ///< one line
  double factor = 1;     ///< by which eta was multiplied in the end
  int steps = 0;
  std::vector<double> monitors;  ///< there
};

/// Follows the path on which eta of all contacts falls by `factor` at a load factor that stays, from a state
/// of the scene; its parameter is s = -log of the factor. Writes every step's end to `file`: factor,
/// monitors, residual. The scene sharpens then (Scene::sharpen): its own path is over.
Sharpened sharpen(Scene& scene, const path::State& state, double factor, path::Options options,
                  linear::TangentSolver& solver, const std::string& file);

}  // namespace atrapos
