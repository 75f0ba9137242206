#include "atrapos/solid/ShellPoints.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <stdexcept>

#include "atrapos/fem/ReferenceCell.hpp"

namespace atrapos::solid {
namespace {

using Vec3 = std::array<double, 3>;

Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double dot(const Vec3& a, const Vec3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

struct GaussRule {
  std::vector<double> x, w;
};

GaussRule gauss(int n) {
  switch (n) {
    case 2: {
      const double a = 1 / std::sqrt(3.0);
      return {{-a, a}, {1, 1}};
    }
    case 3: {
      const double a = std::sqrt(0.6);
      return {{-a, 0, a}, {5.0 / 9, 8.0 / 9, 5.0 / 9}};
    }
    default:
      throw std::invalid_argument(fmt::format("shell cubature: {} points; accepted are 2 and 3", n));
  }
}

/// Covariant base vectors of X(xi, eta, zeta) = R + zeta D.
struct Base {
  Vec3 g1{}, g2{}, g3{};
  double jacobian() const { return dot(cross(g1, g2), g3); }
};

Base baseAt(const fem::Tabulation& t, int point, double zeta, const double* R, const double* D) {
  Base base;
  for (int a = 0; a < 8; ++a) {
    const double N = t.values[point * 8 + a];
    const double* dN = &t.gradients[(point * 8 + a) * 2];
    for (int i = 0; i < 3; ++i) {
      const double X = R[3 * a + i] + zeta * D[3 * a + i];
      base.g1[i] += dN[0] * X;
      base.g2[i] += dN[1] * X;
      base.g3[i] += N * D[3 * a + i];
    }
  }
  return base;
}

}  // namespace

fem::EnhancedPoints shellPoints(const ShellElements& elements, const ShellCubature& cubature) {
  const std::size_t count = elements.nodes.size() / 16;
  if (elements.nodes.size() != 16 * count || elements.midsurface.size() != 24 * count ||
      elements.directors.size() != 24 * count)
    throw std::logic_error("shellPoints: 16 nodes, 8 positions and 8 directors an element are needed");
  const GaussRule plane = gauss(cubature.inPlane), through = gauss(cubature.throughThickness);
  std::vector<double> places, planeWeights;
  for (std::size_t j = 0; j < plane.x.size(); ++j)
    for (std::size_t i = 0; i < plane.x.size(); ++i) {
      places.insert(places.end(), {plane.x[i], plane.x[j]});
      planeWeights.push_back(plane.w[i] * plane.w[j]);
    }
  const fem::Tabulation t = fem::tabulateFaceAt(fem::Face::Quad8, places);

  fem::EnhancedPoints result;
  result.numParameters = numShellParameters;
  fem::PointSet& p = result.points;
  p.numEntities = static_cast<int>(count);
  p.nodesPerEntity = 16;
  p.pointsPerEntity = static_cast<int>(planeWeights.size() * through.x.size());
  p.shapeComponents = 3;
  p.nodes = elements.nodes;
  for (std::size_t q = 0; q < planeWeights.size(); ++q)
    for (double zeta : through.x) {
      const double xi = places[2 * q], eta = places[2 * q + 1];
      result.modes.insert(result.modes.end(), {zeta, zeta * xi, zeta * eta, zeta * xi * eta});
    }
  for (std::size_t e = 0; e < count; ++e) {
    const double* R = &elements.midsurface[24 * e];
    const double* D = &elements.directors[24 * e];
    for (std::size_t q = 0; q < planeWeights.size(); ++q) {
      const int at = static_cast<int>(q);
      const Base middle = baseAt(t, at, 0, R, D);
      const double jMiddle = middle.jacobian();
      for (double zeta : {-1.0, 0.0, 1.0})  // the faces count, not only the points
        if (!(baseAt(t, at, zeta, R, D).jacobian() > 0))
          throw std::runtime_error(
              fmt::format("shell element {}: the Jacobian is not positive at xi = {:.3f}, eta = {:.3f}, zeta "
                          "= {}: turned "
                          "over, degenerate, or thicker than its curvature allows",
                          e + 1, places[2 * q], places[2 * q + 1], zeta));
      for (std::size_t z = 0; z < through.x.size(); ++z) {
        const double zeta = through.x[z];
        const Base base = baseAt(t, at, zeta, R, D);
        const double j = base.jacobian();
        const Vec3 c1 = cross(base.g2, base.g3), c2 = cross(base.g3, base.g1), c3 = cross(base.g1, base.g2);
        p.weights.push_back(planeWeights[q] * through.w[z] * j);
        for (int half = 0; half < 2; ++half)  // N_a, then zeta N_a
          for (int a = 0; a < 8; ++a) {
            const double N = t.values[q * 8 + a];
            const double* dN = &t.gradients[(q * 8 + a) * 2];
            const double scale = half == 0 ? 1.0 : zeta;
            for (int i = 0; i < 3; ++i)
              p.shape.push_back((scale * (dN[0] * c1[i] + dN[1] * c2[i]) + (half == 0 ? 0.0 : N) * c3[i]) /
                                j);
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
