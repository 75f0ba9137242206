#include "output/TableFile.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <limits>
#include <stdexcept>

namespace atrapos {
namespace {

std::vector<std::string> cellsOf(const std::string& line) {
  std::vector<std::string> cells(1);
  for (const char c : line)
    if (c == ',')
      cells.emplace_back();
    else
      cells.back() += c;
  return cells;
}

}  // namespace

TableFile::TableFile(const std::string& file) : file_(file) {
  std::ifstream in;
  if (std::filesystem::is_regular_file(file)) in.open(file);  // a pipe may never say anything
  std::string line;
  if (!in.is_open() || !std::getline(in, line))
    throw std::invalid_argument(fmt::format("{}: cannot be read", file));
  names_ = cellsOf(line);
  while (std::getline(in, line)) {
    if (in.eof()) break;  // without its end: cut short
    rows_.push_back(cellsOf(line));
    if (rows_.back().size() != names_.size())
      throw std::invalid_argument(fmt::format("{}: row {} has {} cells, the header {}", file, rows_.size(),
                                              rows_.back().size(), names_.size()));
  }
}

double TableFile::number(std::size_t row, std::size_t place) const {
  const std::string& cell = rows_[row][place];
  const char* const end = cell.data() + cell.size();
  double value = 0;
  const auto read = std::from_chars(cell.data(), end, value);
  return read.ec == std::errc() && read.ptr == end ? value : std::numeric_limits<double>::quiet_NaN();
}

bool TableFile::has(const std::string& column) const {
  return std::find(names_.begin(), names_.end(), column) != names_.end();
}

std::size_t TableFile::place(const std::string& column) const {
  const auto found = std::find(names_.begin(), names_.end(), column);
  if (found == names_.end()) throw std::invalid_argument(fmt::format("{}: has no column {}", file_, column));
  return static_cast<std::size_t>(found - names_.begin());
}

std::vector<std::string> TableFile::texts(const std::string& column) const {
  std::vector<std::string> all;
  const std::size_t at = place(column);
  for (const auto& row : rows_) all.push_back(row[at]);
  return all;
}

std::vector<int> TableFile::integers(const std::string& column) const {
  std::vector<int> all;
  const std::size_t at = place(column);
  for (std::size_t row = 0; row < rows_.size(); ++row) {
    const std::string& cell = rows_[row][at];
    const char* const end = cell.data() + cell.size();
    const auto read = std::from_chars(cell.data(), end, all.emplace_back());
    if (read.ec != std::errc() || read.ptr != end)
      throw std::invalid_argument(
          fmt::format("{}: row {} has no whole number in its column {}", file_, row + 1, column));
  }
  return all;
}

std::vector<double> TableFile::numbers(const std::string& column) const { return numbers(place(column)); }

std::vector<double> TableFile::numbers(std::size_t place) const {
  std::vector<double> all;
  for (std::size_t row = 0; row < rows_.size(); ++row) all.push_back(number(row, place));
  return all;
}

}  // namespace atrapos
