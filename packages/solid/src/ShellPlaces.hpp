#pragma once

#include <functional>

#include "ShellSurface.hpp"
#include "atrapos/solid/ShellPoints.hpp"

/// What the points of all shell elements are made of.
namespace atrapos::solid::detail {

/// What a law's maps and data are made of at one cubature point of one element.
struct ShellPlace {
  const ShellElements& elements;
  const fem::Tabulation& table;
  std::size_t element, q;  ///< q: in the plane
  const double* xi;        ///< [2]
  double zeta;
  Base base, middle;  ///< at zeta and at 0
  bool scaled;        ///< directors of some elements are

  double N(int a) const { return valuesAt(table, static_cast<int>(q))[a]; }
  const double* dN(int a) const { return gradientAt(table, static_cast<int>(q), a); }
  const double* R() const { return elements.R(static_cast<int>(element)); }
  const double* D() const { return elements.D(static_cast<int>(element)); }
  double scale(int a) const { return elements.scale(static_cast<int>(element), a); }
};

/// Contravariant base times the Jacobian j.
struct Contravariant {
  Vec3 c1, c2, c3;
  double j;
  explicit Contravariant(const Base& g)
      : c1(cross(g.g2, g.g3)), c2(cross(g.g3, g.g1)), c3(cross(g.g1, g.g2)), j(g.jacobian()) {}
  /// The base itself, [component][i].
  void addTo(std::vector<double>& data) const {
    for (int i = 0; i < 3; ++i) data.insert(data.end(), {c1[i] / j, c2[i] / j, c3[i] / j});
  }
};

/// Adds g of the enhanced strain, whose square is the strain per unit of e.
void addEnhancedVector(const ShellPlace& at, fem::EnhancedPoints& result);

/// The points of all elements; `add` gives maps and data of one. components: of its shape functions.
fem::EnhancedPoints makeShellPoints(const ShellElements& elements, const ShellCubature& cubature,
                                    int components,
                                    const std::function<void(const ShellPlace&, fem::EnhancedPoints&)>& add);

}  // namespace atrapos::solid::detail
