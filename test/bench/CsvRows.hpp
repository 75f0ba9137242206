#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "CsvCells.hpp"

namespace atrapos::bench {

/// The rows of a CSV file with a line of column names: [row][column] text. Expects a cell for every name.
inline std::vector<std::map<std::string, std::string>> csvRows(const std::string& file) {
  std::ifstream in(file);
  std::vector<std::string> names;
  std::vector<std::map<std::string, std::string>> rows;
  for (std::string line; std::getline(in, line);) {
    const auto cells = csvCells(line);
    if (names.empty()) {
      names = cells;
      continue;
    }
    EXPECT_EQ(cells.size(), names.size()) << line;
    auto& row = rows.emplace_back();
    for (std::size_t i = 0; i < names.size() && i < cells.size(); ++i) row[names[i]] = cells[i];
  }
  return rows;
}

}  // namespace atrapos::bench
