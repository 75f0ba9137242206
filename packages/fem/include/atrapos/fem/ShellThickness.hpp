#pragma once

#include <optional>
#include <vector>

#include "atrapos/fem/Mesh.hpp"

namespace atrapos::fem {

/// What a mesh does not say of one block of shells.
struct ShellSection {
  int block = 0;                    ///< position in Mesh::blocks
  std::optional<double> thickness;  ///< > 0, uniform; empty: the block's attributes, see shellThickness
};

/// Thickness of the shells of a block, a length, [element][node].
///
/// Without a uniform thickness in the section it is read from the block's attributes: the one that is named
/// `thickness` (any case), or else the only one, gives each element its thickness; otherwise as many as an
/// element has nodes give it node by node (the Exodus convention for shells).
///
/// Throws std::invalid_argument naming the block where there is no thickness, and the element where it is not
/// a positive, finite number.
std::vector<double> shellThickness(const Mesh& mesh, const ShellSection& section);

}  // namespace atrapos::fem
