#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "atrapos/fem/Batches.hpp"
#include "support/Meshes.hpp"

using namespace atrapos::fem;
using namespace atrapos::fem::test;

namespace {

/// Every chunk once, and no node in two chunks of a colour.
void check(const Batches& batches, int numEntities, int nodesPerEntity, const std::vector<int>& nodes) {
  ASSERT_EQ(batches.count, (numEntities + batches.lanes - 1) / batches.lanes);
  std::vector<int> sorted = batches.order;
  std::sort(sorted.begin(), sorted.end());
  ASSERT_EQ(static_cast<int>(sorted.size()), batches.chunks());
  for (int b = 0; b < batches.chunks(); ++b) ASSERT_EQ(sorted[b], b);
  ASSERT_EQ(batches.colourStart.front(), 0);
  ASSERT_EQ(batches.colourStart.back(), batches.chunks());
  const int entities = batches.perChunk * batches.lanes;  // of a chunk
  for (std::size_t c = 0; c + 1 < batches.colourStart.size(); ++c) {
    ASSERT_LT(batches.colourStart[c], batches.colourStart[c + 1]) << "an empty colour";
    std::set<int> taken;
    for (int i = batches.colourStart[c]; i < batches.colourStart[c + 1]; ++i) {
      std::set<int> own;
      const int first = batches.order[i] * entities;
      for (int e = first; e < std::min(first + entities, numEntities); ++e)
        own.insert(nodes.begin() + e * nodesPerEntity, nodes.begin() + (e + 1) * nodesPerEntity);
      for (int n : own) ASSERT_TRUE(taken.insert(n).second) << "node " << n << " twice in colour " << c;
    }
  }
}

}  // namespace

TEST(Batches, NeighboursShareNoColour) {
  for (Topology cell : allCells())
    for (int lanes : {1, 3, 8}) {
      SCOPED_TRACE(topologyName(cell));
      const Block block = box(cell, {4, 3, 3}).blocks[0];
      const int N = nodesPerElement(cell);
      check(makeBatches(lanes, static_cast<int>(block.nodes.size()) / N, N, block.nodes),
            static_cast<int>(block.nodes.size()) / N, N, block.nodes);
    }
}

TEST(Batches, HexesInOrderNeedFewColours) {
  const Block block = box(Topology::Hex8, {16, 8, 8}).blocks[0];
  const auto batches = makeBatches(8, 16 * 8 * 8, 8, block.nodes);
  check(batches, 16 * 8 * 8, 8, block.nodes);
  // A batch is a whole row of 8 hexes here: rows touch 8 others, a checkerboard of 4 colours is the least.
  EXPECT_LE(batches.colourStart.size() - 1, 8u);
}

// Mesh generators may number tetrahedra at random: a batch then touches hundreds of others.
TEST(Batches, ElementsInRandomOrder) {
  const Block block = box(Topology::Tet4, {14, 14, 14}).blocks[0];
  const int count = static_cast<int>(block.nodes.size()) / 4;
  std::vector<int> order(count);
  for (int e = 0; e < count; ++e) order[e] = e;
  std::mt19937 engine(3);
  for (int e = count - 1; e > 0; --e) std::swap(order[e], order[engine() % (e + 1)]);
  std::vector<int> nodes;
  for (int e : order) nodes.insert(nodes.end(), block.nodes.begin() + 4 * e, block.nodes.begin() + 4 * e + 4);
  const auto batches = makeBatches(8, count, 4, nodes);
  check(batches, count, 4, nodes);
  EXPECT_GT(batches.colourStart.size() - 1, 64u) << "this mesh no longer tests more than 64 colours";
}

// A large mesh in its own order is worked through in chunks, a small one and one in random order are not.
TEST(Batches, ChunksLeaveWorkForManyThreads) {
  for (const int each : {4, 12, 40}) {
    const Block block = box(Topology::Hex8, {each, each, each}).blocks[0];
    const int count = each * each * each;
    const auto batches = makeBatches(8, count, 8, block.nodes);
    check(batches, count, 8, block.nodes);
    const int colours = static_cast<int>(batches.colourStart.size()) - 1;
    if (each == 4) {
      EXPECT_EQ(batches.perChunk, 1);
    }
    if (each == 40) {
      EXPECT_GT(batches.perChunk, 4);
    }
    if (batches.perChunk > 1) {
      EXPECT_GE(batches.chunks(), 32 * colours);
    }
  }
}

TEST(Batches, NothingToDo) {
  const auto batches = makeBatches(8, 0, 4, {});
  EXPECT_EQ(batches.count, 0);
  EXPECT_TRUE(batches.order.empty());
}
