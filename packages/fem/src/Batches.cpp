#include "atrapos/fem/Batches.hpp"

#include <algorithm>
#include <cstdint>
#include <numeric>

namespace atrapos::fem {

Batches makeBatches(int lanes, int numEntities, int nodesPerEntity, const std::vector<int>& nodes) {
  Batches batches;
  batches.lanes = lanes;
  batches.count = (numEntities + lanes - 1) / lanes;
  const int numNodes = nodes.empty() ? 0 : *std::max_element(nodes.begin(), nodes.end()) + 1;

  // One bit a colour, 64 colours at a time: neighbours in a mesh's own order need few, elements numbered at
  // random more; the batches left over take the next 64.
  std::vector<int> colourOf(batches.count), left(batches.count), later;
  std::iota(left.begin(), left.end(), 0);
  int numColours = 0;
  for (int base = 0; !left.empty(); base += 64) {
    std::vector<std::uint64_t> usedAt(numNodes, 0);
    later.clear();
    for (int b : left) {
      const std::size_t first = static_cast<std::size_t>(b) * lanes * nodesPerEntity;
      const std::size_t last =
          std::min<std::size_t>(first + static_cast<std::size_t>(lanes) * nodesPerEntity, nodes.size());
      std::uint64_t used = 0;
      for (std::size_t i = first; i < last; ++i) used |= usedAt[nodes[i]];
      int colour = 0;
      while (colour < 64 && (used >> colour & 1)) ++colour;
      if (colour == 64) {
        later.push_back(b);
        continue;
      }
      for (std::size_t i = first; i < last; ++i) usedAt[nodes[i]] |= std::uint64_t{1} << colour;
      colourOf[b] = base + colour;
      numColours = std::max(numColours, base + colour + 1);
    }
    left.swap(later);
  }
  for (int c = 0; c < numColours; ++c) {
    batches.colourStart.push_back(static_cast<int>(batches.order.size()));
    for (int b = 0; b < batches.count; ++b)
      if (colourOf[b] == c) batches.order.push_back(b);
  }
  batches.colourStart.push_back(static_cast<int>(batches.order.size()));
  return batches;
}

}  // namespace atrapos::fem
