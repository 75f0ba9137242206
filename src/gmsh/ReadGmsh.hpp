#pragma once

#include <string>

#include "import/Import.hpp"

namespace atrapos::importer {

/// What quadrilaterals in the plane z = 0 are.
enum class Surfaces { plane, shells };

/// Reads a mesh of Gmsh, formats 2.2 and 4.1, ASCII or binary, by libgmsh (docs/import.md): physical groups
/// of the cells' dimension become blocks, those of their sides side sets and node sets, the others node sets.
///
/// Throws Error where the file is none of these, is damaged, or has no cells that this program knows. Files
/// by this ending may be scripts for libgmsh, which can run commands: what does not begin as a mesh is not
/// given to it.
Model readGmsh(const std::string& file, Surfaces surfaces);

}  // namespace atrapos::importer
