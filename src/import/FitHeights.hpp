#pragma once

#include <array>
#include <string>
#include <vector>

#include "import/ReadStl.hpp"

namespace atrapos::importer {

/// A smooth surface as heights along an axis over a rectangle across it: a bicubic B-spline with two
/// continuous derivatives, and control points in space, those of the second direction running fastest.
/// S_1 x S_2 points along the axis.
struct FittedSurface {
  std::array<std::vector<double>, 2> knots;
  std::vector<std::array<double, 3>> points;

  std::size_t facets = 0;      ///< taken: those that face the axis
  std::size_t turnedAway = 0;  ///< left out: they face the other way
  double fromCorners = 0;      ///< largest distance of a facet's corner from the surface
  double fromFacets = 0;       ///< the same of the middles of facets: what facets are off a smooth surface
  double empty = 0;            ///< part of the rectangle over which no corner of a facet is near
};

struct FitWishes {
  std::array<double, 3> along{0, 0, 1};  ///< axis, a unit vector along x, y or z
  std::array<int, 2> cells{0,
                           0};  ///< pieces across it; 0: so many that each coefficient has some four corners
};

/// Fits the heights of the facets' corners by least squares. Throws Error, one line, where facets overhang
/// (two heights over one place), too many or too few cells are asked for, or nothing faces the axis.
FittedSurface fitHeights(const std::vector<Facet>& facets, const FitWishes& wishes, const std::string& file);

}  // namespace atrapos::importer
