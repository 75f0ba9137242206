#include "atrapos/solid/ShellPoints.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "ShellSurface.hpp"

namespace atrapos::solid {

using detail::Base;
using detail::baseAt;
using detail::cross;
using detail::Vec3;

fem::EnhancedPoints shellPoints(const ShellElements& elements, const ShellCubature& cubature) {
  const std::size_t count = elements.nodes.size() / 16;
  if (elements.nodes.size() != 16 * count || elements.midsurface.size() != 24 * count ||
      elements.directors.size() != 24 * count ||
      (!elements.directorScale.empty() && elements.directorScale.size() != 8 * count))
    throw std::logic_error("shellPoints: 16 nodes, 8 positions and 8 directors an element are needed");
  const detail::PlanePoints plane(cubature.inPlane);
  const detail::GaussRule through = detail::gaussRule(cubature.throughThickness);
  const fem::Tabulation& t = plane.table;

  fem::EnhancedPoints result;
  result.numParameters = numShellParameters;
  fem::PointSet& p = result.points;
  p.numEntities = static_cast<int>(count);
  p.nodesPerEntity = 16;
  p.pointsPerEntity = static_cast<int>(plane.weights.size() * through.x.size());
  p.shapeComponents = 3;
  p.nodes = elements.nodes;
  for (std::size_t q = 0; q < plane.weights.size(); ++q)
    for (double zeta : through.x) {
      const double xi = plane.xi[2 * q], eta = plane.xi[2 * q + 1];
      result.modes.insert(result.modes.end(), {zeta, zeta * xi, zeta * eta, zeta * xi * eta});
    }
  for (std::size_t e = 0; e < count; ++e) {
    const double* R = &elements.midsurface[24 * e];
    const double* D = &elements.directors[24 * e];
    for (std::size_t q = 0; q < plane.weights.size(); ++q) {
      const int at = static_cast<int>(q);
      const Base middle = baseAt(t, at, 0, R, D);
      const double jMiddle = middle.jacobian();
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
        const double j = base.jacobian();
        const Vec3 c1 = cross(base.g2, base.g3), c2 = cross(base.g3, base.g1), c3 = cross(base.g1, base.g2);
        p.weights.push_back(plane.weights[q] * through.w[layer] * j);
        for (int half = 0; half < 2; ++half)  // N_a, then zeta N_a (times the director's scale)
          for (int a = 0; a < 8; ++a) {
            const double own = half == 0 ? 1.0 : elements.scale(static_cast<int>(e), a);
            const double N = half == 0 ? 0.0 : t.values[q * 8 + a];  // d/dzeta
            const double* dN = &t.gradients[(q * 8 + a) * 2];
            const double z = half == 0 ? 1.0 : zeta;
            for (int i = 0; i < 3; ++i)
              p.shape.push_back(own * (z * (dN[0] * c1[i] + dN[1] * c2[i]) + N * c3[i]) / j);
          }
        for (int i = 0; i < 3; ++i) {
          double x = 0;
          for (int a = 0; a < 8; ++a) x += t.values[q * 8 + a] * (R[3 * a + i] + zeta * D[3 * a + i]);
          p.positions.push_back(x);
        }
        const Vec3 dual = cross(middle.g1, middle.g2);
        for (int i = 0; i < 3; ++i) result.data.push_back(std::sqrt(jMiddle / j) * dual[i] / jMiddle);
      }
    }
  }
  return result;
}

}  // namespace atrapos::solid
