#include "ZoneParts.hpp"

#include <algorithm>
#include <cmath>

#include "OneLine.hpp"

namespace atrapos::fem {
namespace {

const char* const kEdge = "its zone of contact reaches an edge of the tool's patches";
const char* const kCrease = "its zone of contact crosses patches of the tool that meet at an angle";

/// Whether a place on the border of two pieces is on a crease of the surface. Unit normals of surfaces that
/// modellers call smooth differ by less than this, those of a crease by more.
bool isCrease(const OneLine& line, double below, double above, int one, int other) {
  constexpr double smooth = 5e-3;
  const auto a = line(below, one).normal, b = line(above, other).normal;
  double turn = 0;
  for (int k = 0; k < 3; ++k) turn = std::max(turn, std::abs(a[k] - b[k]));
  return turn > smooth;
}

/// Limits on a border or an edge are on either side of it by rounding: this part of the zone further in they
/// are not.
constexpr double kInside = 1e-9;

/// By pieces where places are, borders by halving down to rounding.
ZoneParts partsBetween(const OneLine& line, double from, double to) {
  // A line that runs along a border is over either of its sides by rounding: no next border so near.
  constexpr double apart = 1e-3;
  constexpr int places = 16, halvings = 45;
  ZoneParts zone;
  const double first = from + kInside * (to - from), last = to - kInside * (to - from);
  double begin = from, low = first;
  int own = line.pieceAt(low);
  if (own < 0) return {{}, kEdge};
  for (int i = 1; i <= places; ++i) {
    const double next = first + (last - first) * i / places;
    const int atNext = line.pieceAt(next);
    while (own != atNext) {
      double high = next;
      int beyond = atNext;
      for (int n = 0; n < halvings; ++n) {
        const double middle = 0.5 * (low + high);
        const int piece = line.pieceAt(middle);
        (piece == own ? low : high) = middle;
        if (piece != own) beyond = piece;
      }
      if (own < 0 || beyond < 0) return {{}, kEdge};
      if (isCrease(line, low, high, own, beyond)) return {{}, kCrease};
      zone.parts.push_back({begin, high, own, line.borderOf(own, low)});
      begin = high;
      low = std::min(next, high + apart * (to - from));
      own = line.pieceAt(low);
    }
    low = next;
  }
  zone.parts.push_back({begin, to, own, Hold::place});
  return zone;
}

/// The limit is over the piece that it prefers, where it is on its border.
void prefer(const OneLine& line, int limit, int piece, ZoneParts& zone) {
  auto& parts = zone.parts;
  const std::size_t own = limit == 0 ? 0 : parts.size() - 1;
  const double at = limit == 0 ? parts[own].from : parts[own].to;
  if (piece == -1) zone.wrong = kEdge;
  if (piece < 0 || parts[own].piece == piece || line.pieceAt(at, piece) != piece) return;
  constexpr double tiny = 1e-6;
  const double whole = parts.back().to - parts.front().from;
  const std::size_t next = limit == 0 ? own + 1 : own - 1;
  if (parts.size() > 1 && parts[next].piece == piece && parts[own].to - parts[own].from < tiny * whole) {
    (limit == 0 ? parts[next].from : parts[next].to) = at;
    parts.erase(parts.begin() + own);
    return;
  }
  if (isCrease(line, at, at, parts[own].piece, piece)) zone.wrong = kCrease;
  const ZonePart nothing{at, at, piece, line.borderOf(piece, at)};
  if (limit == 1) parts[own].border = line.borderOf(parts[own].piece, at);
  parts.insert(limit == 0 ? parts.begin() : parts.end(), nothing);
}

}  // namespace

ZoneParts partsOf(const LineLaws& laws, const double* c, double lambda, const ZoneLimits& limits,
                  double nothing) {
  if (!laws.hasPieces()) return {{{limits.at[0], limits.at[1], PointPieces::any, Hold::place}}, {}};
  const OneLine line(laws, c, lambda);
  // Over an edge the gap changes from this side to infinity.
  for (int r = 0; r < 2; ++r) {
    const double inside = limits.at[r] + kInside * (limits.at[1 - r] - limits.at[r]);
    if (limits.root[r] && !(std::abs(line.gapAndSlope(inside).first) < nothing)) return {{}, kEdge};
  }
  ZoneParts zone = partsBetween(line, limits.at[0], limits.at[1]);
  for (int r = 0; r < 2 && zone.wrong.empty(); ++r) prefer(line, r, limits.preferred[r], zone);
  return zone;
}

}  // namespace atrapos::fem
