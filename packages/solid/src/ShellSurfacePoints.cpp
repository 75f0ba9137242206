#include <fmt/format.h>

#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

#include "ShellSurface.hpp"
#include "atrapos/solid/ShellPoints.hpp"

namespace atrapos::solid {
namespace {

void check(const ShellElements& elements, int e) {
  if (e < 0 || e >= elements.count())
    throw std::invalid_argument(
        fmt::format("points on shell element {}: there are {} elements", e + 1, elements.count()));
}

}  // namespace

fem::PointSet shellNodePoints(const ShellElements& elements, const std::vector<int>& which, double zeta) {
  std::map<std::pair<int, int>, std::array<double, 3>> places;  // of (node, director)
  for (int e : which) {
    check(elements, e);
    const std::size_t element = e;
    for (int a = 0; a < 8; ++a) {
      auto& x = places[{elements.nodes[16 * element + a], elements.nodes[16 * element + 8 + a]}];
      for (int i = 0; i < 3; ++i)
        x[i] = elements.midsurface[24 * element + 3 * a + i] +
               zeta * elements.directors[24 * element + 3 * a + i];
    }
  }
  fem::PointSet p;
  p.numEntities = static_cast<int>(places.size());
  p.nodesPerEntity = zeta == 0 ? 1 : 2;
  p.pointsPerEntity = p.shapeComponents = 1;
  p.weights.assign(places.size(), 1.0);
  for (const auto& [nodes, x] : places) {
    p.nodes.push_back(nodes.first);
    p.shape.push_back(1);
    if (zeta != 0) {
      p.nodes.push_back(nodes.second);
      p.shape.push_back(zeta);
    }
    p.positions.insert(p.positions.end(), x.begin(), x.end());
  }
  return p;
}

fem::PointSet shellSurfacePoints(const ShellElements& elements, const std::vector<int>& which, double zeta,
                                 int degree) {
  const fem::Tabulation t = fem::tabulateFace(fem::Face::Quad8, degree);
  fem::PointSet p;
  p.numEntities = static_cast<int>(which.size());
  p.nodesPerEntity = zeta == 0 ? 8 : 16;
  p.pointsPerEntity = t.numPoints;
  p.shapeComponents = 1;
  for (int e : which) {
    check(elements, e);
    const auto first = elements.nodes.begin() + 16 * static_cast<std::ptrdiff_t>(e);
    p.nodes.insert(p.nodes.end(), first, first + p.nodesPerEntity);
    const double* R = &elements.midsurface[24 * static_cast<std::size_t>(e)];
    const double* D = &elements.directors[24 * static_cast<std::size_t>(e)];
    for (int q = 0; q < t.numPoints; ++q) {
      const detail::Base base = detail::baseAt(t, q, zeta, R, D);
      const detail::Vec3 n = detail::cross(base.g1, base.g2);
      const double area = std::sqrt(detail::dot(n, n));
      p.weights.push_back(t.weights[q] * area);
      for (int half = 0; half < (zeta == 0 ? 1 : 2); ++half)
        for (int a = 0; a < 8; ++a) p.shape.push_back((half == 0 ? 1.0 : zeta) * t.values[q * 8 + a]);
      for (int i = 0; i < 3; ++i) {
        double x = 0;
        for (int a = 0; a < 8; ++a) x += t.values[q * 8 + a] * (R[3 * a + i] + zeta * D[3 * a + i]);
        p.positions.push_back(x);
        p.normals.push_back(n[i] / area);
      }
    }
  }
  return p;
}

}  // namespace atrapos::solid
