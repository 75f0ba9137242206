#pragma once

#include <vector>

#include "atrapos/exodus/MeshPart.hpp"

namespace atrapos::exodus {

/// A mesh cut into parts along faces of elements: each element is in one part, a node in those of its
/// elements (without an element: in part 0), and sets are where their nodes and elements are.
class Decomposition {
 public:
  /// partOfElement: [element over all blocks], within 0 and parts - 1. The mesh must outlive this. Throws
  /// std::invalid_argument where the list does not fit or an id occurs twice: ids are what joins parts again.
  Decomposition(const fem::Mesh& mesh, const std::vector<int>& partOfElement, int parts);

  int parts() const { return static_cast<int>(nodes_.size()); }
  const std::vector<int>& nodes(int part) const { return nodes_[part]; }        ///< in the mesh, ascending
  const std::vector<int>& elements(int part) const { return elements_[part]; }  ///< in the mesh, ascending

  MeshPart part(int part) const;

 private:
  const fem::Mesh& mesh_;
  WholeSizes whole_;
  std::vector<std::vector<int>> nodes_, elements_;
  std::vector<int> sharersStart_, sharers_;  ///< [node] the parts of a node that more than one has, ascending
};

}  // namespace atrapos::exodus
