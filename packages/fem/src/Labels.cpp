#include "Labels.hpp"

#include <fmt/format.h>

namespace atrapos::fem {

std::string blockLabel(const Block& block) {
  return block.name.empty() ? fmt::format("block {}", block.id) : fmt::format("block '{}'", block.name);
}

std::string elementLabel(const Mesh& mesh, int block, int elementOfBlock) {
  int element = elementOfBlock;
  for (int b = 0; b < block; ++b)
    element += static_cast<int>(mesh.blocks[b].nodes.size()) / nodesPerElement(mesh.blocks[b].topology);
  return fmt::format("element {} ({})", mesh.elementNumber(element), blockLabel(mesh.blocks[block]));
}

std::string nodeLabel(const Mesh& mesh, int node) { return fmt::format("node {}", mesh.nodeNumber(node)); }

}  // namespace atrapos::fem
