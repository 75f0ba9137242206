#pragma once

#include <vector>

namespace atrapos::fem {

/// Entities in batches of `lanes` neighbours, batches in chunks of `perChunk` neighbours, and the chunks in
/// colours: two chunks of one colour share no node, so a loop over a colour may scatter without atomics, and
/// the sums come in the same order for any number of threads. A thread works through a chunk in the entities'
/// own order and finds most of the rows that it adds to in its cache.
struct Batches {
  int lanes = 1;
  int count = 0;                 ///< number of batches
  int perChunk = 1;              ///< the last chunk may have less
  std::vector<int> order;        ///< chunks, colour by colour
  std::vector<int> colourStart;  ///< [colour] in `order`, one more at the end

  int chunks() const { return (count + perChunk - 1) / perChunk; }
};

/// Greedy colouring of chunks of consecutive batches; nodes is [entity][node]. Chunks are as long as leaves
/// 32 of them for a colour, so that the loops of as many threads end together.
Batches makeBatches(int lanes, int numEntities, int nodesPerEntity, const std::vector<int>& nodes);

}  // namespace atrapos::fem
