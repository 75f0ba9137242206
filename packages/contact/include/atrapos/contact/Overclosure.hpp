#pragma once

#include <cmath>
#include <stdexcept>

#include "atrapos/contact/Requirements.hpp"

namespace atrapos::contact {

/// Pressure with an edge, p = alpha (-h)^m for h < 0 and 0 beyond: the law of contact that is integrated up
/// to its edge (docs/theory/moving_edges.md).
struct Overclosure {
  double stiffness = 1;  ///< alpha > 0: pressure per length^m
  int exponent = 1;      ///< m, 1 to 8

  /// Where the pressure is this.
  double depthOf(double pressure) const { return std::pow(pressure / stiffness, 1.0 / exponent); }

  void validate() const {
    detail::requirePositive("overclosure", "stiffness", stiffness);
    if (exponent < 1 || exponent > 8) throw std::invalid_argument("overclosure: exponent must be 1 to 8");
  }
};

}  // namespace atrapos::contact
