#pragma once

#include <iosfwd>
#include <string>

namespace atrapos {

/// What `atrapos import` was asked for.
struct ImportWords {
  std::string file;
  std::string output;   ///< Exodus file; empty: the file's name with .exo, in this folder
  bool deck = false;    ///< a deck of the same problem beside it, with .yaml
  bool shells = false;  ///< flat surfaces of Gmsh are shells, not plane bodies
  bool quiet = false;
};

/// Makes an Exodus mesh, and a deck, of a file of another program (docs/import.md); what is left out is told
/// line by line. Writes nothing where anything fails. Throws importer::Error, deck::DeckError, exodus::Error,
/// std::invalid_argument, each with one line.
void importFile(const ImportWords& words, std::ostream& out);

}  // namespace atrapos
