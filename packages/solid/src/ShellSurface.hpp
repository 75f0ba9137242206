#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "atrapos/fem/ReferenceCell.hpp"
#include "atrapos/solid/ShellPoints.hpp"

/// Geometry of shell elements at their cubature points, for set-up and results.
namespace atrapos::solid::detail {

using Vec3 = std::array<double, 3>;

inline Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline double dot(const Vec3& a, const Vec3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

inline Vec3 unit(const Vec3& a) {
  const double size = std::sqrt(dot(a, a));
  return {a[0] / size, a[1] / size, a[2] / size};
}

/// The surface of an element of 8, 6, 4 or 3 nodes.
fem::Face faceOf(int nodes);

/// The shape functions of all nodes at a point, and the derivatives of one's by xi and eta.
inline const double* valuesAt(const fem::Tabulation& t, int point) {
  return &t.values[static_cast<std::size_t>(point) * t.numNodes];
}
inline const double* gradientAt(const fem::Tabulation& t, int point, int node) {
  return &t.gradients[2 * (static_cast<std::size_t>(point) * t.numNodes + node)];
}

struct GaussRule {
  std::vector<double> x, w;
};

/// 2 to 10 Gauss points of [-1, 1], ascending; throws std::invalid_argument for another number.
GaussRule gaussRule(int points);

/// The points of a cubature in the plane, xi fastest, with the shape functions there. Triangles have three,
/// each nearest to a corner, in the order of these.
struct PlanePoints {
  std::vector<double> xi, weights;  ///< [point][2], [point]
  fem::Tabulation table;

  /// nodes: of the element, 8, 6, 4 or 3. Throws std::invalid_argument where a triangle is to have others.
  PlanePoints(int perDirection, int nodes);
  int count() const { return static_cast<int>(weights.size()); }
};

/// Covariant base vectors of R + zeta D at an in-plane point; R, D: [node][3].
struct Base {
  Vec3 g1{}, g2{}, g3{};
  double jacobian() const { return dot(cross(g1, g2), g3); }
};
Base baseAt(const fem::Tabulation& t, int point, double zeta, const double* R, const double* D);

}  // namespace atrapos::solid::detail
