#pragma once

#include "atrapos/fem/Mesh.hpp"

namespace atrapos::importer {

/// Removes the nodes that no element has, also from node sets; sets that have none left go. Returns how many.
/// Such nodes would have no stiffness.
int dropUnusedNodes(fem::Mesh& mesh);

}  // namespace atrapos::importer
