#include "TieFaces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "Labels.hpp"
#include "atrapos/fem/PointSet.hpp"

namespace atrapos::fem::detail {
namespace {

using Point = std::array<double, 2>;
using Polygon = std::vector<Point>;

/// The nodes of a face around it, counter-clockwise seen from outside.
std::vector<int> outline(const TieFace& face) {
  const int corners = numCorners(face.shape), nodes = static_cast<int>(face.nodes.size());
  std::vector<int> around;
  for (int c = 0; c < corners; ++c) {
    around.push_back(c);
    if (nodes >= 2 * corners) around.push_back(corners + c);
  }
  return around;
}

Vec3 unit(const Vec3& a) { return scaled(1 / norm(a), a); }

void setFrame(TieFace& face) {
  const int corners = numCorners(face.shape);
  for (int c = 0; c < corners; ++c) add(1.0 / corners, face.places[c], face.centre);
  Vec3 first = between(face.places[0], face.places[1]);
  Vec3 area{};
  if (face.dim() == 1) {
    area = cross(first, {0, 0, 1});
    face.size = norm(area);
  } else {
    for (int c = 0; c < corners; ++c)
      add(0.5,
          cross(between(face.centre, face.places[c]), between(face.centre, face.places[(c + 1) % corners])),
          area);
    face.size = std::sqrt(norm(area));
  }
  if (!(face.size > 0)) return;
  face.normal = unit(area);
  add(-dot(first, face.normal), face.normal, first);
  face.axes[0] = unit(first);
  face.axes[1] = cross(face.normal, face.axes[0]);
  face.low = face.high = face.places[0];
  for (const Vec3& x : face.places)
    for (int i = 0; i < 3; ++i) {
      face.low[i] = std::min(face.low[i], x[i]);
      face.high[i] = std::max(face.high[i], x[i]);
    }
}

double cross2(const Point& o, const Point& a, const Point& b) {
  return (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);
}

/// A triangle of places in the plane of a face, with its distances from it.
struct Facet {
  std::array<Point, 3> corners;
  std::array<double, 3> heights;

  double area() const { return 0.5 * cross2(corners[0], corners[1], corners[2]); }
  double heightAt(const Point& p) const {
    const double all = cross2(corners[0], corners[1], corners[2]);
    double sum = 0;
    for (int c = 0; c < 3; ++c) sum += heights[c] * cross2(corners[(c + 1) % 3], corners[(c + 2) % 3], p);
    return sum / all;
  }
};

/// A face as triangles about its centre, in the plane of another (or its own), counter-clockwise there.
std::vector<Facet> facets(const TieFace& face, const TieFace& plane) {
  const std::vector<int> around = outline(face);
  Vec3 centre{};
  for (const int n : around) add(1.0 / static_cast<double>(around.size()), face.places[n], centre);
  const auto in = [&](const Vec3& x) { return Point{plane.along(0, x), plane.along(1, x)}; };
  std::vector<Facet> all;
  for (std::size_t i = 0; i < around.size(); ++i) {
    const Vec3 &a = face.places[around[i]], &b = face.places[around[(i + 1) % around.size()]];
    Facet f{{in(centre), in(a), in(b)}, {plane.above(centre), plane.above(a), plane.above(b)}};
    if (f.area() < 0) {
      std::swap(f.corners[1], f.corners[2]);
      std::swap(f.heights[1], f.heights[2]);
    }
    if (f.area() > 0) all.push_back(f);
  }
  return all;
}

/// What two triangles have in common (Sutherland and Hodgman), a convex polygon.
Polygon common(const std::array<Point, 3>& a, const std::array<Point, 3>& b) {
  Polygon polygon(a.begin(), a.end());
  for (int e = 0; e < 3 && !polygon.empty(); ++e) {
    const Point &from = b[e], &to = b[(e + 1) % 3];
    Polygon kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Point &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
      const double atP = cross2(from, to, p), atQ = cross2(from, to, q);
      if (atP >= 0) kept.push_back(p);
      if ((atP > 0 && atQ < 0) || (atP < 0 && atQ > 0)) {
        const double s = atP / (atP - atQ);
        kept.push_back({p[0] + s * (q[0] - p[0]), p[1] + s * (q[1] - p[1])});
      }
    }
    polygon = std::move(kept);
  }
  return polygon;
}

/// Pieces below this share of the face's are rounding.
constexpr double least = 1e-10;

void addSegments(const TieFace& own, const TieFace& other, double reach, TieSegment to,
                 std::vector<TieSegment>& all) {
  for (const Facet& a : facets(own, own))
    for (const Facet& b : facets(other, own)) {
      const Polygon polygon = common(a.corners, b.corners);
      if (polygon.size() < 3) continue;
      Point middle{};
      for (const Point& p : polygon)
        for (int i = 0; i < 2; ++i) middle[i] += p[i] / static_cast<double>(polygon.size());
      to.gap = std::abs(b.heightAt(middle) - a.heightAt(middle));
      if (to.gap > reach) continue;
      for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
        to.corners = {polygon[0], polygon[i], polygon[i + 1]};
        to.size = 0.5 * cross2(polygon[0], polygon[i], polygon[i + 1]);
        if (to.size > least * own.size * own.size) all.push_back(to);
      }
    }
}

void addInterval(const TieFace& own, const TieFace& other, double reach, TieSegment to,
                 std::vector<TieSegment>& all) {
  const double s[2] = {own.along(0, own.places[0]), own.along(0, own.places[1])};
  const double t[2] = {own.along(0, other.places[0]), own.along(0, other.places[1])};
  const double gap[2] = {own.above(other.places[0]), own.above(other.places[1])};
  const double from = std::max(std::min(s[0], s[1]), std::min(t[0], t[1])),
               end = std::min(std::max(s[0], s[1]), std::max(t[0], t[1]));
  if (!(end - from > least * own.size)) return;
  const double middle = (0.5 * (from + end) - t[0]) / (t[1] - t[0]);
  to.gap = std::abs((1 - middle) * gap[0] + middle * gap[1]);
  if (to.gap > reach) return;
  to.corners = {Point{from, 0}, Point{end, 0}, Point{}};
  to.size = end - from;
  all.push_back(to);
}

}  // namespace

double TieFace::along(int axis, const Vec3& x) const { return dot(axes[axis], x) - dot(axes[axis], centre); }
double TieFace::above(const Vec3& x) const { return dot(normal, x) - dot(normal, centre); }

std::vector<TieFace> tieFaces(const Mesh& mesh, const SideSet& set) {
  std::vector<TieFace> faces;
  for (const Side& side : set.sides) {
    TieFace face;
    const auto [b, e] = addressOf(mesh, side.element);
    const Block& block = mesh.blocks[b];
    if (!isSolid(block.topology) && !isPlane(block.topology))
      throw std::invalid_argument(
          fmt::format("{} of '{}' is no solid and no plane cell, whose sides can be tied",
                      elementLabel(mesh, b, e), set.name));
    face.side = side;
    face.shape = sideFace(block.topology, side.side);
    face.block = b;
    face.element = e;
    for (const int n : sideNodes(block.topology, side.side)) {
      face.nodes.push_back(block.nodes[static_cast<std::size_t>(e) * nodesPerElement(block.topology) + n]);
      face.places.push_back(vectorAt(mesh.coordinates, face.nodes.back()));
    }
    setFrame(face);
    if (!(face.size > 0))
      throw std::invalid_argument(
          fmt::format("side {} of {} has no area", side.side + 1, elementLabel(mesh, b, e)));
    faces.push_back(std::move(face));
  }
  return faces;
}

NearFaces::NearFaces(const std::vector<TieFace>& faces) : faces_(faces), order_(faces.size()) {
  Vec3 low{}, high{};
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (int i = 0; i < 3; ++i) {
      low[i] = f == 0 ? faces[f].low[i] : std::min(low[i], faces[f].low[i]);
      high[i] = f == 0 ? faces[f].high[i] : std::max(high[i], faces[f].high[i]);
    }
  for (int i = 1; i < 3; ++i)
    if (high[i] - low[i] > high[axis_] - low[axis_]) axis_ = i;
  for (const TieFace& face : faces) {
    widest_ = std::max(widest_, face.high[axis_] - face.low[axis_]);
    largest_ = std::max(largest_, face.size);
  }
  std::iota(order_.begin(), order_.end(), 0);
  std::sort(order_.begin(), order_.end(),
            [&](int a, int b) { return faces[a].low[axis_] < faces[b].low[axis_]; });
}

std::vector<int> NearFaces::of(const Vec3& low, const Vec3& high, double size, double reach) const {
  const double most = reach * std::max(size, largest_);
  auto at = std::lower_bound(order_.begin(), order_.end(), low[axis_] - most - widest_,
                             [&](int f, double x) { return faces_[f].low[axis_] < x; });
  std::vector<int> near;
  for (; at != order_.end() && faces_[*at].low[axis_] <= high[axis_] + most; ++at) {
    const TieFace& face = faces_[*at];
    const double gap = reach * std::max(size, face.size);
    bool is = true;
    for (int i = 0; i < 3; ++i) is = is && face.low[i] <= high[i] + gap && face.high[i] >= low[i] - gap;
    if (is) near.push_back(*at);
  }
  std::sort(near.begin(), near.end());
  return near;
}

std::vector<TieSegment> tieSegments(const std::vector<TieFace>& faces, int own,
                                    const std::vector<TieFace>& others, const NearFaces& near, double reach) {
  const TieFace& face = faces[own];
  std::vector<TieSegment> all;
  for (const int o : near.of(face.low, face.high, face.size, reach)) {
    const TieFace& other = others[o];
    // Within 60 degrees of facing each other: coarse facets of a curved surface, and not the body's back.
    if (dot(face.normal, other.normal) > -0.5) continue;
    TieSegment to;
    to.own = own;
    to.other = o;
    (face.dim() == 1 ? addInterval : addSegments)(face, other, reach * std::max(face.size, other.size), to,
                                                  all);
  }
  return all;
}

}  // namespace atrapos::fem::detail
