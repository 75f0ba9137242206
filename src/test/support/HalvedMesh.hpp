#pragma once

#include <cstddef>
#include <utility>

#include "atrapos/fem/Mesh.hpp"

namespace atrapos::test {

/// The second half of the mesh's one block becomes the block `other`.
inline fem::Mesh halved(fem::Mesh mesh) {
  fem::Block& first = mesh.blocks.at(0);
  fem::Block other = first;
  const auto cut = first.nodes.begin() + static_cast<std::ptrdiff_t>(first.nodes.size() / 2);
  other.nodes.assign(cut, first.nodes.end());
  other.name = "other";
  other.id = first.id + 1;
  first.nodes.erase(cut, first.nodes.end());
  mesh.blocks.push_back(std::move(other));
  return mesh;
}

}  // namespace atrapos::test
