#pragma once

#include <string>
#include <vector>

#include "atrapos/fem/Mesh.hpp"

namespace atrapos::importer {

/// What bodies elements stand for.
enum class Family { solid, shell, membrane, bar, planeStress, planeStrain, axisymmetric };

/// An element type of Abaqus and CalculiX, and the cell that takes its place.
struct InpElementType {
  std::string name;  ///< in capitals, without what does not matter here (H of hybrid elements, ...)
  int nodes;
  Family family;
  fem::Topology topology;
  const char* remark;  ///< how the cell differs from the element; empty: not at all
};

/// Null where no cell is equal.
const InpElementType* findInpElement(const std::string& type);

/// All names that findInpElement knows, for messages.
std::string inpElementNames();

/// Position in the input file's element of each node of the cell, in Exodus' order.
const std::vector<int>& inpNodeOrder(fem::Topology topology);

/// Side of the cell, 0-based, that is the element's face S1, S2, ... (0-based here); -1 where there is none.
/// Of shells S1 is the bottom, S2 the top, S3 to S6 the edges, as CalculiX counts.
int inpSide(fem::Topology topology, int face);

}  // namespace atrapos::importer
