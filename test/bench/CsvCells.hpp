#pragma once

#include <sstream>
#include <string>
#include <vector>

namespace atrapos::bench {

/// The cells of a line of a CSV file without quotes; the last one may be empty.
inline std::vector<std::string> csvCells(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream in(line + ",");
  for (std::string cell; std::getline(in, cell, ',');) cells.push_back(cell);
  return cells;
}

}  // namespace atrapos::bench
