#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "atrapos/linear/Types.hpp"

namespace atrapos::path {

using linear::CrsMatrix;
using linear::Map;
using linear::RCP;
using linear::Vector;

/// What a Problem keeps of the path that led to a state, besides the unknowns. A value that does not change:
/// states share it.
struct Memory {
  std::vector<int> conditions;    ///< what events have made of the Problem; empty: nothing
  std::vector<double> variables;  ///< internal variables of this rank's points; empty: there are none
  /// The state that `variables` are those of. Null where there are none.
  RCP<const Vector> u;
  double lambda = 0;
};

/// A point of the path: the unknowns, the load parameter, and what the Problem remembers there.
///
/// Internal variables of a state away from their own (Memory::u) are those that the way there along a
/// straight line makes of them, so that everything that a Problem says of a state is a function of the state
/// alone.
struct State {
  RCP<Vector> u;
  double lambda = 0;
  std::shared_ptr<const Memory> memory = nullptr;  ///< null: as the Problem starts

  State() = default;
  State(RCP<Vector> u_, double lambda_, std::shared_ptr<const Memory> memory_ = nullptr)
      : u(std::move(u_)), lambda(lambda_), memory(std::move(memory_)) {}

  /// The same with unknowns of its own.
  State copy() const;
  /// Another state with the same memory.
  State at(RCP<Vector> otherU, double otherLambda) const { return {std::move(otherU), otherLambda, memory}; }
};

/// A change of state: unknowns, and the internal variables that the Problem condenses locally (may be empty).
struct Increment {
  RCP<Vector> u;
  std::vector<double> internal;
};

/// dX/da and dlambda/da at a point of the path.
struct PathTangent {
  Increment x;
  double lambda = 0;
};

}  // namespace atrapos::path
