#pragma once

#include <cmath>

#include "ShellGrid.hpp"
#include "atrapos/fem/FeProblem.hpp"
#include "atrapos/solid/SaintVenantKirchhoff.hpp"
#include "atrapos/solid/ShellLoads.hpp"
#include "support/Vectors.hpp"

namespace atrapos::solid::test {

using fem::test::Numbers;

/// The paper's element, the one with assumed transverse shear strains, those of four, three and six nodes.
enum class Shear { compatible, assumed, mitc4, mitc3, mitc6 };

/// Nodes of such an element.
inline int nodesOf(Shear shear) {
  return shear == Shear::mitc3 ? 3 : shear == Shear::mitc4 ? 4 : shear == Shear::mitc6 ? 6 : 8;
}

/// A distortion that is none.
inline std::array<double, 2> undistorted(double s, double t) { return {s, t}; }

std::unique_ptr<fem::Term> shellTerm(const ShellElements& elements, const SaintVenantKirchhoff& material,
                                     const ShellCubature& cubature = {}, Shear shear = Shear::compatible);

/// Saint Venant-Kirchhoff shell without supports and loads.
inline fem::FeModel shellModel(const ShellGrid& grid, const SaintVenantKirchhoff& material,
                               const ShellCubature& cubature = {}, Shear shear = Shear::compatible) {
  fem::FeModel model;
  model.dofs = fem::DofMap::displacements(2 * grid.numNodes());
  model.terms.push_back(shellTerm(grid.elements(), material, cubature, shear));
  model.constantLoad.assign(model.dofs.numDofs(), 0.0);
  model.load.assign(model.dofs.numDofs(), 0.0);
  return model;
}

using Matrix = std::array<double, 9>;  ///< by rows

/// Q - I with the rotation Q about (1, 2, 2)/3: u = (Q - I) X.
Matrix rotation(double angle);

/// v = A R, w = A D: u = A X in the whole body.
Numbers homogeneous(const ShellGrid& grid, const Matrix& A);

/// Holds components ("x", "yz", ...) of v at these nodes.
inline void hold(fem::FeModel& model, const std::vector<int>& nodes, const std::string& components) {
  for (int n : nodes)
    for (char c : components) model.prescribe(n, c - 'x', 0, 0);
}

/// The same of w.
inline void holdDirector(fem::FeModel& model, const ShellGrid& grid, const std::vector<int>& nodes,
                         const std::string& components) {
  for (int n : nodes)
    for (char c : components) model.prescribe(grid.director(n), c - 'x', 0, 0);
}

/// Symmetry about a plane with this normal axis: that component of v and w.
inline void symmetric(fem::FeModel& model, const ShellGrid& grid, const std::vector<int>& nodes, char axis) {
  hold(model, nodes, std::string(1, axis));
  holdDirector(model, grid, nodes, std::string(1, axis));
}

inline void clamp(fem::FeModel& model, const ShellGrid& grid, const std::vector<int>& nodes) {
  hold(model, nodes, "xyz");
  holdDirector(model, grid, nodes, "xyz");
}

/// Displacements of the linear problem: K(0) u = F at load factor 1.
Numbers linearSolution(fem::FeProblem& problem);

/// A flat rectangle [0, a] x [0, b] in the x-y plane.
inline Surface flat(double a, double b) {
  return [=](double s, double t) { return SurfacePoint{{a * s, b * t, 0}, {0, 0, 1}}; };
}

/// Cylinder about the y axis: (R sin(angle), y, R cos(angle)), angles in radians, normal outward; s runs
/// along y and t along the angle where `axialFirst`, so that the normal follows from the node order.
inline Surface cylinder(double R, double angle0, double angle1, double y0, double y1) {
  return [=](double s, double t) {
    const double a = angle0 + (angle1 - angle0) * s, y = y0 + (y1 - y0) * t;
    return SurfacePoint{{R * std::sin(a), y, R * std::cos(a)}, {std::sin(a), 0, std::cos(a)}};
  };
}

}  // namespace atrapos::solid::test
