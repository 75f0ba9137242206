#pragma once

#include <array>
#include <utility>

#include "atrapos/fem/Mesh.hpp"

namespace atrapos {

/// How far a block reaches along x, y, z, and the largest of its cells.
struct Extents {
  std::array<double, 3> body{}, cell{};
};

/// The least and the largest coordinate along an axis, of all nodes; 0, 0 where there are none.
std::pair<double, double> rangeAlong(const fem::Mesh& mesh, int axis);

/// The longest side of a box around the mesh.
double longestSide(const fem::Mesh& mesh);

Extents extentsOf(const fem::Mesh& mesh, const fem::Block& block);

}  // namespace atrapos
