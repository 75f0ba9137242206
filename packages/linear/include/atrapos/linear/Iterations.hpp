#pragma once

#include <optional>

namespace atrapos::linear {

class TangentSolver;

/// What iterative solves have cost, since construction.
struct Iterations {
  long long solves = 0;  ///< right-hand sides
  long long total = 0;   ///< iterations of all; each applies K and the preconditioner once
  long long most = 0;    ///< of one solve
};

/// What a TangentSolver is besides where it iterates.
class Iterates {
 public:
  virtual ~Iterates() = default;
  /// Empty where the solver at work is a direct one.
  virtual std::optional<Iterations> iterations() const = 0;
};

/// Iterates::iterations of a solver; empty where it does not iterate.
std::optional<Iterations> iterations(const TangentSolver& solver);

}  // namespace atrapos::linear
