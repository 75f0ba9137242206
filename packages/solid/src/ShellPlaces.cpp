#include "ShellPlaces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace atrapos::solid::detail {

void addEnhancedVector(const ShellPlace& at, fem::EnhancedPoints& result) {
  const double j = at.base.jacobian(), jMiddle = at.middle.jacobian();
  const Vec3 dual = cross(at.middle.g1, at.middle.g2);
  double strain = 0;
  for (int i = 0; i < 3; ++i) {
    const double g = std::sqrt(jMiddle / j) * dual[i] / jMiddle;
    result.data.push_back(g);
    strain += g * g;
  }
  result.strain.push_back(strain);
}

fem::EnhancedPoints makeShellPoints(const ShellElements& elements, const ShellCubature& cubature,
                                    int components,
                                    const std::function<void(const ShellPlace&, fem::EnhancedPoints&)>& add) {
  const int N = elements.nodesPerElement;
  const std::size_t count = elements.count(), corners = count * N;
  if ((N != 8 && N != 6 && N != 4 && N != 3) || elements.nodes.size() != 2 * corners ||
      elements.midsurface.size() != 3 * corners || elements.directors.size() != 3 * corners ||
      (!elements.directorScale.empty() && elements.directorScale.size() != corners))
    throw std::logic_error(
        "shellPoints: 8, 6, 4 or 3 nodes, each with its director, position and director at rest, are needed");
  const PlanePoints plane(cubature.inPlane, N);
  const GaussRule through = gaussRule(cubature.throughThickness);
  const fem::Tabulation& t = plane.table;

  fem::EnhancedPoints result;
  result.numParameters = isTriangle(N) ? 3 : 4;
  fem::PointSet& p = result.points;
  p.numEntities = static_cast<int>(count);
  p.nodesPerEntity = 2 * N;
  p.pointsPerEntity = static_cast<int>(plane.weights.size() * through.x.size());
  p.shapeComponents = components;
  p.nodes = elements.nodes;
  const bool scaled = std::any_of(elements.directorScale.begin(), elements.directorScale.end(),
                                  [](double scale) { return scale != 1; });
  for (std::size_t q = 0; q < plane.weights.size(); ++q)
    for (double zeta : through.x) {
      const double xi = plane.xi[2 * q], eta = plane.xi[2 * q + 1];
      result.modes.insert(result.modes.end(), {zeta, zeta * xi, zeta * eta});
      if (!isTriangle(N)) result.modes.push_back(zeta * xi * eta);
    }
  for (std::size_t e = 0; e < count; ++e) {
    const double *R = elements.R(static_cast<int>(e)), *D = elements.D(static_cast<int>(e));
    for (std::size_t q = 0; q < plane.weights.size(); ++q) {
      const int at = static_cast<int>(q);
      const Base middle = baseAt(t, at, 0, R, D);
      for (double zeta : {-1.0, 0.0, 1.0})  // the faces count, not only the points
        if (!(baseAt(t, at, zeta, R, D).jacobian() > 0))
          throw std::runtime_error(
              fmt::format("shell element {}: the Jacobian is not positive at xi = {:.3f}, eta = {:.3f}, zeta "
                          "= {}: turned "
                          "over, degenerate, or thicker than its curvature allows",
                          e + 1, plane.xi[2 * q], plane.xi[2 * q + 1], zeta));
      for (std::size_t layer = 0; layer < through.x.size(); ++layer) {
        const double zeta = through.x[layer];
        const Base base = baseAt(t, at, zeta, R, D);
        p.weights.push_back(plane.weights[q] * through.w[layer] * base.jacobian());
        add(ShellPlace{elements, t, e, q, &plane.xi[2 * q], zeta, base, middle, scaled}, result);
        for (int i = 0; i < 3; ++i) {
          double x = 0;
          for (int a = 0; a < N; ++a) x += valuesAt(t, at)[a] * (R[3 * a + i] + zeta * D[3 * a + i]);
          p.positions.push_back(x);
        }
      }
    }
  }
  return result;
}

}  // namespace atrapos::solid::detail
