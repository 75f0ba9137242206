#pragma once

#include <vector>

#include "atrapos/fem/EnhancedTerm.hpp"
#include "atrapos/solid/ShellLaw.hpp"

namespace atrapos::solid {

/// Eight-node shell elements as FeProblem sees them: every node of the mid-surface has a node for its
/// displacement v and one for the displacement w of its director, x = X + v + zeta w.
///
/// Nodes in Exodus' order of SHELL8: corners, then the middles of the edges 1-2, 2-3, 3-4, 4-1.
struct ShellElements {
  std::vector<int> nodes;          ///< [element][16]: eight nodes of v, then those of w
  std::vector<double> midsurface;  ///< [element][8][3] R, length
  std::vector<double> directors;   ///< [element][8][3] D = (thickness/2) N, N the unit normal, length

  int count() const { return static_cast<int>(nodes.size() / 16); }
};

/// Cubature of a shell element: Gauss points along each reference coordinate.
struct ShellCubature {
  int inPlane = 2;           ///< along xi and eta; 2: reduced, 3: full
  int throughThickness = 2;  ///< along zeta
};

/// Parameters of the enhanced thickness strain: beta in span{1, xi, eta, xi eta}.
constexpr int numShellParameters = 4;

/// Term of a shell with this material.
template <class Material>
using ShellTerm = fem::EnhancedTerm<ShellLaw<Material>, numShellParameters>;

/// The cubature points of shell elements: gradients of N_a and zeta N_a with respect to X = R + zeta D,
/// volume weights, modes zeta {1, xi, eta, xi eta} and the scaled base vector g (docs/theory/shell.md).
/// Points are in the order [eta][xi][zeta], zeta fastest. Throws std::runtime_error naming the element
/// (counted from 1) where the Jacobian of X is not positive: the thickness is too large for the curvature, or
/// the element is turned over or degenerate.
fem::EnhancedPoints shellPoints(const ShellElements& elements, const ShellCubature& cubature = {});

// ---- points on the surface zeta (-1 bottom, 0 mid, 1 top) for laws of the place x = X + v + zeta (D + w):
// contact, forces that depend on the place. `which` lists elements; shapes are values {N_a, zeta N_a},
// without the second half where zeta = 0.

/// One point of weight 1 at every node of these elements, each (node, director) once, in ascending order.
fem::PointSet shellNodePoints(const ShellElements& elements, const std::vector<int>& which, double zeta);

/// Cubature points exact to `degree` on the reference square; weights are areas of the surface, normals its
/// unit normals to the side of +D.
fem::PointSet shellSurfacePoints(const ShellElements& elements, const std::vector<int>& which, double zeta,
                                 int degree);

}  // namespace atrapos::solid
