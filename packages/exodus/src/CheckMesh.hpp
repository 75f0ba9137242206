#pragma once

#include <string>

#include "atrapos/fem/Mesh.hpp"

namespace atrapos::exodus {

/// A whole mesh must have nodes and elements.
enum class Extent { whole, part };

/// Throws Error, with `file` first, where a mesh's lists do not fit each other: node, element and side
/// numbers out of range, lengths that are no multiples, numbers that are not finite, elements with the same
/// nodes, a side twice in a set, ids or names that Exodus cannot hold.
void checkMesh(const fem::Mesh& mesh, const std::string& file, Extent extent = Extent::whole);

}  // namespace atrapos::exodus
