#pragma once

#include <vector>

#include "atrapos/exodus/MeshPart.hpp"

namespace atrapos::exodus {

/// The whole mesh from its parts. Nodes stand in ascending order of their ids, the elements of a block too,
/// whatever the decomposition was; so do the entries of sets.
struct JoinedMesh {
  fem::Mesh mesh;
  std::vector<std::vector<int>> nodes;     ///< [part][node of the part] in the mesh
  std::vector<std::vector<int>> elements;  ///< [part][element of the part] in the mesh
  std::vector<int> partOfElement;          ///< [element]
};

/// `parts`: all of them in order; `file`: their common name, for messages. Throws Error where they do not
/// belong together: other numbers of parts, other blocks or sets, a node in two places, an element in two
/// parts, less or more than the whole has, or a border that the other part does not know.
JoinedMesh join(const std::vector<MeshPart>& parts, const std::string& file);

}  // namespace atrapos::exodus
