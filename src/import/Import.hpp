#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "atrapos/fem/Mesh.hpp"

namespace atrapos::importer {

/// A file cannot be imported: one line, "file:line: what, what would be accepted".
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What a file of another program has become.
struct Model {
  fem::Mesh mesh;
  std::string deck;                  ///< YAML without its line of the mesh file; empty: none was asked for
  std::vector<std::string> remarks;  ///< "file:line: what": all that was left out or is not quite the same
};

enum class Deck { no, yes };

/// Reads an input file of Abaqus or CalculiX (docs/import.md). With Deck::yes the first step with loads, its
/// materials and supports become a deck, and the sets that it needs are in the mesh.
/// Throws Error where the file cannot be read, is damaged, or has nothing that this program knows.
Model readInp(const std::string& file, Deck deck);

}  // namespace atrapos::importer
