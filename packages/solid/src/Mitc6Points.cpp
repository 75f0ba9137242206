#include <array>
#include <stdexcept>

#include "ShellPlaces.hpp"
#include "atrapos/solid/Mitc6Base.hpp"
#include "atrapos/taylor/SmallLu.hpp"

namespace atrapos::solid {
namespace {

using mitc6::far;
using mitc6::near;

/// The field of shear strains (2 E_13, 2 E_23): all linear ones and (eta q, -xi q), q linear without a
/// constant; along each edge its tangential part is linear.
using Row = std::array<double, 8>;
std::array<Row, 2> shearField(double xi, double eta) {
  return {{{1, xi, eta, 0, 0, 0, eta * xi, eta * eta}, {0, 0, 0, 1, xi, eta, -xi * xi, -xi * eta}}};
}

/// The field's coefficients by what is tied, [coefficient][tied] by rows: its part along the edges at their
/// Gauss points, and both components at the centre, in the order of Mitc6's products.
std::array<double, 64> coefficientsOfTied() {
  constexpr double third = 1.0 / 3;
  constexpr double points[8][2] = {{near, 0},   {far, 0},    {0, near},      {0, far},
                                   {far, near}, {near, far}, {third, third}, {third, third}};
  constexpr double along[8][2] = {{1, 0}, {1, 0}, {0, 1}, {0, 1}, {-1, 1}, {-1, 1}, {1, 0}, {0, 1}};
  std::array<double, 64> tied{}, coefficients{};
  for (int m = 0; m < 8; ++m) {
    const auto field = shearField(points[m][0], points[m][1]);
    for (int n = 0; n < 8; ++n) tied[8 * m + n] = along[m][0] * field[0][n] + along[m][1] * field[1][n];
  }
  taylor::detail::SmallLu<8> lu;
  lu.factor(tied.data());
  lu.invert(coefficients.data());
  return coefficients;
}

/// Parts of the values at the two Gauss points of an edge and at its third point in a linear function; along:
/// from 0 to 1 along the edge at the foot of the parallel through the point, inwards: of the distance to it.
std::array<double, 3> edgeParts(double along, double inwards) {
  const double third = inwards / mitc6::inside, second = (along - near) / (far - near);
  return {1 - second - third, second, third};
}

/// The numbers of Mitc6Place.
void addMitc6Place(const double* xi, double zeta, std::vector<double>& data) {
  static const std::array<double, 64> coefficients = coefficientsOfTied();
  data.insert(data.end(), {xi[0], xi[1], zeta});
  // The third point lies straight inwards of the first one in (xi, eta).
  const double first = 1 - xi[0] - xi[1];
  for (const auto& parts : {edgeParts(xi[0], xi[1]), edgeParts(xi[1], xi[0]), edgeParts(xi[1], first)})
    data.insert(data.end(), parts.begin(), parts.end());
  for (const Row& field : shearField(xi[0], xi[1]))
    for (int m = 0; m < 8; ++m) {
      double part = 0;
      for (int n = 0; n < 8; ++n) part += field[n] * coefficients[8 * n + m];
      data.push_back(part);
    }
}

// Parts of the nodes in x_,xi and x_,eta at corner 1 and in the second derivatives.
constexpr double kDerivatives[6][5] = {{-3, -3, 4, 4, 4}, {-1, 0, 4, 0, 0}, {0, -1, 0, 0, 4},
                                       {4, 0, -8, -4, 0}, {0, 0, 0, 4, 0},  {0, 4, 0, -4, -8}};

void addMitc6Point(const detail::ShellPlace& at, fem::EnhancedPoints& result) {
  std::vector<double>&shape = result.points.shape, &data = result.data;
  for (const auto& derivatives : kDerivatives) {
    shape.insert(shape.end(), derivatives, derivatives + 5);
    shape.insert(shape.end(), 6, 0.0);
  }
  for (int node = 0; node < 6; ++node) {
    shape.insert(shape.end(), 5, 0.0);
    for (int d = 0; d < 6; ++d) shape.push_back(d == node ? at.scale(node) : 0.0);
  }
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 5; ++k) {
      double vector = 0;
      for (int node = 0; node < 6; ++node) vector += kDerivatives[node][k] * at.R()[3 * node + i];
      data.push_back(vector);
    }
    for (int node = 0; node < 6; ++node) data.push_back(at.D()[3 * node + i]);
  }
  addMitc6Place(at.xi, at.zeta, data);
  detail::Contravariant(at.base).addTo(data);
  detail::addEnhancedVector(at, result);
}

}  // namespace

fem::EnhancedPoints mitc6Points(const ShellElements& elements, const ShellCubature& cubature) {
  if (elements.nodesPerElement != 6) throw std::logic_error("mitc6Points: elements of six nodes are needed");
  return detail::makeShellPoints(elements, cubature, 11, addMitc6Point);
}

}  // namespace atrapos::solid
