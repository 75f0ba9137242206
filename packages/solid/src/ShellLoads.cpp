#include "atrapos/solid/ShellLoads.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "ShellSurface.hpp"
#include "atrapos/fem/LawTerm.hpp"
#include "atrapos/fem/ReferenceCell.hpp"

namespace atrapos::solid {
namespace {

using Vec3 = std::array<double, 3>;

constexpr double sqrt06 = 0.7745966692414834;  // sqrt(0.6), three Gauss points
constexpr std::array<double, 3> lineX{-sqrt06, 0, sqrt06}, lineW{5.0 / 9, 8.0 / 9, 5.0 / 9};

/// 3 x 3 points of the surface: N_a N_b J is integrated exactly for parallelograms.
fem::Tabulation surfaceTable(const ShellElements& elements) {
  return fem::tabulateFace(detail::faceOf(elements.nodesPerElement), 5);
}

/// X_xi and X_eta of the surface zeta at a point.
void surfaceTangents(const ShellElements& elements, int e, const fem::Tabulation& t, int q, double zeta,
                     Vec3& g1, Vec3& g2) {
  g1 = g2 = {0, 0, 0};
  const double *R = elements.R(e), *D = elements.D(e);
  for (int a = 0; a < t.numNodes; ++a)
    for (int i = 0; i < 3; ++i) {
      const double X = R[3 * a + i] + zeta * D[3 * a + i];
      g1[i] += detail::gradientAt(t, q, a)[0] * X;
      g2[i] += detail::gradientAt(t, q, a)[1] * X;
    }
}

/// Calls give(element, point, area vector times weight) at all points of a surface.
template <class Give>
void forEachSurfacePoint(const ShellElements& elements, double zeta, const fem::Tabulation& t,
                         const Give& give) {
  for (int e = 0; e < elements.count(); ++e)
    for (int q = 0; q < t.numPoints; ++q) {
      Vec3 g1, g2, n;
      surfaceTangents(elements, e, t, q, zeta, g1, g2);
      detail::cross(g1.data(), g2.data(), n.data());
      for (double& c : n) c *= t.weights[q];
      give(e, q, n);
    }
}

void addAt(const ShellElements& elements, int e, const double* N, double zeta, const Vec3& f,
           std::vector<double>& force) {
  for (int a = 0; a < elements.nodesPerElement; ++a)
    for (int i = 0; i < 3; ++i) {
      force[3 * elements.node(e, a) + i] += N[a] * f[i];
      if (zeta != 0) force[3 * elements.directorNode(e, a) + i] += zeta * elements.scale(e, a) * N[a] * f[i];
    }
}

/// Nodes of an edge within the element: start, end, and the middle where it has one.
std::vector<int> nodesOf(const ShellElements& elements, const ShellEdge& edge) {
  std::vector<int> nodes{edge.edge, (edge.edge + 1) % elements.corners()};
  if (elements.hasMiddles()) nodes.push_back(elements.corners() + edge.edge);
  return nodes;
}

/// Their shape functions at s in [-1, 1].
struct EdgeShape {
  std::array<double, 3> N, dN;
  EdgeShape(const ShellElements& elements, double s) : N{(1 - s) / 2, (1 + s) / 2, 0}, dN{-0.5, 0.5, 0} {
    if (elements.hasMiddles()) {
      N = {s * (s - 1) / 2, s * (s + 1) / 2, 1 - s * s};
      dN = {s - 0.5, s + 0.5, -2 * s};
    }
  }
};

void checkEdges(const ShellElements& elements, const std::vector<ShellEdge>& edges) {
  for (const ShellEdge& edge : edges)
    if (edge.element < 0 || edge.element >= elements.count() || edge.edge < 0 ||
        edge.edge >= elements.corners())
      throw std::invalid_argument(
          fmt::format("shell edge {} of element {}: there are {} edges and {} elements", edge.edge + 1,
                      edge.element + 1, elements.corners(), elements.count()));
}

Vec3 edgeTangent(const ShellElements& elements, const ShellEdge& edge, const EdgeShape& shape) {
  Vec3 T{};
  const auto local = nodesOf(elements, edge);
  for (std::size_t a = 0; a < local.size(); ++a)
    for (int i = 0; i < 3; ++i) T[i] += shape.dN[a] * elements.R(edge.element)[3 * local[a] + i];
  return T;
}

/// Points of edges, law inputs (v, v_s, w): the nodes of v, then those of w; and the laws' data.
fem::PointSet edgePoints(const ShellElements& elements, const std::vector<ShellEdge>& edges,
                         std::vector<double>& data) {
  checkEdges(elements, edges);
  fem::PointSet p;
  p.numEntities = static_cast<int>(edges.size());
  p.nodesPerEntity = elements.hasMiddles() ? 6 : 4;
  p.pointsPerEntity = 3;
  p.shapeComponents = 3;
  for (const ShellEdge& edge : edges) {
    const auto local = nodesOf(elements, edge);
    for (int a : local) p.nodes.push_back(elements.node(edge.element, a));
    for (int a : local) p.nodes.push_back(elements.directorNode(edge.element, a));
    for (int q = 0; q < 3; ++q) {
      const EdgeShape shape(elements, lineX[q]);
      const Vec3 T = edgeTangent(elements, edge, shape);
      Vec3 D{};
      for (std::size_t a = 0; a < local.size(); ++a)
        for (int i = 0; i < 3; ++i) D[i] += shape.N[a] * elements.D(edge.element)[3 * local[a] + i];
      p.weights.push_back(lineW[q] * std::sqrt(detail::dot(T.data(), T.data())));
      for (std::size_t a = 0; a < local.size(); ++a)
        p.shape.insert(p.shape.end(), {shape.N[a], shape.dN[a], 0});
      for (std::size_t a = 0; a < local.size(); ++a)
        p.shape.insert(p.shape.end(), {0, 0, elements.scale(edge.element, local[a]) * shape.N[a]});
      data.insert(data.end(), D.begin(), D.end());
      data.insert(data.end(), T.begin(), T.end());
    }
  }
  return p;
}

}  // namespace

void addShellAreaForce(const ShellElements& elements, double zeta, const std::array<double, 3>& perArea,
                       std::vector<double>& force) {
  const fem::Tabulation t = surfaceTable(elements);
  forEachSurfacePoint(elements, zeta, t, [&](int e, int q, const Vec3& n) {
    const double area = std::sqrt(detail::dot(n.data(), n.data()));
    addAt(elements, e, detail::valuesAt(t, q), zeta,
          {area * perArea[0], area * perArea[1], area * perArea[2]}, force);
  });
}

void addShellBodyForce(const ShellElements& elements, const std::array<double, 3>& perVolume,
                       std::vector<double>& force) {
  const fem::Tabulation t = surfaceTable(elements);
  for (int e = 0; e < elements.count(); ++e)
    for (int q = 0; q < t.numPoints; ++q)
      for (std::size_t layer = 0; layer < lineX.size(); ++layer) {  // N zeta J has degree 3 in zeta
        const double zeta = lineX[layer];
        const double volume =
            t.weights[q] * lineW[layer] * detail::baseAt(t, q, zeta, elements.R(e), elements.D(e)).jacobian();
        addAt(elements, e, detail::valuesAt(t, q), zeta,
              {volume * perVolume[0], volume * perVolume[1], volume * perVolume[2]}, force);
      }
}

void addShellPressure(const ShellElements& elements, double zeta, double pressure,
                      std::vector<double>& force) {
  const fem::Tabulation t = surfaceTable(elements);
  forEachSurfacePoint(elements, zeta, t, [&](int e, int q, const Vec3& n) {
    addAt(elements, e, detail::valuesAt(t, q), zeta, {-pressure * n[0], -pressure * n[1], -pressure * n[2]},
          force);
  });
}

void addShellEdgeForce(const ShellElements& elements, const std::vector<ShellEdge>& edges,
                       const std::array<double, 3>& perLength, std::vector<double>& force) {
  checkEdges(elements, edges);
  for (const ShellEdge& edge : edges)
    for (int q = 0; q < 3; ++q) {
      const EdgeShape shape(elements, lineX[q]);
      const Vec3 T = edgeTangent(elements, edge, shape);
      const double length = lineW[q] * std::sqrt(detail::dot(T.data(), T.data()));
      const auto local = nodesOf(elements, edge);
      for (std::size_t a = 0; a < local.size(); ++a)
        for (int i = 0; i < 3; ++i)
          force[3 * elements.node(edge.element, local[a]) + i] += length * shape.N[a] * perLength[i];
    }
}

double lengthOf(const ShellElements& elements, const std::vector<ShellEdge>& edges) {
  checkEdges(elements, edges);
  double length = 0;
  for (const ShellEdge& edge : edges)
    for (int q = 0; q < 3; ++q) {
      const Vec3 T = edgeTangent(elements, edge, EdgeShape(elements, lineX[q]));
      length += lineW[q] * std::sqrt(detail::dot(T.data(), T.data()));
    }
  return length;
}

std::unique_ptr<fem::Term> followerPressure(const ShellElements& elements, const std::vector<int>& loaded,
                                            double zeta, LoadAmount pressure) {
  const fem::Tabulation t = surfaceTable(elements);
  fem::PointSet p;
  p.numEntities = static_cast<int>(loaded.size());
  p.nodesPerEntity = 2 * t.numNodes;
  p.pointsPerEntity = t.numPoints;
  p.shapeComponents = 3;
  std::vector<double> data;
  for (int e : loaded) {
    if (e < 0 || e >= elements.count())
      throw std::invalid_argument(
          fmt::format("pressure on shell element {}: there are {} elements", e + 1, elements.count()));
    for (int a = 0; a < p.nodesPerEntity; ++a) p.nodes.push_back(elements.node(e, a));
    for (int q = 0; q < t.numPoints; ++q) {
      p.weights.push_back(t.weights[q]);
      for (int half = 0; half < 2; ++half)
        for (int a = 0; a < t.numNodes; ++a) {
          const double* dN = detail::gradientAt(t, q, a);
          const double scale = half == 0 ? 1.0 : zeta * elements.scale(e, a);
          p.shape.insert(p.shape.end(), {scale * detail::valuesAt(t, q)[a], scale * dN[0], scale * dN[1]});
        }
      Vec3 g1, g2;
      surfaceTangents(elements, e, t, q, zeta, g1, g2);
      data.insert(data.end(), g1.begin(), g1.end());
      data.insert(data.end(), g2.begin(), g2.end());
    }
  }
  return fem::lawTerm(fem::pointLaw(FollowerPressure{pressure}), p, data);
}

std::unique_ptr<fem::Term> followerEdgeLoad(const ShellElements& elements,
                                            const std::vector<ShellEdge>& edges,
                                            const FollowerEdgeLoad& load) {
  std::vector<double> data;
  const fem::PointSet p = edgePoints(elements, edges, data);
  return fem::lawTerm(fem::pointLaw(load), p, data);
}

std::unique_ptr<fem::Term> deadEdgeMoment(const ShellElements& elements, const std::vector<ShellEdge>& edges,
                                          const DeadEdgeMoment& load) {
  std::vector<double> data;
  const fem::PointSet p = edgePoints(elements, edges, data);
  for (std::size_t i = 0; i < data.size() / 6; ++i)
    for (const Vec3& m : {Vec3{load.x.constant, load.y.constant, load.z.constant},
                          Vec3{load.x.rate, load.y.rate, load.z.rate}}) {
      const double* D = &data[6 * i];
      const double size = std::sqrt(detail::dot(m.data(), m.data()) * detail::dot(D, D));
      // Directors made from averaged normals are off the true normal by up to about a degree.
      if (std::abs(detail::dot(m.data(), D)) > 0.02 * size)
        throw std::invalid_argument(fmt::format(
            "the moment on edge {} of shell element {} has a part about the director: shells take "
            "no drilling moments",
            edges[i / 3].edge + 1, edges[i / 3].element + 1));
    }
  return fem::lawTerm(fem::pointLaw(load), p, data);
}

}  // namespace atrapos::solid
