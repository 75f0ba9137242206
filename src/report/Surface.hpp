#pragma once

#include <cstdint>
#include <vector>

#include "atrapos/fem/Mesh.hpp"

namespace atrapos {

/// What is seen of a mesh from outside: sides that one cell alone has, middle surfaces of shells, plane
/// cells. Numbers of nodes are those of `nodes`.
struct Surface {
  std::vector<int> nodes;                ///< of the mesh, those that the surface uses
  std::vector<std::uint32_t> triangles;  ///< [triangle][3]; nodes within edges and faces make more of them
  std::vector<std::uint32_t> triangleElements;  ///< [triangle] of the mesh
  std::vector<std::uint32_t> edges;             ///< [segment][2] along the edges of cells, each once
};

Surface surfaceOf(const fem::Mesh& mesh);

}  // namespace atrapos
