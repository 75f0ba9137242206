#pragma once

#include <vector>

#include "atrapos/fem/EnhancedTerm.hpp"
#include "atrapos/fem/ReferenceCell.hpp"

namespace atrapos::solid {

/// Whether a shell element of so many nodes is one.
constexpr bool isTriangle(int nodesPerElement) { return nodesPerElement == 3 || nodesPerElement == 6; }

/// Shell elements of eight, six, four or three nodes as FeProblem sees them: every node of the mid-surface
/// has a node for its displacement v and one for the displacement w of its director, x = X + v + zeta w.
///
/// Nodes in Exodus' order of SHELL8, SHELL4, TRISHELL6 and TRISHELL3: corners, then the middles of the edges
/// 1-2, 2-3, 3-4, 4-1.
struct ShellElements {
  std::vector<int> nodes;          ///< [element][2 N]: N nodes of v, then those of w
  std::vector<double> midsurface;  ///< [element][N][3] R, length
  std::vector<double>
      directors;  ///< [element][N][3] D = (thickness/2) N of the element, N the normal, length
  /// [element][N] the element's own director over that of the node, whose displacement is w: elements of
  /// different thickness may share a director. Empty: 1 everywhere.
  std::vector<double> directorScale;
  int nodesPerElement = 8;  ///< N, 8, 6, 4 or 3

  int corners() const { return isTriangle(nodesPerElement) ? 3 : 4; }
  bool hasMiddles() const { return nodesPerElement > corners(); }
  int count() const { return static_cast<int>(nodes.size()) / (2 * nodesPerElement); }
  double scale(int element, int a) const {
    return directorScale.empty() ? 1.0 : directorScale[at(element) + a];
  }
  const double* R(int element) const { return &midsurface[3 * at(element)]; }
  const double* D(int element) const { return &directors[3 * at(element)]; }
  /// The node of v at corner or middle a, and that of w.
  int node(int element, int a) const { return nodes[2 * at(element) + a]; }
  int directorNode(int element, int a) const { return node(element, nodesPerElement + a); }

 private:
  std::size_t at(int element) const { return static_cast<std::size_t>(element) * nodesPerElement; }
};

/// Cubature of a shell element: Gauss points along each reference coordinate.
struct ShellCubature {
  int inPlane = 2;           ///< along xi and eta; 2: reduced, 3: full; triangles have three points for 2
  int throughThickness = 2;  ///< along zeta, up to 10
};

/// Points in the plane of an element of so many nodes.
inline int pointsInPlane(const ShellCubature& cubature, int nodesPerElement) {
  return isTriangle(nodesPerElement) ? 3 : cubature.inPlane * cubature.inPlane;
}

/// For scalars of the elements' own nodes, the same through the thickness: gradients along the middle
/// surface, which a cell of its shape is tabulated for; weights: thickness times area.
fem::PointSet shellFieldPoints(const ShellElements& elements, const fem::Tabulation& cell);

/// For fem::enhancedTerm with the law ShellLaw<Material>: gradients of N_a and zeta N_a with respect to X = R
/// + zeta D, volume weights, modes zeta {1, xi, eta, xi eta}
/// (triangles: without the last) and the scaled base vector g
/// (docs/theory/shell.md). Points are in the order [eta][xi][zeta], zeta fastest. Throws std::runtime_error
/// naming the element (counted from 1) where the Jacobian of X is not positive: the thickness is too large
/// for the curvature, or the element is turned over or degenerate.
fem::EnhancedPoints shellPoints(const ShellElements& elements, const ShellCubature& cubature = {});

/// The same for AssumedShearLaw<Material>: about twice the cost of an element, and no locking of thin plates
/// that are clamped (docs/theory/shell.md, "Assumed transverse shear"). Shape functions of the four vectors
/// x_,xi, x_,eta, d_1, d_2, and the law's data.
fem::EnhancedPoints assumedShearPoints(const ShellElements& elements, const ShellCubature& cubature = {});

/// The same for Mitc4Law<Material>: elements of four nodes, 2 x 2 points in the plane. poissonRatio: of the
/// material at rest; it shapes the strains of bending in the plane. Throws std::invalid_argument for other
/// points.
fem::EnhancedPoints mitc4Points(const ShellElements& elements, double poissonRatio,
                                const ShellCubature& cubature = {});

/// The same for Mitc3Law<Material>: elements of three nodes, three points in the plane. poissonRatio: of the
/// material at rest; it says how far shear strains yield to bending within the element.
fem::EnhancedPoints mitc3Points(const ShellElements& elements, double poissonRatio,
                                const ShellCubature& cubature = {});

/// The same for elements of six nodes, three points in the plane.
fem::EnhancedPoints mitc6Points(const ShellElements& elements, const ShellCubature& cubature = {});

}  // namespace atrapos::solid
