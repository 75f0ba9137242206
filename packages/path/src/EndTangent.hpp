#pragma once

#include <complex>
#include <optional>
#include <vector>

#include "Modes.hpp"

namespace atrapos::path {

/// What the tangent at an end of a step tells.
struct EndTangent {
  std::optional<linear::Inertia> inertia;
  bool uncounted = false;   ///< the inertia is asked for, and is not known
  double lambda1 = 0;       ///< load part of the unit tangent
  std::vector<Mode> modes;  ///< eigenvalues next to zero that are followed
  // Of an unsymmetric tangent:
  std::optional<int> determinant;              ///< its sign
  int real = 0;                                ///< negative eigenvalues that are real
  std::vector<std::complex<double>> spectrum;  ///< next to zero, where Hopf points are looked for

  /// A number of negative eigenvalues that is right, or right but for an even one. Empty: not known.
  std::optional<long long> parity() const {
    if (inertia) return inertia->null > 0 ? std::nullopt : std::make_optional(inertia->negative);
    return determinant ? std::make_optional<long long>(*determinant < 0) : std::nullopt;
  }
};

}  // namespace atrapos::path
