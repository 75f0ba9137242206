#pragma once

#include <vector>

#include "atrapos/fem/FineEnd.hpp"

namespace atrapos::fem {

/// Where the nodes of an axis are that has a fine end, or equal elements.
class FineAxis {
 public:
  /// Throws as growth does.
  FineAxis(const FineEnd& fine, double length, int divisions);

  /// Of a lattice coordinate in [0, 1], the part of the length: corners of cells where they belong, nodes
  /// between them halfway.
  double at(double s) const;

 private:
  std::vector<double> corners_;  ///< parts of the length; none: equal elements
};

}  // namespace atrapos::fem
