#include "atrapos/solid/ShellPoints.hpp"

#include <stdexcept>

#include "ShellPlaces.hpp"

namespace atrapos::solid {

using detail::Contravariant;
using detail::Vec3;
using Place = detail::ShellPlace;

namespace {

/// What the director of the shear strain E_13 (direction 0) or E_23 (1) has beside N_a: the node's part in
/// the monomial xi eta^2 (xi^2 eta) times xi - xi eta^2 (eta - xi^2 eta).
double shearShape(int direction, int a, const double* xi) {
  constexpr double part[2][8] = {{-0.25, 0.25, 0.25, -0.25, 0, -0.5, 0, 0.5},
                                 {-0.25, -0.25, 0.25, 0.25, 0.5, 0, -0.5, 0}};
  const double along = xi[direction], across = xi[1 - direction];
  return part[direction][a] * along * (1 - across * across);
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
  detail::addEnhancedVector(at, result);
}

/// The shape functions of x_,xi, x_,eta and of the two directors of the assumed shear; the law's vectors at
/// rest.
void addAssumedShear(const Place& at, fem::EnhancedPoints& result) {
  double director[2][8], G[12] = {};  // G: [component][g_1, g_2, d_1, d_2]
  const double *R = at.R(), *D = at.D();
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
  result.data.insert(result.data.end(), G, G + 12);
  Contravariant(at.base).addTo(result.data);
  detail::addEnhancedVector(at, result);
}

}  // namespace

fem::PointSet shellFieldPoints(const ShellElements& elements, const fem::Tabulation& cell) {
  const int N = elements.nodesPerElement;
  if (cell.numNodes != N || cell.dim != 2)
    throw std::logic_error("shellFieldPoints: a cell in the plane with the element's nodes is needed");
  fem::PointSet p;
  p.components = 1;
  p.numEntities = elements.count();
  p.nodesPerEntity = N;
  p.pointsPerEntity = cell.numPoints;
  p.shapeComponents = 3;
  for (int e = 0; e < elements.count(); ++e) {
    for (int a = 0; a < N; ++a) p.nodes.push_back(elements.node(e, a));
    for (int q = 0; q < cell.numPoints; ++q) {
      const detail::Base base = detail::baseAt(cell, q, 0, elements.R(e), elements.D(e));
      // With the normal in the director's place gradients have no part across the surface.
      const Contravariant c({base.g1, base.g2, detail::unit(detail::cross(base.g1, base.g2))});
      for (int a = 0; a < N; ++a) {
        const double* d = detail::gradientAt(cell, q, a);
        for (int i = 0; i < 3; ++i) p.shape.push_back((d[0] * c.c1[i] + d[1] * c.c2[i]) / c.j);
      }
      p.weights.push_back(2 * base.jacobian() * cell.weights[q]);
      for (int i = 0; i < 3; ++i) {
        double x = 0;
        for (int a = 0; a < N; ++a) x += detail::valuesAt(cell, q)[a] * elements.R(e)[3 * a + i];
        p.positions.push_back(x);
      }
    }
  }
  return p;
}

fem::EnhancedPoints shellPoints(const ShellElements& elements, const ShellCubature& cubature) {
  return detail::makeShellPoints(elements, cubature, 3, addGradients);
}

fem::EnhancedPoints assumedShearPoints(const ShellElements& elements, const ShellCubature& cubature) {
  return detail::makeShellPoints(elements, cubature, 4, addAssumedShear);
}

}  // namespace atrapos::solid
