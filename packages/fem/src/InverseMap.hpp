#pragma once

#include <functional>
#include <vector>

#include "atrapos/fem/ReferenceCell.hpp"

namespace atrapos::fem::detail {

/// Places whose reference coordinates are looked for, all in cells of one shape: x(xi) = sum of N_a(xi) X_a.
struct PlacesInCells {
  int dim = 0;                  ///< of the reference cell, and of x
  std::vector<double> nodes;    ///< [place][a][dim] X_a of its cell
  std::vector<double> targets;  ///< [place][dim] x

  int count() const { return static_cast<int>(targets.size()) / (dim > 0 ? dim : 1); }
};

/// Reference coordinates of the places, [place][dim], by Newton's method from `start`; NaN where that finds
/// none. `tabulate`: the shape functions at reference points (tabulateAt).
std::vector<double> inverseMap(const PlacesInCells& places, const std::vector<double>& start,
                               const std::function<Tabulation(const std::vector<double>&)>& tabulate);

}  // namespace atrapos::fem::detail
