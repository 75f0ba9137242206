#include "TieCells.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "InverseMap.hpp"

namespace atrapos::fem::detail {
namespace {

/// Reference coordinates of a side's corners.
std::vector<Vec3> cornersOf(Topology topology, int side) {
  const std::vector<double> all = referenceNodes(topology);
  const std::vector<int> local = sideNodes(topology, side);
  const std::size_t d = all.size() / nodesPerElement(topology);
  std::vector<Vec3> corners(numCorners(sideFace(topology, side)), Vec3{});
  for (std::size_t c = 0; c < corners.size(); ++c)
    for (std::size_t i = 0; i < d; ++i) corners[c][i] = all[local[c] * d + i];
  return corners;
}

/// A face's own reference coordinates of a place in the cell: of triangles from 0 to 1 along two edges, else
/// from -1 to 1.
std::array<double, 2> onFace(const std::vector<Vec3>& corners, const Vec3& xi) {
  const bool triangle = corners.size() == 3;
  const double part = triangle ? 1 : 0.5;
  const Vec3 e = scaled(part, between(corners[0], corners[1]));
  Vec3 origin = corners[0];
  if (corners.size() == 2) {
    add(1, e, origin);
    return {dot(e, between(origin, xi)) / dot(e, e), 0};
  }
  const Vec3 f = scaled(part, between(corners[0], corners.back()));
  for (const Vec3& half : {e, f})
    if (!triangle) add(1, half, origin);
  const Vec3 away = between(origin, xi);
  const double a = dot(e, e), b = dot(e, f), c = dot(f, f), r = dot(e, away), s = dot(f, away);
  return {(c * r - b * s) / (a * c - b * b), (a * s - b * r) / (a * c - b * b)};
}

}  // namespace

std::vector<InCell> CellsBehind::find(const std::vector<std::pair<int, Vec3>>& places) const {
  const std::size_t d = mesh_.dimension;
  std::map<std::pair<Topology, int>, std::vector<std::size_t>> bySide;
  for (std::size_t p = 0; p < places.size(); ++p) {
    const TieFace& face = faces_[places[p].first];
    bySide[{mesh_.blocks[face.block].topology, face.side.side}].push_back(p);
  }
  std::vector<InCell> result(places.size());
  for (const auto& [kind, members] : bySide) {
    const Topology topology = kind.first;
    const std::size_t N = nodesPerElement(topology);
    PlacesInCells cells;
    cells.dim = mesh_.dimension;
    for (const std::size_t p : members) {
      const TieFace& face = faces_[places[p].first];
      for (std::size_t a = 0; a < N; ++a) {
        const Vec3 X = vectorAt(mesh_.coordinates, mesh_.blocks[face.block].nodes[face.element * N + a]);
        cells.nodes.insert(cells.nodes.end(), X.begin(), X.begin() + d);
      }
      cells.targets.insert(cells.targets.end(), places[p].second.begin(), places[p].second.begin() + d);
    }
    Vec3 middle{};
    const std::vector<Vec3> corners = cornersOf(topology, kind.second);
    for (const Vec3& corner : corners) add(1.0 / static_cast<double>(corners.size()), corner, middle);
    const auto tabulateHere = [topology](const std::vector<double>& at) { return tabulateAt(topology, at); };
    const auto xi = inverseMap(cells, {middle.begin(), middle.begin() + d}, tabulateHere);
    const Tabulation t = tabulateHere(xi);
    for (std::size_t m = 0; m < members.size(); ++m) {
      InCell& in = result[members[m]];
      in.values.assign(&t.values[m * N], &t.values[m * N] + N);
      in.xi.assign(&xi[m * d], &xi[m * d] + d);
    }
  }
  return result;
}

std::optional<double> CellsBehind::gapTo(const TieFace& face, const Vec3& place,
                                         const std::vector<double>& xi) const {
  if (std::isnan(xi[0])) return {};
  Vec3 inCell{};
  std::copy(xi.begin(), xi.end(), inCell.begin());
  const std::vector<Vec3> corners = cornersOf(mesh_.blocks[face.block].topology, face.side.side);
  const auto s = onFace(corners, inCell);
  // A node at the border may be a little beside it: facets of a curved one do not meet.
  constexpr double beside = 0.02;
  const bool in = corners.size() == 3 ? std::min(s[0], s[1]) > -beside && s[0] + s[1] < 1 + beside
                                      : std::max(std::abs(s[0]), std::abs(s[1])) < 1 + beside;
  if (!in) return {};
  const Tabulation t = tabulateFaceAt(face.shape, {s.begin(), s.begin() + face.dim()});
  Vec3 gap = place;
  for (int a = 0; a < t.numNodes; ++a) add(-t.values[a], face.places[a], gap);
  return norm(gap);
}

}  // namespace atrapos::fem::detail
