#pragma once

#include <array>

#include "atrapos/fem/Mesh.hpp"

namespace atrapos {

/// How far a block reaches along x, y, z, and the largest of its cells.
struct Extents {
  std::array<double, 3> body{}, cell{};
};

Extents extentsOf(const fem::Mesh& mesh, const fem::Block& block);

}  // namespace atrapos
