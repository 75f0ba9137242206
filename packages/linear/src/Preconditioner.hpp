#pragma once

#include <optional>
#include <string>

#include "atrapos/linear/FactorCost.hpp"
#include "atrapos/linear/Types.hpp"

namespace atrapos::linear {

/// An approximate inverse of K, made once per K. All calls are collective and throw SolverError on all ranks.
class Preconditioner {
 public:
  virtual ~Preconditioner() = default;

  /// Once per graph.
  virtual void analyze(const RCP<const CrsMatrix>& K) = 0;

  /// Once per K, which has the graph last analysed; keeps no reference to K's values.
  virtual void factor(const RCP<const CrsMatrix>& K) = 0;

  /// y = M^-1 x, or M^-T x; one column, x and y are different objects.
  virtual void apply(const Vector& x, Vector& y, bool transposed) const = 0;

  virtual std::string name() const = 0;

  virtual std::optional<FactorCost> estimate() const = 0;
  virtual std::optional<FactorCost> spent() const = 0;
};

}  // namespace atrapos::linear
