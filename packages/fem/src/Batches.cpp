#include "atrapos/fem/Batches.hpp"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <optional>
#include <utility>

namespace atrapos::fem {

namespace {

constexpr int longestChunk = 16;
constexpr int chunksForAColour = 32;

// Chunks of one colour share no node; nothing where more than `most` colours are needed.
std::optional<Batches> coloured(Batches batches, int nodesPerEntity, const std::vector<int>& nodes,
                                int most) {
  const int numChunks = batches.chunks();
  const int numNodes = nodes.empty() ? 0 : *std::max_element(nodes.begin(), nodes.end()) + 1;
  const std::size_t nodesOfChunk =
      static_cast<std::size_t>(batches.perChunk) * batches.lanes * nodesPerEntity;

  // One bit a colour, 64 colours at a time: neighbours in a mesh's own order need few, elements numbered at
  // random more; the chunks left over take the next 64.
  std::vector<int> colourOf(numChunks), left(numChunks), later;
  std::iota(left.begin(), left.end(), 0);
  int numColours = 0;
  for (int base = 0; !left.empty() && numColours <= most; base += 64) {
    std::vector<std::uint64_t> usedAt(numNodes, 0);
    later.clear();
    for (int chunk : left) {
      const std::size_t first = chunk * nodesOfChunk;
      const std::size_t last = std::min(first + nodesOfChunk, nodes.size());
      std::uint64_t used = 0;
      for (std::size_t i = first; i < last; ++i) used |= usedAt[nodes[i]];
      int colour = 0;
      while (colour < 64 && (used >> colour & 1)) ++colour;
      if (colour == 64) {
        later.push_back(chunk);
        continue;
      }
      for (std::size_t i = first; i < last; ++i) usedAt[nodes[i]] |= std::uint64_t{1} << colour;
      colourOf[chunk] = base + colour;
      numColours = std::max(numColours, base + colour + 1);
    }
    left.swap(later);
  }
  if (numColours > most) return std::nullopt;
  for (int c = 0; c < numColours; ++c) {
    batches.colourStart.push_back(static_cast<int>(batches.order.size()));
    for (int chunk = 0; chunk < numChunks; ++chunk)
      if (colourOf[chunk] == c) batches.order.push_back(chunk);
  }
  batches.colourStart.push_back(static_cast<int>(batches.order.size()));
  return batches;
}

}  // namespace

Batches makeBatches(int lanes, int numEntities, int nodesPerEntity, const std::vector<int>& nodes) {
  Batches plain;
  plain.lanes = lanes;
  plain.count = (numEntities + lanes - 1) / lanes;
  for (plain.perChunk = longestChunk; plain.perChunk > 1; plain.perChunk /= 2) {
    auto batches = coloured(plain, nodesPerEntity, nodes, plain.chunks() / chunksForAColour);
    if (batches) return *std::move(batches);
  }
  return *coloured(plain, nodesPerEntity, nodes, plain.chunks());
}

}  // namespace atrapos::fem
