#pragma once

#include <array>
#include <string>
#include <vector>

namespace atrapos::importer {

/// The corners of a facet, counter-clockwise seen from outside.
using Facet = std::array<std::array<double, 3>, 3>;

/// Reads an STL file, ASCII or binary; normals in the file are not looked at, the order of corners counts.
/// Throws Error, one line, where it cannot be read, is damaged, or has no facet.
std::vector<Facet> readStl(const std::string& file);

}  // namespace atrapos::importer
