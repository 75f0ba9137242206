#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace atrapos::test {

/// A CSV file with a line of column names; lines that begin with # are comments.
class Table {
 public:
  /// Throws std::runtime_error where the file cannot be read or a row has not as many cells as there are
  /// names.
  explicit Table(const std::filesystem::path& file);

  int numRows() const { return static_cast<int>(rows_.size()); }
  const std::vector<std::string>& names() const { return names_; }
  /// Throws std::runtime_error where there is no such column or a cell is no number.
  std::vector<double> column(const std::string& name) const;
  /// Its cells as they are. Throws std::runtime_error where there is no such column.
  std::vector<std::string> texts(const std::string& name) const;

 private:
  std::string file_;
  std::vector<std::string> names_;
  std::vector<std::vector<std::string>> rows_;
};

/// The rows of a CSV file without column names; lines that begin with # are comments.
/// Throws std::runtime_error where the file cannot be read or a cell is no number.
std::vector<std::vector<double>> numberRows(const std::filesystem::path& file);

/// y at x from tabulated points with ascending xs: the cubic through the four points around x (at an end, the
/// last four). Throws std::out_of_range outside the table.
double interpolate(const std::vector<double>& xs, const std::vector<double>& ys, double x);

}  // namespace atrapos::test
