#pragma once

#include <string>
#include <vector>

namespace atrapos {

/// A table of comma-separated values as a run writes it (PathTable.hpp), read whole. A row cut short at the
/// end, of a run that was killed, is left out.
class TableFile {
 public:
  /// Throws std::invalid_argument, one line, where the file cannot be read, or a row has another number of
  /// cells than the header.
  explicit TableFile(const std::string& file);

  const std::vector<std::string>& names() const { return names_; }
  std::size_t numRows() const { return rows_.size(); }
  bool has(const std::string& column) const;
  /// Throws std::invalid_argument, one line, where there is no such column; so do the others.
  std::size_t place(const std::string& column) const;
  /// Not a number where the cell holds none.
  double number(std::size_t row, std::size_t place) const;
  const std::string& text(std::size_t row, std::size_t place) const { return rows_[row][place]; }
  std::vector<std::string> texts(const std::string& column) const;
  std::vector<double> numbers(const std::string& column) const;
  std::vector<double> numbers(std::size_t place) const;
  /// Throws std::invalid_argument, one line, too where a cell holds no whole number.
  std::vector<int> integers(const std::string& column) const;

 private:
  std::string file_;
  std::vector<std::string> names_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace atrapos
