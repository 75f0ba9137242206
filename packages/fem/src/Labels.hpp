#pragma once

#include <string>

#include "atrapos/fem/Mesh.hpp"

namespace atrapos::fem {

/// "block 'roof'", or by its id where it has no name.
std::string blockLabel(const Block& block);

/// "element 17 (block 'roof')" with the number that the mesh's file gives it.
std::string elementLabel(const Mesh& mesh, int block, int elementOfBlock);

/// "node 17" with the number that the mesh's file gives it.
std::string nodeLabel(const Mesh& mesh, int node);

}  // namespace atrapos::fem
