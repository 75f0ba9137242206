#pragma once

#include <string>

namespace atrapos {

/// Starts `atrapos-gmsh`, which stands beside this program, for a mesh of Gmsh (src/gmsh). Its lines of what
/// it leaves out go to standard output unless `quiet`. Throws importer::Error, one line, where it is not
/// installed, refuses the file or does not come to an end with it.
void runGmshProgram(const std::string& file, const std::string& mesh, bool shells, bool quiet);

}  // namespace atrapos
