#include "atrapos/solid/ShellPoints.hpp"

#include <fmt/format.h>

#include <algorithm>
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

/// What a law's maps and data are made of at one cubature point of one element.
struct Place {
  const ShellElements& elements;
  const fem::Tabulation& table;
  std::size_t element, q;  ///< q: in the plane
  const double* xi;        ///< [2]
  double zeta;
  Base base, middle;  ///< at zeta and at 0
  bool scaled;        ///< directors of some elements are

  double N(int a) const { return table.values[q * 8 + a]; }
  const double* dN(int a) const { return &table.gradients[(q * 8 + a) * 2]; }
  double scale(int a) const { return elements.scale(static_cast<int>(element), a); }
};

/// Contravariant base times the Jacobian j.
struct Contravariant {
  Vec3 c1, c2, c3;
  double j;
  explicit Contravariant(const Base& g)
      : c1(cross(g.g2, g.g3)), c2(cross(g.g3, g.g1)), c3(cross(g.g1, g.g2)), j(g.jacobian()) {}
};

/// g of the enhanced strain, whose square is the strain per unit of e.
void addEnhancedVector(const Place& at, fem::EnhancedPoints& result) {
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

/// Gradients of N_a, then of zeta N_a (times the director's scale): with respect to X where directors are
/// scaled, else by (xi, eta, zeta), which all elements share, and each element's map.
void addGradients(const Place& at, fem::EnhancedPoints& result) {
  fem::PointSet& p = result.points;
  const Contravariant c(at.base);
  for (int half = 0; half < 2 && (at.scaled || at.element == 0); ++half)
    for (int a = 0; a < 8; ++a) {
      const double z = half == 0 ? 1.0 : at.zeta * at.scale(a);
      const double d[3] = {z * at.dN(a)[0], z * at.dN(a)[1], half == 0 ? 0.0 : at.scale(a) * at.N(a)};
      if (at.scaled)
        for (int i = 0; i < 3; ++i)
          p.shape.push_back((d[0] * c.c1[i] + d[1] * c.c2[i] + d[2] * c.c3[i]) / c.j);
      else
        p.shape.insert(p.shape.end(), d, d + 3);
    }
  if (!at.scaled)
    for (const Vec3& row : {c.c1, c.c2, c.c3})
      for (int i = 0; i < 3; ++i) p.maps.push_back(row[i] / c.j);
  addEnhancedVector(at, result);
}

/// The shape functions of x_,xi, x_,eta and of the two directors of the assumed shear; the law's vectors at
/// rest.
void addAssumedShear(const Place& at, fem::EnhancedPoints& result) {
  double director[2][8], G[12] = {};  // G: [component][g_1, g_2, d_1, d_2]
  const double* R = &at.elements.midsurface[24 * at.element];
  const double* D = &at.elements.directors[24 * at.element];
  for (int a = 0; a < 8; ++a)
    for (int c = 0; c < 2; ++c) {
      director[c][a] = at.N(a) + shearShape(c, a, at.xi);
      for (int i = 0; i < 3; ++i) {
        G[4 * i + c] += at.dN(a)[c] * (R[3 * a + i] + at.zeta * D[3 * a + i]);
        G[4 * i + 2 + c] += director[c][a] * D[3 * a + i];
      }
    }
  std::vector<double>& shape = result.points.shape;
  for (int a = 0; a < 8; ++a) shape.insert(shape.end(), {at.dN(a)[0], at.dN(a)[1], 0.0, 0.0});
  for (int a = 0; a < 8; ++a) {
    const double own = at.scale(a), z = own * at.zeta;
    shape.insert(shape.end(), {z * at.dN(a)[0], z * at.dN(a)[1], own * director[0][a], own * director[1][a]});
  }
  const Contravariant c(at.base);
  result.data.insert(result.data.end(), G, G + 12);
  for (int i = 0; i < 3; ++i)
    result.data.insert(result.data.end(), {c.c1[i] / c.j, c.c2[i] / c.j, c.c3[i] / c.j});
  addEnhancedVector(at, result);
}

template <class Add>
fem::EnhancedPoints makePoints(const ShellElements& elements, const ShellCubature& cubature, int components,
                               const Add& add) {
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
  p.shapeComponents = components;
  p.nodes = elements.nodes;
  const bool scaled = std::any_of(elements.directorScale.begin(), elements.directorScale.end(),
                                  [](double scale) { return scale != 1; });
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
        add(Place{elements, t, e, q, &plane.xi[2 * q], zeta, base, middle, scaled}, result);
        for (int i = 0; i < 3; ++i) {
          double x = 0;
          for (int a = 0; a < 8; ++a) x += t.values[q * 8 + a] * (R[3 * a + i] + zeta * D[3 * a + i]);
          p.positions.push_back(x);
        }
      }
    }
  }
  return result;
}

}  // namespace

fem::EnhancedPoints shellPoints(const ShellElements& elements, const ShellCubature& cubature) {
  return makePoints(elements, cubature, 3, addGradients);
}

fem::EnhancedPoints assumedShearPoints(const ShellElements& elements, const ShellCubature& cubature) {
  return makePoints(elements, cubature, 4, addAssumedShear);
}

}  // namespace atrapos::solid
