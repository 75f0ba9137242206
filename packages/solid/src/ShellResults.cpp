#include "atrapos/solid/ShellResults.hpp"

#include <cmath>
#include <stdexcept>

#include "ShellSurface.hpp"

namespace atrapos::solid {

using detail::unit;
using detail::Vec3;

namespace {

/// Values at zeta of the Lagrange polynomials of the points x.
std::vector<double> lagrange(const std::vector<double>& x, double zeta) {
  std::vector<double> l(x.size(), 1.0);
  for (std::size_t i = 0; i < x.size(); ++i)
    for (std::size_t j = 0; j < x.size(); ++j)
      if (i != j) l[i] *= (zeta - x[j]) / (x[i] - x[j]);
  return l;
}

void checkStress(const fem::PointValues& stress, std::size_t multipleOf) {
  if (stress.names.size() < 6 || stress.values.size() % (stress.names.size() * multipleOf) != 0)
    throw std::logic_error("shell results: the stresses are not those of this shell's term");
}

/// Coefficients (a, b) with a G_1 + b G_2 = the projection of `axis` on the tangent plane, or of the axis'
/// next permutation where that is almost the normal.
std::array<double, 2> inPlane(const detail::Base& G, Vec3 axis) {
  const Vec3 N = unit(detail::cross(G.g1, G.g2));
  const double cos10 = std::cos(M_PI / 18);
  if (std::abs(detail::dot(unit(axis), N)) > cos10) axis = {axis[2], axis[0], axis[1]};
  const double a11 = detail::dot(G.g1, G.g1), a12 = detail::dot(G.g1, G.g2), a22 = detail::dot(G.g2, G.g2),
               b1 = detail::dot(axis, G.g1), b2 = detail::dot(axis, G.g2), det = a11 * a22 - a12 * a12;
  return {(b1 * a22 - b2 * a12) / det, (b2 * a11 - b1 * a12) / det};
}

/// Area, times its normal, of the strip dzeta at zeta of the section that has the unit normal e on the
/// mid-surface, per length of the section on the mid-surface: (e . g_1 G^1 + e . g_2 G^2) j/j_0 times half
/// the thickness, g the mid-surface's base, G^a and j those at zeta.
Vec3 sectionArea(const Vec3& e, const detail::Base& g, double half, const detail::Base& at) {
  const double scale = half / g.jacobian(), n1 = scale * detail::dot(e, g.g1),
               n2 = scale * detail::dot(e, g.g2);
  const Vec3 c1 = detail::cross(at.g2, at.g3), c2 = detail::cross(at.g3, at.g1);
  return {n1 * c1[0] + n2 * c2[0], n1 * c1[1] + n2 * c2[1], n1 * c1[2] + n2 * c2[2]};
}

/// e_a . s e_b
double component(const double* s, const Vec3& a, const Vec3& b) {
  return a[0] * (s[0] * b[0] + s[3] * b[1] + s[5] * b[2]) + a[1] * (s[3] * b[0] + s[1] * b[1] + s[4] * b[2]) +
         a[2] * (s[5] * b[0] + s[4] * b[1] + s[2] * b[2]);
}

}  // namespace

std::vector<double> surfaceStress(const fem::PointValues& stress, const ShellCubature& cubature,
                                  double zeta) {
  const detail::GaussRule through = detail::gaussRule(cubature.throughThickness);
  const std::size_t Z = through.x.size(), names = stress.names.size();
  checkStress(stress, Z);
  // Linear through the two points beside zeta: a metal's stress has kinks.
  std::size_t first = 0;
  while (first + 2 < Z && through.x[first + 1] < zeta) ++first;
  const std::vector<double> l = lagrange({through.x[first], through.x[first + 1]}, zeta);
  std::vector<double> result(stress.values.size() / (names * Z) * 6, 0.0);
  for (std::size_t p = 0; p < result.size() / 6; ++p)
    for (std::size_t z = 0; z < 2; ++z)
      for (int m = 0; m < 6; ++m) result[6 * p + m] += l[z] * stress.values[names * (p * Z + first + z) + m];
  return result;
}

std::vector<double> shellPointsToNodes(const ShellCubature& cubature, int nodes) {
  constexpr double xi[8] = {-1, 1, 1, -1, 0, 1, 0, -1}, eta[8] = {-1, -1, 1, 1, -1, 0, 1, 0};
  if (isTriangle(nodes)) {  // each point lies two thirds of the way from the middle to its corner
    std::vector<double> linear(3 * static_cast<std::size_t>(nodes), -1.0 / 3);
    for (int a = 0; a < 3; ++a) linear[4 * static_cast<std::size_t>(a)] = 5.0 / 3;
    for (int a = 3; a < nodes; ++a)  // between two corners
      for (int q = 0; q < 3; ++q) linear[3 * a + q] = q == (a + 2) % 3 ? -1.0 / 3 : 2.0 / 3;
    return linear;
  }
  const detail::GaussRule line = detail::gaussRule(cubature.inPlane);
  std::vector<double> result;
  for (int a = 0; a < nodes; ++a)
    for (double byEta : lagrange(line.x, eta[a]))
      for (double byXi : lagrange(line.x, xi[a])) result.push_back(byXi * byEta);
  return result;
}

std::vector<std::string> ShellResultants::names() {
  return {"n_11", "n_22", "n_12", "m_11", "m_22", "m_12", "q_1", "q_2"};
}

ShellResultants shellResultants(const ShellElements& elements, const fem::PointValues& stress,
                                const std::vector<double>& u, const ShellResultOptions& options) {
  const int N = elements.nodesPerElement;
  const detail::PlanePoints plane(options.cubature.inPlane, N);
  const detail::GaussRule through = detail::gaussRule(options.cubature.throughThickness);
  const int Q = plane.count(), Z = static_cast<int>(through.x.size());
  checkStress(stress, static_cast<std::size_t>(Q) * Z);
  if (stress.values.size() != static_cast<std::size_t>(elements.count()) * Q * Z * stress.names.size())
    throw std::logic_error("shell results: the stresses are not those of these elements");
  ShellResultants result;
  for (int e = 0; e < elements.count(); ++e) {
    const double *R = elements.R(e), *D = elements.D(e);
    double r[24], d[24];
    for (int a = 0; a < N; ++a)
      for (int i = 0; i < 3; ++i) {
        r[3 * a + i] = R[3 * a + i] + u[3 * elements.node(e, a) + i];
        d[3 * a + i] = D[3 * a + i] + elements.scale(e, a) * u[3 * elements.directorNode(e, a) + i];
      }
    for (int q = 0; q < Q; ++q) {
      const auto [c1, c2] = inPlane(detail::baseAt(plane.table, q, 0, R, D), options.axis);
      const detail::Base g = detail::baseAt(plane.table, q, 0, r, d);
      const Vec3 e3 = unit(detail::cross(g.g1, g.g2));
      const Vec3 e1 =
          unit({c1 * g.g1[0] + c2 * g.g2[0], c1 * g.g1[1] + c2 * g.g2[1], c1 * g.g1[2] + c2 * g.g2[2]});
      const Vec3 e2 = detail::cross(e3, e1);
      const double half = detail::dot(g.g3, e3);
      double sums[8] = {};
      for (int z = 0; z < Z; ++z) {
        const double* s =
            &stress.values[stress.names.size() * ((static_cast<std::size_t>(e) * Q + q) * Z + z)];
        const detail::Base at = detail::baseAt(plane.table, q, through.x[z], r, d);
        const double w = through.w[z], arm = through.x[z] * half;
        const Vec3 a1 = sectionArea(e1, g, half, at), a2 = sectionArea(e2, g, half, at);
        const double s11 = component(s, e1, a1), s22 = component(s, e2, a2),
                     s12 = 0.5 * (component(s, e2, a1) + component(s, e1, a2));
        const double add[8] = {
            s11, s22, s12, arm * s11, arm * s22, arm * s12, component(s, e3, a1), component(s, e3, a2)};
        for (int m = 0; m < 8; ++m) sums[m] += w * add[m];
      }
      result.values.insert(result.values.end(), sums, sums + 8);
      for (int i = 0; i < 3; ++i) {
        double x = 0;
        for (int a = 0; a < N; ++a) x += detail::valuesAt(plane.table, q)[a] * R[3 * a + i];
        result.positions.push_back(x);
      }
    }
  }
  return result;
}

std::vector<double> thicknessChange(const ShellElements& elements, const std::vector<double>& u) {
  std::vector<double> result;
  for (int e = 0; e < elements.count(); ++e)
    for (int a = 0; a < elements.nodesPerElement; ++a) {
      const double* D = elements.D(e) + 3 * static_cast<std::size_t>(a);
      const double* w = &u[3 * static_cast<std::size_t>(elements.directorNode(e, a))];
      const double own = elements.scale(e, a);
      const Vec3 before{D[0], D[1], D[2]}, after{D[0] + own * w[0], D[1] + own * w[1], D[2] + own * w[2]};
      result.push_back(2 * (std::sqrt(detail::dot(after, after)) - std::sqrt(detail::dot(before, before))));
    }
  return result;
}

}  // namespace atrapos::solid
