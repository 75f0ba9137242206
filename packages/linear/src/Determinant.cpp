#include "atrapos/linear/Determinant.hpp"

#include "atrapos/linear/TangentSolver.hpp"

namespace atrapos::linear {

std::optional<int> determinantSign(const TangentSolver& solver) {
  const auto* tells = dynamic_cast<const TellsDeterminant*>(&solver);
  return tells ? tells->determinantSign() : std::nullopt;
}

}  // namespace atrapos::linear
