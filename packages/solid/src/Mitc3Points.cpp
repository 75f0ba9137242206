#include <cmath>
#include <stdexcept>

#include "ShellPlaces.hpp"
#include "atrapos/solid/Mitc3Base.hpp"

namespace atrapos::solid {

using detail::cross;
using detail::dot;
using detail::unit;
using detail::Vec3;

namespace {

Vec3 edgeOf(const double* R, int from, int to) {
  return {R[3 * to] - R[3 * from], R[3 * to + 1] - R[3 * from + 1], R[3 * to + 2] - R[3 * from + 2]};
}

/// A symmetric matrix of two rows.
struct Symmetric2 {
  double xx, xy, yy;
  double trace() const { return xx + yy; }
  double determinant() const { return xx * yy - xy * xy; }
  Symmetric2 inverse() const {
    const double d = determinant();
    return {yy / d, -xy / d, xx / d};
  }
  /// The positive root of a positive definite one (Cayley and Hamilton).
  Symmetric2 root() const {
    const double s = std::sqrt(determinant()), t = std::sqrt(trace() + 2 * s);
    return {(xx + s) / t, xy / t, (yy + s) / t};
  }
};

/// What a bubble of the director between the corners leaves of the shear strains of an element
/// (docs/theory/shell_triangles.md, "Shear").
struct BubbledShear {
  double covariant[2][2];  ///< of the constant part, in 13 and 23
  double linear;           ///< of the part that varies

  BubbledShear(const double* R, const double* D, double poisson) {
    const Vec3 a = edgeOf(R, 0, 1), b = edgeOf(R, 0, 2), e1 = unit(a), e2 = unit(cross(cross(a, b), a));
    const double ax = dot(a, e1), bx = dot(b, e1), by = dot(b, e2);  // a has no part along e2
    Vec3 d{};
    for (int corner = 0; corner < 3; ++corner)
      for (int i = 0; i < 3; ++i) d[i] += 2 * D[3 * corner + i] / 3;
    const double thickness = dot(d, unit(cross(a, b)));
    // Gradients of the corners' functions, and the sum of their dyads.
    const double dxi[2] = {1 / ax, -bx / (ax * by)}, deta[2] = {0, 1 / by},
                 dfirst[2] = {-dxi[0] - deta[0], -dxi[1] - deta[1]};
    Symmetric2 M{};
    for (const double* g : {dfirst, dxi, deta}) {
      M.xx += g[0] * g[0];
      M.xy += g[0] * g[1];
      M.yy += g[1] * g[1];
    }
    const double same = 0.5 * (1 - poisson) * M.trace(), along = 0.5 * (1 + poisson),
                 shear = 10.0 / 27 * (1 - poisson) / (thickness * thickness);
    const Symmetric2 bending{same + along * M.xx, along * M.xy, same + along * M.yy},
        soft = bending.inverse();
    const Symmetric2 compliance{1 + shear * soft.xx, shear * soft.xy, 1 + shear * soft.yy},
        F = compliance.inverse().root();
    linear = 2 / compliance.trace();
    // G F G^-1 with the rows (ax, 0), (bx, by) of G.
    const double GF[2][2] = {{ax * F.xx, ax * F.xy}, {bx * F.xx + by * F.xy, bx * F.xy + by * F.yy}};
    for (int i = 0; i < 2; ++i) {
      covariant[i][0] = GF[i][0] / ax - GF[i][1] * bx / (ax * by);
      covariant[i][1] = GF[i][1] / by;
    }
  }
};

/// The numbers of Mitc3Place.
void addMitc3Place(const detail::ShellPlace& at, double poisson, std::vector<double>& data) {
  const BubbledShear shear(at.R(), at.D(), poisson);
  const double xi = at.xi[0], eta = at.xi[1];
  data.insert(data.end(), {xi, eta, at.zeta});
  // Of the products of edges 1-2, 1-3, 2-3, which are twice their shear strains 2 E.
  constexpr double centre[2][3] = {{1.0 / 3, 1.0 / 6, -1.0 / 6}, {1.0 / 6, 1.0 / 3, 1.0 / 6}},
                   turn[3] = {-0.5, 0.5, -0.5};
  const double varying[2] = {shear.linear * (eta - 1.0 / 3), shear.linear * (1.0 / 3 - xi)};
  for (int i = 0; i < 2; ++i)
    for (int edge = 0; edge < 3; ++edge)
      data.push_back(shear.covariant[i][0] * centre[0][edge] + shear.covariant[i][1] * centre[1][edge] +
                     varying[i] * turn[edge]);
}

void addMitc3Point(const detail::ShellPlace& at, double poisson, fem::EnhancedPoints& result) {
  std::vector<double>&shape = result.points.shape, &data = result.data;
  for (int corner = 0; corner < 3; ++corner)
    shape.insert(shape.end(), {at.dN(corner)[0], at.dN(corner)[1], 0, 0, 0});
  for (int corner = 0; corner < 3; ++corner) {
    shape.insert(shape.end(), 2, 0.0);
    for (int d = 0; d < 3; ++d) shape.push_back(d == corner ? at.scale(corner) : 0.0);
  }
  const Vec3 a = edgeOf(at.R(), 0, 1), b = edgeOf(at.R(), 0, 2);
  for (int i = 0; i < 3; ++i) data.insert(data.end(), {a[i], b[i], at.D()[i], at.D()[3 + i], at.D()[6 + i]});
  addMitc3Place(at, poisson, data);
  detail::Contravariant(at.base).addTo(data);
  detail::addEnhancedVector(at, result);
}

}  // namespace

fem::EnhancedPoints mitc3Points(const ShellElements& elements, double poissonRatio,
                                const ShellCubature& cubature) {
  if (elements.nodesPerElement != 3)
    throw std::logic_error("mitc3Points: elements of three nodes are needed");
  return detail::makeShellPoints(elements, cubature, 5,
                                 [&](const detail::ShellPlace& at, fem::EnhancedPoints& result) {
                                   addMitc3Point(at, poissonRatio, result);
                                 });
}

}  // namespace atrapos::solid
