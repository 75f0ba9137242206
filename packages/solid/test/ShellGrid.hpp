#pragma once

#include <array>
#include <functional>
#include <vector>

#include "atrapos/solid/ShellLoads.hpp"

namespace atrapos::solid::test {

using Vec3 = std::array<double, 3>;

/// A point of a mid-surface and its unit normal, over parameters in [0, 1]^2.
struct SurfacePoint {
  Vec3 x, normal;
};
using Surface = std::function<SurfacePoint(double s, double t)>;

/// A map from [0, 1]^2 to parameters: distorts a grid within its surface.
using Distortion = std::function<std::array<double, 2>(double s, double t)>;

/// nu x nv elements of eight or four nodes on a mid-surface, or as many squares of two triangles of six or
/// three, with diagonals in turn. Nodes have indices (i, j), 0 <= i <= 2 nu, 0 <= j <= 2 nv, on the lattice
/// of half elements; with eight nodes none has both odd, with four or three none has one odd.
struct ShellGrid {
  int nu = 0, nv = 0, nodesPerElement = 8;
  std::vector<int> lattice;  ///< [j][i] node, -1 where there is none
  std::vector<Vec3> x, normal;
  double thickness = 0;

  int numNodes() const { return static_cast<int>(x.size()); }
  int node(int i, int j) const { return lattice[j * (2 * nu + 1) + i]; }
  /// Number of the node's director among the model's nodes.
  int director(int n) const { return numNodes() + n; }
  Vec3 D(int n) const;  ///< (thickness/2) N
  /// Nodes of a lattice line: i = const or j = const.
  std::vector<int> lineI(int i) const;
  std::vector<int> lineJ(int j) const;

  ShellElements elements() const;
  /// The corners of triangles in two squares next to each other come in another order by so many steps.
  int turn = 0;
  /// Element edges along the outline: side 0: t = 0, 1: s = 1, 2: t = 1, 3: s = 0.
  std::vector<ShellEdge> side(int number) const;
};

ShellGrid shellGrid(
    int nu, int nv, double thickness, const Surface& surface,
    const Distortion& distortion =
        [](double s, double t) {
          return std::array<double, 2>{s, t};
        },
    int nodesPerElement = 8);

/// Moves the nodes inside a flat grid by up to `amount` in its plane, edges between corners kept straight
/// (the nodes between corners at the middle); the grid's outer edge stays.
ShellGrid shaken(ShellGrid grid, double amount, unsigned seed = 1);

}  // namespace atrapos::solid::test
