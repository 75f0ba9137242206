#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ZoneParts.hpp"
#include "ZoneSearch.hpp"

namespace atrapos::fem {

constexpr int kSlots = 3;  ///< extrema of a line that events know: two minima, a maximum

/// A zone of a line, or a part of one that is over one piece of the tool.
struct Zone {
  int line = 0;
  double limits[2] = {-1, 1};
  Hold hold[2] = {Hold::place, Hold::place};
  double widthUnit = 0;         ///< of its width among the internal variables; 0: it is none
  double deepest[2] = {-1, 0};  ///< xi of the least gap, and that gap
  int piece = PointPieces::any;
  int limitPiece[2] = {PointPieces::any, PointPieces::any};
  int nth = 0;        ///< of the zones of its line
  std::string wrong;  ///< why it has no pressure that ends with zero; empty where it has one
};

/// The extrema that events know: the two deepest minima, the highest maximum.
struct Slots {
  const Extremum* of[kSlots] = {nullptr, nullptr, nullptr};
};
Slots slotsOf(const GapShape& shape);

/// The conditions of one line, and what they make of the gap along it.
struct ZoneLine {
  static constexpr double kLineWidth = 2;  ///< in xi

  int number = 0;
  /// The depth from which on a zone counts that does not reach an end of its line: well above the rounding of
  /// coordinates, of which a gap is a difference.
  double least = 0;
  /// Next to zero the condition says on which side an end is: gaps there are as good as event functions are.
  /// The zone that lies wrong has a depth below it.
  double border = 0;
  bool events = true;        ///< conditions count
  bool on[2 + kSlots] = {};  ///< [end or extremum] in contact; of the maximum: out of it

  /// The depth at which a zone that counts ceases to, or another begins to. Less for the first: a zone begins
  /// with a force, which may push the body back.
  double changesAt(bool counting) const { return counting ? 0.5 * least : least; }
  bool isIn(int end, double gap) const;
  /// The end (0, 1) of the line that a minimum cannot be told from, as far as a birth is concerned; -1: none.
  /// Far from the tool each is told by itself, for until it gets there the minimum may have left the end.
  int endAt(const Extremum& x, const GapShape& shape) const;
  /// The deepest place at an end that a minimum cannot be told from: the end, or that minimum where it lies
  /// inside the line, for a zone that has begun at the end may leave it while it lasts. There, as at a
  /// minimum, a zone has no series at the gap zero, and the end's condition is that of the minimum too.
  std::optional<Extremum> bottomAt(int end, const GapShape& shape) const;
  /// Whether a minimum is in contact, or a maximum is out of it.
  bool counts(const Extremum& x, const Slots& slots, const GapShape& shape) const;

  /// Its zones, whatever pieces they are over; c: [coefficient].
  std::vector<Zone> zones(const LineLaws& laws, const double* c, double lambda, const GapShape& shape) const;
  /// A zone cut where it passes from piece to piece of the tool: within a part the gap is analytic.
  /// preferred: pieces for its limits.
  std::vector<Zone> parts(const Zone& zone, const int* preferred, const LineLaws& laws, const double* c,
                          double lambda) const;

 private:
  double widthUnit(const Zone& zone, const GapShape& shape) const;
};

}  // namespace atrapos::fem
