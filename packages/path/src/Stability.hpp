#pragma once

#include <optional>

#include "atrapos/path/Calls.hpp"

namespace atrapos::path {

struct Unstable {
  int all = 0;   ///< eigenvalues with negative real part
  int real = 0;  ///< the real ones among them
};

/// Eigenvalues with negative real part of the factored tangent, which need not be symmetric
/// (docs/theory/path.md, "Unsymmetric tangents"). `count` is how many of those next to zero are computed at
/// first. Empty where they leave the numbers open, or where multipliers of constraints are among the
/// unknowns.
std::optional<Unstable> countUnstable(Calls& calls, int count);

}  // namespace atrapos::path
