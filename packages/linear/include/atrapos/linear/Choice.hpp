#pragma once

#include <string>

namespace atrapos::linear {

class TangentSolver;

/// What a TangentSolver is besides where it picks another one for the work.
class Chooses {
 public:
  virtual ~Chooses() = default;

  /// What was picked and why, one line; empty before analyze().
  virtual std::string choice() const = 0;
};

/// Chooses::choice of a solver; empty where it does not choose.
std::string choice(const TangentSolver& solver);

}  // namespace atrapos::linear
