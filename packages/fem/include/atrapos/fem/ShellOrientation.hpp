#pragma once

#include <string>
#include <vector>

#include "atrapos/fem/Mesh.hpp"

namespace atrapos::fem {

/// Shells that hang together by common edges where an orientation goes on: at edges of two elements, and at
/// branches from an element to the one that continues it within the fold angle, 45 degrees at most.
struct ShellPart {
  std::string block;        ///< of the part's first element
  int element = 0;          ///< that element, counted over all blocks
  int elements = 0;         ///< in all
  int turned = 0;           ///< whose node order was reversed
  bool sidesMixed = false;  ///< a side set has top faces as well as bottom faces of the part
};

/// Reverses the node order of shells so that the normals of neighbours agree: in every part most of its
/// elements stay as they are (of two halves that with the first element). What the mesh says of a reversed
/// element stays where it is in space: thicknesses of its nodes; in side sets its edges, and its faces, whose
/// top becomes its bottom. Returns the parts, in the order of their first elements.
///
/// Where no orientation of all suits (a Moebius strip), neighbours are left that do not agree; shellGeometry
/// refuses them.
std::vector<ShellPart> orientShells(Mesh& mesh, double foldAngle);

}  // namespace atrapos::fem
