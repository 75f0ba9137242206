#pragma once

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
