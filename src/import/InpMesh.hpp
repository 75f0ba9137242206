#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "import/InpModel.hpp"
#include "import/Names.hpp"

namespace atrapos::importer {

/// The mesh of an input file, and which of its nodes, elements and sets are which of the file's.
class InpMesh {
 public:
  /// Blocks are the elements of one section and cell, cut where one of the element sets `cuts` (positions, 64
  /// at most) ends. Nodes are those of elements, and `more`. Remarks go to the model. Throws Error.
  InpMesh(InpModel& model, const std::vector<std::vector<int>>& cuts, const std::vector<int>& more);

  fem::Mesh mesh;
  std::vector<int> nodeAt;     ///< [model's node]: the mesh's, -1 where it does not have it
  std::vector<int> elementAt;  ///< [model's element]
  std::vector<int> blockAt;    ///< [model's element]

  /// Name of the node set with these nodes of the model, which is made where there is none; nodes that the
  /// mesh does not have are passed over. Empty: none is left.
  std::string nodeSet(const std::vector<int>& nodes, const std::string& wanted);
  /// The same of faces.
  std::string sideSet(const std::vector<InpFace>& faces, const std::string& wanted);
  /// Names of the blocks that these elements are, whole ones by `cuts`.
  std::vector<std::string> blocks(const std::vector<int>& elements) const;

 private:
  void takeElements(InpModel& model, const std::vector<std::vector<int>>& cuts);
  void takeNodes(InpModel& model, const std::vector<int>& more);
  void takeSets(InpModel& model);
  std::vector<int> nodesOf(const std::vector<int>& nodes) const;
  std::vector<std::pair<int, int>> sidesOf(const std::vector<InpFace>& faces) const;
  std::string addNodeSet(const std::vector<int>& nodes, const std::string& wanted);
  std::string addSideSet(const std::vector<std::pair<int, int>>& sides, const std::string& wanted);

  Names blockNames_, nodeSetNames_, sideSetNames_;
  std::map<std::vector<int>, std::string> nodeSets_;
  std::map<std::vector<std::pair<int, int>>, std::string> sideSets_;
};

}  // namespace atrapos::importer
