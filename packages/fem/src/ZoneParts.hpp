#pragma once

#include <string>
#include <vector>

#include "LinePoints.hpp"

namespace atrapos::fem {

/// A part of a zone that is over one piece of the surface.
struct ZonePart {
  double from = 0, to = 0;
  int piece = PointPieces::any;
  Hold border = Hold::place;  ///< what holds `to` on the border to the next part, by this piece
};

/// A zone between its limits on one line.
struct ZoneLimits {
  double at[2] = {-1, 1};
  bool root[2] = {false, false};                            ///< of the gap, else the end of the line
  int preferred[2] = {PointPieces::any, PointPieces::any};  ///< pieces for limits on borders
};

/// The parts of a zone in their order: one where the surface has no pieces, one of no width where a limit on
/// a border prefers the piece beyond it. `wrong`: why there are none, the end of a sentence; empty where
/// there are.
struct ZoneParts {
  std::vector<ZonePart> parts;
  std::string wrong;
};

/// Pressure that ends with zero needs a surface that goes on smoothly as far as the zone does: no edge, no
/// crease. `nothing`: a gap that counts as zero.
ZoneParts partsOf(const LineLaws& laws, const double* c, double lambda, const ZoneLimits& limits,
                  double nothing);

}  // namespace atrapos::fem
