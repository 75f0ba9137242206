#include "Labels.hpp"

#include <fmt/format.h>

namespace atrapos::fem {

std::string blockLabel(const Block& block) {
  return block.name.empty() ? fmt::format("block {}", block.id) : fmt::format("block '{}'", block.name);
}

std::string elementLabel(const Mesh& mesh, int block, int elementOfBlock) {
  std::size_t element = static_cast<std::size_t>(elementOfBlock);
  for (int b = 0; b < block; ++b)
    element += mesh.blocks[b].nodes.size() / nodesPerElement(mesh.blocks[b].topology);
  const long long id =
      mesh.elementIds.empty() ? static_cast<long long>(element) + 1 : mesh.elementIds[element];
  return fmt::format("element {} ({})", id, blockLabel(mesh.blocks[block]));
}

std::string nodeLabel(const Mesh& mesh, int node) {
  return fmt::format("node {}", mesh.nodeIds.empty() ? node + 1LL : mesh.nodeIds[node]);
}

}  // namespace atrapos::fem
