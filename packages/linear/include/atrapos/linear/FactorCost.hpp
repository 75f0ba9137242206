#pragma once

#include <optional>

namespace atrapos::linear {

class TangentSolver;

/// Size of a factorization, all ranks together.
struct FactorCost {
  double entries = 0;     ///< numbers in the factors
  double bytes = 0;       ///< of the solver's arrays, work space included, while it factors and solves
  double operations = 0;  ///< floating-point operations of the elimination
};

/// What a TangentSolver is besides where it knows the cost of its factorizations.
class TellsCost {
 public:
  virtual ~TellsCost() = default;

  /// As the analysis foresees it; empty before analyze().
  virtual std::optional<FactorCost> estimate() const = 0;

  /// Of the last factorization; empty before factor().
  virtual std::optional<FactorCost> spent() const = 0;
};

/// TellsCost::estimate of a solver; empty where it does not tell.
std::optional<FactorCost> estimate(const TangentSolver& solver);

/// TellsCost::spent of a solver; empty where it does not tell.
std::optional<FactorCost> spent(const TangentSolver& solver);

}  // namespace atrapos::linear
