#pragma once

#include <vector>

namespace atrapos::fem {

/// Entities in batches of `lanes` neighbours, and the batches in colours: two batches of one colour share no
/// node, so a loop over a colour may scatter without atomics, and the sums come in the same order for any
/// number of threads.
struct Batches {
  int lanes = 1;
  int count = 0;                 ///< number of batches
  std::vector<int> order;        ///< batches, colour by colour
  std::vector<int> colourStart;  ///< [colour], one more at the end
};

/// Greedy colouring of consecutive batches; nodes is [entity][node].
Batches makeBatches(int lanes, int numEntities, int nodesPerEntity, const std::vector<int>& nodes);

}  // namespace atrapos::fem
