#include "scene/Revolution.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "scene/Extents.hpp"

namespace atrapos {
namespace {

/// A node seen from an axis.
struct Place {
  double angle;
  std::array<double, 3> u;  ///< along the radius, the axis, the circle
};

/// The nodes of a circle around the axis, each by its angle.
using Circle = std::vector<Place>;

/// Circles by radius and height in units of 1e-5 of the mesh's size, far above rounding and below cells;
/// without those at the axis.
std::map<std::pair<long, long>, Circle> circlesAround(int axis, const fem::Mesh& mesh,
                                                      const fem::DofMap& dofs, const std::vector<double>& u) {
  const double unit = 1e-5 * longestSide(mesh);
  const int field = dofs.find(fem::displacementField().name), a = (axis + 1) % 3, b = (axis + 2) % 3;
  std::map<std::pair<long, long>, Circle> circles;
  for (int n = 0; n < mesh.numNodes(); ++n) {
    const double* x = &mesh.coordinates[3 * static_cast<std::size_t>(n)];
    const double radius = std::hypot(x[a], x[b]);
    if (radius < 100 * unit) continue;
    std::array<double, 3> v{};
    for (int i = 0; i < 3; ++i)
      if (const int dof = dofs.dof(field, n, i); dof >= 0) v[i] = u[dof];
    const double cosine = x[a] / radius, sine = x[b] / radius;
    circles[{std::lround(radius / unit), std::lround(x[axis] / unit)}].push_back(
        {std::atan2(x[b], x[a]), {v[a] * cosine + v[b] * sine, v[axis], v[b] * cosine - v[a] * sine}});
  }
  for (auto& [place, circle] : circles)
    std::sort(circle.begin(), circle.end(), [](const Place& p, const Place& q) { return p.angle < q.angle; });
  return circles;
}

/// Where the nodes of a circle begin behind its widest gap, and how far they reach; all around: 0 and a full
/// turn.
std::pair<double, double> reachOf(const Circle& circle) {
  const double turn = 2 * std::acos(-1.0);
  const std::size_t count = circle.size();
  std::size_t first = 0;
  double widest = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double gap = circle[(i + 1) % count].angle - circle[i].angle + (i + 1 == count ? turn : 0);
    if (gap > widest + 1e-9) {
      widest = gap;
      first = (i + 1) % count;
    }
  }
  // A sector has fewer than eight nodes or misses more than its cells are wide.
  if (count >= 8 && widest < 1.5 * turn / static_cast<double>(count)) return {0, turn};
  return {circle[first].angle, turn - widest};
}

bool movesAlike(const Circle& circle, double tolerance) {
  for (const Place& place : circle) {
    if (std::abs(place.u[2]) > tolerance) return false;
    for (int i = 0; i < 2; ++i)
      if (std::abs(place.u[i] - circle.front().u[i]) > tolerance) return false;
  }
  return true;
}

}  // namespace

std::optional<int> axisOfRevolution(const fem::Mesh& mesh, const fem::DofMap& dofs,
                                    const std::vector<double>& u) {
  if (mesh.dimension != 3 || dofs.find(fem::displacementField().name) < 0) return {};
  constexpr double same = 1e-3;  // of angles: far above rounding, far below cells
  for (int axis = 0; axis < 3; ++axis) {
    const auto circles = circlesAround(axis, mesh, dofs, u);
    if (circles.empty()) continue;
    double largest = 0;
    for (const auto& [place, circle] : circles)
      for (const Place& node : circle)
        largest = std::max(largest, std::hypot(node.u[0], node.u[1], node.u[2]));
    const auto [begin, reach] = reachOf(circles.begin()->second);
    const bool around = std::all_of(circles.begin(), circles.end(), [&](const auto& entry) {
      const Circle& circle = entry.second;
      if (circle.size() < 3) return false;
      const auto own = reachOf(circle);
      return std::abs(own.first - begin) < same && std::abs(own.second - reach) < same &&
             movesAlike(circle, 0.01 * largest);
    });
    if (around && largest > 0) return axis;
  }
  return {};
}

}  // namespace atrapos
