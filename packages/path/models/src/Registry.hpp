#pragma once

#include <functional>
#include <limits>

#include "JetProblem.hpp"
#include "atrapos/models/Models.hpp"

namespace atrapos::models {

/// One model. `values` are complete: defaults with what was given.
struct Entry {
  std::string name, about;
  Parameters defaults;
  std::function<std::unique_ptr<path::Problem>(const Parameters& values)> make;
  std::function<void(const Parameters& values, const path::Problem& problem, Setup& setup)> setup;
};

// One list a source file.
std::vector<Entry> folds();
std::vector<Entry> bifurcations();
std::vector<Entry> structures();

/// A count among the parameters: an integer in [least, most].
int count(const Parameters& values, const std::string& name, int least, int most);
/// A parameter that must be positive.
double positive(const Parameters& values, const std::string& name);

path::RCP<path::Vector> vector(const path::Problem& problem, const std::vector<double>& x = {});
/// The unknown number i as a monitor.
Monitor unknown(const path::Problem& problem, const std::string& name, int i);
/// Distance from a branch on which these unknowns are zero.
std::function<double(const path::State&)> zeroUnknowns(std::vector<int> which);
/// The path ends where this monitor has the value.
void stopAt(Setup& setup, const Monitor& monitor, double value);

template <class Law>
std::unique_ptr<path::Problem> problem(Law law, double internalWeight = 0) {
  return std::make_unique<JetProblem<Law>>(std::move(law), internalWeight);
}

}  // namespace atrapos::models
