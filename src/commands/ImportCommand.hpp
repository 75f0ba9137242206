#pragma once

#include <iosfwd>
#include <string>
#include <vector>

namespace atrapos {

/// What `atrapos import` was asked for.
struct ImportWords {
  std::string file;
  std::string output;   ///< Exodus file, of .stl a YAML file; empty: the file's name with .exo or .yaml, here
  bool deck = false;    ///< a deck of the same problem beside it, with .yaml
  bool shells = false;  ///< flat surfaces of Gmsh are shells, not plane bodies
  std::string along;    ///< .stl: axis of the heights, x, y, z, -x, -y or -z; empty: z
  std::vector<int> cells;  ///< .stl: pieces across it, two numbers; empty: by the facets
  bool quiet = false;
};

/// Makes an Exodus mesh, and a deck, of a file of another program, or of STL the surface of a tool
/// (docs/import.md); what is left out is told
/// line by line. Writes nothing where anything fails. Throws importer::Error, deck::DeckError, exodus::Error,
/// std::invalid_argument, each with one line.
void importFile(const ImportWords& words, std::ostream& out);

}  // namespace atrapos
