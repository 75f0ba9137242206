#pragma once

#include <complex>
#include <optional>
#include <vector>

#include "atrapos/path/Calls.hpp"

namespace atrapos::path {

struct Unstable {
  int all = 0;   ///< eigenvalues with negative real part
  int real = 0;  ///< the real ones among them
  /// All that were computed, nearest to zero first.
  std::vector<std::complex<double>> nearest{};
};

/// Eigenvalues with negative real part of K x = mu x, K the factored tangent, which need not be symmetric
/// (docs/theory/path.md, "Unsymmetric tangents"), or of K x = mu M x (docs/theory/stability.md) where `mass`
/// is given. `count` is how many of those next to zero are computed at first. Empty where they leave the
/// numbers open, or where multipliers of constraints are among the unknowns.
std::optional<Unstable> countUnstable(Calls& calls, int count,
                                      const RCP<const CrsMatrix>& mass = Teuchos::null);

}  // namespace atrapos::path
