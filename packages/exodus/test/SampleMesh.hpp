#pragma once

#include <gtest/gtest.h>

#include "atrapos/fem/StructuredMesh.hpp"

/// A small box with everything that a file can carry set to something that is not its default.
inline atrapos::fem::Mesh sampleMesh(atrapos::fem::Topology topology) {
  atrapos::fem::BoxOptions options;
  options.divisions = {2, 3, 1};
  options.lengths = {2.0, 3.3, 0.7};
  options.topology = topology;
  auto mesh = atrapos::fem::boxMesh(options);
  mesh.title = "a box, 20 \u00b0C";
  // Cut the block in two, the second before the first by id.
  auto& first = mesh.blocks[0];
  first.id = 42;
  first.name = "a name that is longer than the thirty-two characters of old Exodus";
  auto second = first;
  second.id = 7;
  second.name = "";
  const auto half = first.nodes.size() / 2;
  second.nodes.assign(first.nodes.begin() + static_cast<long>(half), first.nodes.end());
  first.nodes.resize(half);
  second.attributeNames = {"thickness", "angle"};
  const auto count = second.nodes.size() / static_cast<std::size_t>(nodesPerElement(topology));
  for (std::size_t i = 0; i < 2 * count; ++i)
    second.attributes.push_back(0.1 * static_cast<double>(i) - 1.0 / 3);
  mesh.blocks.push_back(second);
  mesh.nodeSets.push_back({"nobody", 1000, {}});
  for (std::size_t i = 0; i < mesh.nodeSets[1].nodes.size(); ++i)
    mesh.nodeSets[1].factors.push_back(1.0 / (1.0 + static_cast<double>(i)));
  mesh.sideSets[2].id = 2147483647;
  mesh.sideSets[3].name = "";
  for (int i = 0; i < mesh.numNodes(); ++i) mesh.nodeIds.push_back(1000000 - 3 * i);
  for (int i = 0; i < mesh.numElements(); ++i) mesh.elementIds.push_back(500 + 7 * i);
  return mesh;
}

/// All that a file can carry, to the bit.
inline void expectEqual(const atrapos::fem::Mesh& a, const atrapos::fem::Mesh& b) {
  EXPECT_EQ(a.title, b.title);
  EXPECT_EQ(a.coordinates, b.coordinates);
  EXPECT_EQ(a.nodeIds, b.nodeIds);
  EXPECT_EQ(a.elementIds, b.elementIds);
  ASSERT_EQ(a.blocks.size(), b.blocks.size());
  for (std::size_t i = 0; i < a.blocks.size(); ++i) {
    EXPECT_EQ(a.blocks[i].name, b.blocks[i].name);
    EXPECT_EQ(a.blocks[i].id, b.blocks[i].id);
    EXPECT_EQ(a.blocks[i].topology, b.blocks[i].topology);
    EXPECT_EQ(a.blocks[i].nodes, b.blocks[i].nodes);
    EXPECT_EQ(a.blocks[i].attributeNames, b.blocks[i].attributeNames);
    EXPECT_EQ(a.blocks[i].attributes, b.blocks[i].attributes);
  }
  ASSERT_EQ(a.nodeSets.size(), b.nodeSets.size());
  for (std::size_t i = 0; i < a.nodeSets.size(); ++i) {
    EXPECT_EQ(a.nodeSets[i].name, b.nodeSets[i].name);
    EXPECT_EQ(a.nodeSets[i].id, b.nodeSets[i].id);
    EXPECT_EQ(a.nodeSets[i].nodes, b.nodeSets[i].nodes);
    EXPECT_EQ(a.nodeSets[i].factors, b.nodeSets[i].factors);
  }
  ASSERT_EQ(a.sideSets.size(), b.sideSets.size());
  for (std::size_t i = 0; i < a.sideSets.size(); ++i) {
    EXPECT_EQ(a.sideSets[i].name, b.sideSets[i].name);
    EXPECT_EQ(a.sideSets[i].id, b.sideSets[i].id);
    ASSERT_EQ(a.sideSets[i].sides.size(), b.sideSets[i].sides.size());
    for (std::size_t j = 0; j < a.sideSets[i].sides.size(); ++j) {
      EXPECT_EQ(a.sideSets[i].sides[j].element, b.sideSets[i].sides[j].element);
      EXPECT_EQ(a.sideSets[i].sides[j].side, b.sideSets[i].sides[j].side);
    }
  }
}
