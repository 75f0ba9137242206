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

namespace {

/// What the director of the shear strain E_13 (direction 0) or E_23 (1) has beside N_a: the node's part in
/// the monomial xi eta^2 (xi^2 eta) times xi - xi eta^2 (eta - xi^2 eta).
double shearShape(int direction, int a, const double* xi) {
  constexpr double part[2][8] = {{-0.25, 0.25, 0.25, -0.25, 0, -0.5, 0, 0.5},
                                 {-0.25, -0.25, 0.25, 0.25, 0.5, 0, -0.5, 0}};
  const double along = xi[direction], across = xi[1 - direction];
  return part[direction][a] * along * (1 - across * across);
}

}  // namespace

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
  p.shapeComponents = 4;
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
        const double* xi = &plane.xi[2 * q];
        double G[12] = {};  // [component][g_1, g_2, d_1, d_2]
        for (int a = 0; a < 8; ++a)
          for (int i = 0; i < 3; ++i) {
            const double* dN = &t.gradients[(q * 8 + a) * 2];
            const double X = R[3 * a + i] + zeta * D[3 * a + i];
            for (int c = 0; c < 2; ++c) {
              G[4 * i + c] += dN[c] * X;
              G[4 * i + 2 + c] += (t.values[q * 8 + a] + shearShape(c, a, xi)) * D[3 * a + i];
            }
          }
        for (int half = 0; half < 2; ++half)  // v, then w (times the director's scale)
          for (int a = 0; a < 8; ++a) {
            const double* dN = &t.gradients[(q * 8 + a) * 2];
            const double own = elements.scale(static_cast<int>(e), a);
            for (int c = 0; c < 2; ++c) p.shape.push_back(half == 0 ? dN[c] : own * zeta * dN[c]);
            for (int c = 0; c < 2; ++c)
              p.shape.push_back(half == 0 ? 0.0 : own * (t.values[q * 8 + a] + shearShape(c, a, xi)));
          }
        for (int i = 0; i < 3; ++i) {
          double x = 0;
          for (int a = 0; a < 8; ++a) x += t.values[q * 8 + a] * (R[3 * a + i] + zeta * D[3 * a + i]);
          p.positions.push_back(x);
        }
        result.data.insert(result.data.end(), G, G + 12);
        for (int i = 0; i < 3; ++i) result.data.insert(result.data.end(), {c1[i] / j, c2[i] / j, c3[i] / j});
        const Vec3 dual = cross(middle.g1, middle.g2);
        for (int i = 0; i < 3; ++i) result.data.push_back(std::sqrt(jMiddle / j) * dual[i] / jMiddle);
      }
    }
  }
  return result;
}

}  // namespace atrapos::solid
