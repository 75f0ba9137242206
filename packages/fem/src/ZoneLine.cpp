#include "ZoneLine.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace atrapos::fem {

Slots slotsOf(const GapShape& shape) {
  Slots slots;
  for (const Extremum& x : shape.extrema) {
    if (!x.least) {
      if (!slots.of[2] || x.gap > slots.of[2]->gap) slots.of[2] = &x;
    } else if (!slots.of[0] || x.gap < slots.of[0]->gap) {
      slots.of[1] = std::exchange(slots.of[0], &x);
    } else if (!slots.of[1] || x.gap < slots.of[1]->gap) {
      slots.of[1] = &x;
    }
  }
  return slots;
}

bool ZoneLine::isIn(int end, double gap) const {
  if (events && std::abs(gap) <= border) return on[end];
  return gap < 0;
}

int ZoneLine::endAt(const Extremum& x, const GapShape& shape) const {
  if (x.gap > border) return -1;
  for (int end = 0; end < 2; ++end)
    if (x.least && std::abs(x.xi - (end == 0 ? -1 : 1)) < kBeyondEnds &&
        std::abs(shape.ends[end] - x.gap) <= 2 * least)
      return end;
  return -1;
}

std::optional<Extremum> ZoneLine::bottomAt(int end, const GapShape& shape) const {
  std::optional<Extremum> deepest;
  for (const Extremum& x : shape.extrema) {
    if (endAt(x, shape) != end) continue;
    if (!deepest) deepest = Extremum{end == 0 ? -1.0 : 1.0, shape.ends[end]};
    if (std::abs(x.xi) < 1 && x.gap < deepest->gap) deepest = x;
  }
  return deepest;
}

bool ZoneLine::counts(const Extremum& x, const Slots& slots, const GapShape& shape) const {
  const double depth = x.least ? -x.gap : x.gap;
  if (depth >= 4 * least) return true;
  if (depth < 0.25 * least) return false;
  const int end = endAt(x, shape);
  if (events && end >= 0) return on[end];
  for (int s = 0; events && s < kSlots; ++s)
    if (slots.of[s] == &x) return on[2 + s];
  return depth >= least;
}

/// What the width of a zone is measured by: the width itself between two roots, or from a bottom to a root;
/// the line where another limit moves; 0 where none does. At a bottom that a limit has just come past the
/// width is next to nothing and grows to that of a zone that counts, whatever it was: that is the least.
double ZoneLine::widthUnit(const Zone& zone, const GapShape& shape) const {
  const bool from = zone.hold[0] == Hold::root, to = zone.hold[1] == Hold::root;
  if (!from && !to) return 0;
  const double width = zone.limits[1] - zone.limits[0];
  if (from && to) return width;
  const int end = from ? 1 : 0;
  for (const Extremum& x : shape.extrema)
    if (endAt(x, shape) == end) {
      const double rise = shape.ends[1 - end] - x.gap;
      return std::max(width, rise > least ? kLineWidth * std::sqrt(least / rise) : 0.0);
    }
  return kLineWidth;
}

/// Between neighbours of which one is in contact and one is not lies one limit.
std::vector<Zone> ZoneLine::zones(const LineLaws& laws, const double* c, double lambda,
                                  const GapShape& shape) const {
  struct Stop {
    double xi, gap;
    bool in, end;
  };
  const Slots slots = slotsOf(shape);
  std::vector<Stop> stops{{-1, shape.ends[0], isIn(0, shape.ends[0]), true}};
  for (const Extremum& x : shape.extrema)
    if (std::abs(x.xi) < 1 && counts(x, slots, shape)) stops.push_back({x.xi, x.gap, x.least, false});
  stops.push_back({1, shape.ends[1], isIn(1, shape.ends[1]), true});
  const auto limit = [&](const Stop& a, const Stop& b) -> std::optional<double> {
    if ((a.gap < 0) != (b.gap < 0)) return rootBetween(laws, c, lambda, a.xi, b.xi);
    // An end that is on the other side by its condition: the limit lies there, or just beyond.
    const Stop& end = !a.end ? b : !b.end ? a : std::abs(a.gap) < std::abs(b.gap) ? a : b;
    return rootNear(laws, c, lambda, end.xi, 0.5);
  };
  std::vector<Zone> found;
  Zone zone;
  const auto begin = [&](const Stop& first) {
    zone = {};
    zone.line = number;
    zone.nth = static_cast<int>(found.size());
    zone.deepest[0] = first.xi;
    zone.deepest[1] = first.gap;
  };
  begin(stops[0]);
  bool open = stops[0].in;
  const auto close = [&] {
    zone.widthUnit = widthUnit(zone, shape);
    found.push_back(zone);
    open = false;
  };
  for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
    if (stops[i].in && stops[i + 1].in && stops[i + 1].gap < zone.deepest[1]) {
      zone.deepest[0] = stops[i + 1].xi;
      zone.deepest[1] = stops[i + 1].gap;
    }
    if (stops[i].in == stops[i + 1].in) continue;
    const auto at = limit(stops[i], stops[i + 1]);
    if (stops[i + 1].in) {
      open = at.has_value();
      if (!open) continue;
      begin(stops[i + 1]);
      zone.limits[0] = *at;
      zone.hold[0] = Hold::root;
    } else if (open && at) {
      zone.limits[1] = *at;
      zone.hold[1] = Hold::root;
      close();
    } else {
      open = false;
    }
  }
  if (open) close();
  return found;
}

std::vector<Zone> ZoneLine::parts(const Zone& zone, const int* preferred, const LineLaws& laws,
                                  const double* c, double lambda) const {
  ZoneLimits limits;
  for (int r = 0; r < 2; ++r) {
    limits.at[r] = zone.limits[r];
    limits.root[r] = zone.hold[r] == Hold::root;
    limits.preferred[r] = preferred[r];
  }
  const ZoneParts found = partsOf(laws, c, lambda, limits, least);
  Zone part = zone;
  part.wrong = found.wrong;
  if (!part.wrong.empty()) return {part};
  std::vector<Zone> all;
  // Where pieces bend differently widths turn round: in units of the zone they would outweigh the load.
  if (found.parts.size() > 1 && zone.widthUnit > 0) part.widthUnit = kLineWidth;
  for (std::size_t i = 0; i < found.parts.size(); ++i) {
    const bool first = i == 0, last = i + 1 == found.parts.size();
    const ZonePart& own = found.parts[i];
    part.piece = own.piece;
    part.limits[0] = own.from;
    part.limits[1] = own.to;
    part.hold[0] = first ? zone.hold[0] : found.parts[i - 1].border;
    part.hold[1] = last ? zone.hold[1] : own.border;
    part.limitPiece[0] = first ? own.piece : found.parts[i - 1].piece;
    part.limitPiece[1] = own.piece;
    all.push_back(part);
  }
  return all;
}

}  // namespace atrapos::fem
