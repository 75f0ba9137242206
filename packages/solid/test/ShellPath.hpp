#pragma once

#include <string>
#include <vector>

#include "ShellModel.hpp"
#include "atrapos/path/PathFollower.hpp"

namespace atrapos::solid::test {

/// A path followed with default settings, and some of its displacements.
struct ShellPath {
  path::Outcome outcome;
  std::vector<path::LimitPoint> limitPoints;
  std::vector<path::Series> series;  ///< of every step
  std::vector<double> lengths;       ///< of every step
  std::vector<double> limitValues;   ///< first observed displacement at each limit point
};

ShellPath followPath(fem::FeProblem& problem, const path::Stops& stops, int observedDof = 0);

/// A point of the path: load factor and displacements at some dofs.
struct PathPoint {
  double lambda = 0;
  std::vector<double> u;
};

/// The state where the path first reaches a load factor; throws std::runtime_error where it does not.
PathPoint atLoad(const ShellPath& path, double lambda, const std::vector<int>& dofs);

/// `perStep` points of every step, equally spaced.
std::vector<PathPoint> sampled(const ShellPath& path, int perStep, const std::vector<int>& dofs);

/// Rows of a CSV file in the shell tests' data folder, or of one with a full path; lines that do not start
/// with a number are left out, cells that are none are NaN.
std::vector<std::vector<double>> table(const std::string& file);

/// Stop at a displacement of one dof.
path::StopFunctional stopAt(const fem::FeProblem& problem, int dof, double value);

}  // namespace atrapos::solid::test
