#pragma once

#include <string>

namespace atrapos::fem {

/// Equal elements at one end of an axis of a generated mesh, from which the others grow, each by the same
/// factor, up to the other end: for contacts and layers.
struct FineEnd {
  int divisions = 0;   ///< number of the equal ones, below that of the axis; 0: all of the axis are equal
  double length = 0;   ///< that they share, from the end on
  bool atMax = false;  ///< the end with the largest coordinate
};

/// The factor, at least 1, by which elements grow along an axis of this length and so many elements. Throws
/// std::invalid_argument, one line, where the length is not within the axis, no element is left beside, or
/// those would be smaller than the equal ones.
double growth(const FineEnd& fine, double length, int divisions);

}  // namespace atrapos::fem
