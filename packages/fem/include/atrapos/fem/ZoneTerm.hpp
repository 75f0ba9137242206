#pragma once

#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "atrapos/fem/EventTerm.hpp"
#include "atrapos/fem/LineSet.hpp"
#include "atrapos/fem/PointLaw.hpp"
#include "atrapos/fem/PointPieces.hpp"

namespace atrapos::fem {

/// A condition of zoneTerm as messages and lists of events show it.
struct ZoneCondition {
  int node = 0;        ///< at the end of lines or the middle of the line, or next to it
  bool opens = false;  ///< it is a maximum of the gap: active where it is out of contact
};
/// In the order of the conditions.
std::vector<ZoneCondition> zoneConditions(const LineSet& lines);

/// What acts on lines: laws that stand behind others (`stage`).
struct ZoneLaws {
  /// x, y, z (and the load factor) -> h, n (3): a gap and its gradient. Where the surface is made of pieces
  /// with their data, and behind n two coordinates in the piece, which are -1 or 1 on its borders.
  std::unique_ptr<PointLaw> projection;
  /// h -> p: positive for h < 0 and zero at h = 0, analytic.
  std::unique_ptr<PointLaw> pressure;
  /// How those data follow the places; without an update where there are none.
  PieceSearch pieces = {};
};

/// How zones begin and end.
struct ZoneOptions {
  /// Ends of lines change sides at events of the path alone; false: wherever the state says so (paths without
  /// events).
  bool events = true;
  /// A zone counts from 1e-7 of its line's length on, and from this depth on where that is less, down to 1e-8
  /// of the length: where its pressure begins to be one of the body's.
  double mostDepth = std::numeric_limits<double>::infinity();
};

/// Pressure p(h) on the zones of lines where h < 0, integrated between their limits, which move with the
/// state (docs/theory/moving_edges.md): virtual work of -p n over each zone. Conditions: for each end of a
/// line whether it is in contact, then for each line three extrema of the gap inside it. Throws
/// std::logic_error for laws of other inputs and outputs.
std::unique_ptr<EventTerm> zoneTerm(ZoneLaws laws, const LineSet& lines, ZoneOptions options = {});

}  // namespace atrapos::fem
