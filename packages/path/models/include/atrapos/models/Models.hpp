#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "atrapos/path/Monitor.hpp"
#include "atrapos/path/Problem.hpp"
#include "atrapos/path/Stops.hpp"

/// Small problems with known paths (folds, bifurcations, frames), by name: for tests, failure maps and first
/// experiments with path following. One rank (MPI_COMM_SELF), dense graphs of 1 to 200 unknowns.
namespace atrapos::models {

/// Values by name; what is not given takes its default.
using Parameters = std::map<std::string, double>;

using path::Monitor;

/// Where the path of a model starts and ends, and what is worth watching.
struct Setup {
  std::string about;              ///< one line: what it shows
  path::State start;              ///< a solution to rounding
  double direction = 1;           ///< for path::Options::direction
  path::Stops stops;              ///< the end of the path worth seeing, whichever comes first
  std::vector<Monitor> monitors;  ///< at least one
  /// How far a state is from the branch that the path belongs to, in unknowns; 0 on it. Empty where the model
  /// has no other branch near, or none that is known.
  std::function<double(const path::State&)> offBranch;
};

/// All names, in alphabetical order.
std::vector<std::string> names();

/// The parameters of a model with their defaults. Throws std::invalid_argument on an unknown name.
Parameters parameters(const std::string& name);

/// The model. Throws std::invalid_argument, one line, on an unknown name or parameter and on values that make
/// no sense.
std::unique_ptr<path::Problem> make(const std::string& name, const Parameters& parameters = {});

/// Its start, end and monitors; `problem` is what `make` gave for the same name and parameters.
Setup setup(const std::string& name, const Parameters& parameters, const path::Problem& problem);

}  // namespace atrapos::models
