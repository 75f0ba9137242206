#include "atrapos/linear/Iterations.hpp"

#include "atrapos/linear/TangentSolver.hpp"

namespace atrapos::linear {

std::optional<Iterations> iterations(const TangentSolver& solver) {
  const auto* iterates = dynamic_cast<const Iterates*>(&solver);
  return iterates ? iterates->iterations() : std::nullopt;
}

}  // namespace atrapos::linear
