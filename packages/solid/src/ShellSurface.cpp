#include "ShellSurface.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace atrapos::solid::detail {

GaussRule gaussRule(int points) {
  switch (points) {
    case 2: {
      const double a = 1 / std::sqrt(3.0);
      return {{-a, a}, {1, 1}};
    }
    case 3: {
      const double a = std::sqrt(0.6);
      return {{-a, 0, a}, {5.0 / 9, 8.0 / 9, 5.0 / 9}};
    }
    default: {
      if (points < 2 || points > 10)
        throw std::invalid_argument(fmt::format("shell cubature: {} points; accepted are 2 to 10", points));
      const fem::Tabulation line = fem::tabulateFace(fem::Face::Line2, 2 * points - 1);
      std::vector<std::pair<double, double>> sorted;
      for (int q = 0; q < points; ++q) sorted.emplace_back(line.points[q], line.weights[q]);
      std::sort(sorted.begin(), sorted.end());
      GaussRule rule;
      for (const auto& [x, w] : sorted) {
        rule.x.push_back(x);
        rule.w.push_back(w);
      }
      return rule;
    }
  }
}

fem::Face faceOf(int nodes) {
  switch (nodes) {
    case 3:
      return fem::Face::Tri3;
    case 4:
      return fem::Face::Quad4;
    case 6:
      return fem::Face::Tri6;
    default:
      return fem::Face::Quad8;
  }
}

PlanePoints::PlanePoints(int perDirection, int nodes) {
  if (isTriangle(nodes)) {
    if (perDirection != 2)
      throw std::invalid_argument("shell cubature: triangles have three points in the plane");
    xi = {1.0 / 6, 1.0 / 6, 2.0 / 3, 1.0 / 6, 1.0 / 6, 2.0 / 3};
    weights.assign(3, 1.0 / 6);
    table = fem::tabulateFaceAt(faceOf(nodes), xi);
    return;
  }
  const GaussRule line = gaussRule(perDirection);
  for (int j = 0; j < perDirection; ++j)
    for (int i = 0; i < perDirection; ++i) {
      xi.insert(xi.end(), {line.x[i], line.x[j]});
      weights.push_back(line.w[i] * line.w[j]);
    }
  table = fem::tabulateFaceAt(faceOf(nodes), xi);
}

Base baseAt(const fem::Tabulation& t, int point, double zeta, const double* R, const double* D) {
  Base base;
  for (int a = 0; a < t.numNodes; ++a) {
    const double N = valuesAt(t, point)[a];
    const double* dN = gradientAt(t, point, a);
    for (int i = 0; i < 3; ++i) {
      const double X = R[3 * a + i] + zeta * D[3 * a + i];
      base.g1[i] += dN[0] * X;
      base.g2[i] += dN[1] * X;
      base.g3[i] += N * D[3 * a + i];
    }
  }
  return base;
}

}  // namespace atrapos::solid::detail
