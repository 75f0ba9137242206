#pragma once

#include "File.hpp"
#include "atrapos/exodus/MeshPart.hpp"

namespace atrapos::exodus {

// The Nemesis records of a part file: sizes of the whole mesh, which nodes and elements are inside a part or
// on its border, and node communication maps.

/// Defines the records and writes the sizes.
void definePart(const File& file, const MeshPart& part);

/// Writes the lists that definePart defined.
void writePartMaps(const File& file, const MeshPart& part);

/// Reads sizes and borders; part.part, part.parts and part.mesh are known. Throws Error where the file has
/// not the records of such a part.
void readPartRecords(const File& file, MeshPart& part);

}  // namespace atrapos::exodus
