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

Extents extentsOf(const fem::Mesh& mesh, const fem::Block& block);

}  // namespace atrapos
