#include "atrapos/linear/FactorCost.hpp"

#include "atrapos/linear/TangentSolver.hpp"

namespace atrapos::linear {

std::optional<FactorCost> estimate(const TangentSolver& solver) {
  const auto* tells = dynamic_cast<const TellsCost*>(&solver);
  return tells ? tells->estimate() : std::nullopt;
}

std::optional<FactorCost> spent(const TangentSolver& solver) {
  const auto* tells = dynamic_cast<const TellsCost*>(&solver);
  return tells ? tells->spent() : std::nullopt;
}

}  // namespace atrapos::linear
