#pragma once

#include <iosfwd>
#include <string>

namespace atrapos {

/// Cuts a mesh file into part files by METIS, `output`.<parts>.<part> (output empty: the mesh file's name);
/// results in the file are left out. `progress` may be null: a line for each part. Throws exodus::Error, and
/// std::invalid_argument where the mesh has fewer elements than parts.
void splitMesh(const std::string& file, int parts, const std::string& output, std::ostream* progress);

}  // namespace atrapos
