#include <cmath>
#include <stdexcept>

#include "ShellPlaces.hpp"
#include "atrapos/solid/TiedShellLaw.hpp"

namespace atrapos::solid {

using detail::dot;
using detail::Vec3;

namespace {

/// Signs of xi and eta at the corners.
constexpr double xiOf[4] = {-1, 1, 1, -1}, etaOf[4] = {-1, -1, 1, 1};

/// Parts of a, b, m (Mitc4Base.hpp) in the position of a corner.
std::array<double, 3> partsOf(int corner) {
  return {0.25 * xiOf[corner], 0.25 * etaOf[corner], 0.25 * xiOf[corner] * etaOf[corner]};
}

Vec3 sumOf(const double* R, int part) {
  Vec3 sum{};
  for (int corner = 0; corner < 4; ++corner)
    for (int i = 0; i < 3; ++i) sum[i] += partsOf(corner)[part] * R[3 * corner + i];
  return sum;
}

/// What a unit of a.h and of b.h does to E_11, E_22, E_12 at a point: strains of bending in the plane in
/// place of those of the displacements.
struct Hourglass {
  double parts[2];      ///< of m along a and b
  double strain[2][3];  ///< [of a, of b][component]

  Hourglass(const detail::ShellPlace& at, double poisson) {
    const Vec3 a = sumOf(at.R(), 0), b = sumOf(at.R(), 1), m = sumOf(at.R(), 2);
    const double aa = dot(a, a), ab = dot(a, b), bb = dot(b, b), area2 = aa * bb - ab * ab, xi = at.xi[0],
                 eta = at.xi[1];
    const auto along = [&](const Vec3& v, double* to) {
      to[0] = (bb * dot(v, a) - ab * dot(v, b)) / area2;
      to[1] = (aa * dot(v, b) - ab * dot(v, a)) / area2;
    };
    along(m, parts);
    // In the base of the centre: the stretch along a that varies with eta takes with it what a stress along a
    // alone does across, as in Pian and Sumihara's element, and no shear that varies with xi.
    const double central[2][3] = {{0, eta * (ab * ab - poisson * area2) / (aa * aa), eta * ab / aa - xi / 2},
                                  {xi * (ab * ab - poisson * area2) / (bb * bb), 0, xi * ab / bb - eta / 2}};
    // G_i = T_ij A_j of the middle surface. With the weight of the point taken off, the sum over an element
    // vanishes, and constant stresses do no work.
    double T[2][2];
    along(at.middle.g1, T[0]);
    along(at.middle.g2, T[1]);
    const double weight = 1 / (T[0][0] * T[1][1] - T[0][1] * T[1][0]);
    for (int of = 0; of < 2; ++of) {
      const double* c = central[of];
      const auto component = [&](int i, int j) {
        return weight * (T[i][0] * T[j][0] * c[0] + T[i][1] * T[j][1] * c[1] +
                         (T[i][0] * T[j][1] + T[i][1] * T[j][0]) * c[2]);
      };
      strain[of][0] = component(0, 0);
      strain[of][1] = component(1, 1);
      strain[of][2] = component(0, 1);
    }
  }
};

/// The numbers of Mitc4Place.
void addMitc4Place(const detail::ShellPlace& at, double poisson, std::vector<double>& data) {
  const Hourglass hourglass(at, poisson);
  data.insert(data.end(), {at.xi[0], at.xi[1], at.zeta, hourglass.parts[0], hourglass.parts[1]});
  for (const auto& strain : hourglass.strain) data.insert(data.end(), strain, strain + 3);
}

void addMitc4Point(const detail::ShellPlace& at, double poisson, fem::EnhancedPoints& result) {
  std::vector<double>&shape = result.points.shape, &data = result.data;
  for (int corner = 0; corner < 4; ++corner) {
    const auto parts = partsOf(corner);
    shape.insert(shape.end(), parts.begin(), parts.end());
    shape.insert(shape.end(), 4, 0.0);
  }
  for (int corner = 0; corner < 4; ++corner) {
    shape.insert(shape.end(), 3, 0.0);
    for (int d = 0; d < 4; ++d) shape.push_back(d == corner ? at.scale(corner) : 0.0);
  }
  const Vec3 ofSurface[3] = {sumOf(at.R(), 0), sumOf(at.R(), 1), sumOf(at.R(), 2)};
  for (int i = 0; i < 3; ++i) {
    for (const Vec3& v : ofSurface) data.push_back(v[i]);
    for (int d = 0; d < 4; ++d) data.push_back(at.D()[3 * d + i]);
  }
  addMitc4Place(at, poisson, data);
  detail::Contravariant(at.base).addTo(data);
  detail::addEnhancedVector(at, result);
}

}  // namespace

fem::EnhancedPoints mitc4Points(const ShellElements& elements, double poissonRatio,
                                const ShellCubature& cubature) {
  if (elements.nodesPerElement != 4) throw std::logic_error("mitc4Points: elements of four nodes are needed");
  if (cubature.inPlane != 2)
    throw std::invalid_argument("shell cubature: elements of four nodes have 2 x 2 points in the plane");
  return detail::makeShellPoints(elements, cubature, 7,
                                 [&](const detail::ShellPlace& at, fem::EnhancedPoints& result) {
                                   addMitc4Point(at, poissonRatio, result);
                                 });
}

}  // namespace atrapos::solid
