#include "support/Table.hpp"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace atrapos::test {
namespace {

std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> found;
  std::istringstream in(line);
  for (std::string cell; std::getline(in, cell, ',');) found.push_back(cell);
  return found;
}

}  // namespace

Table::Table(const std::filesystem::path& file) : file_(file.string()) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error(file_ + ": cannot be read");
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line[0] == '#') continue;
    if (names_.empty()) {
      names_ = cells(line);
      continue;
    }
    rows_.push_back(cells(line));
    if (rows_.back().size() != names_.size()) throw std::runtime_error(file_ + ": bad row: " + line);
  }
}

std::vector<std::string> Table::texts(const std::string& name) const {
  const auto at = std::find(names_.begin(), names_.end(), name);
  if (at == names_.end()) throw std::runtime_error(file_ + ": no column " + name);
  std::vector<std::string> found;
  for (const auto& row : rows_) found.push_back(row[static_cast<std::size_t>(at - names_.begin())]);
  return found;
}

std::vector<double> Table::column(const std::string& name) const {
  std::vector<double> values;
  for (const std::string& cell : texts(name)) {
    char* end = nullptr;
    values.push_back(std::strtod(cell.c_str(), &end));
    if (cell.empty() || *end != 0)
      throw std::runtime_error(file_ + ": not a number in " + name + ": " + cell);
  }
  return values;
}

std::vector<std::vector<double>> numberRows(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error(file.string() + ": cannot be read");
  std::vector<std::vector<double>> rows;
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line[0] == '#') continue;
    rows.emplace_back();
    for (const std::string& cell : cells(line)) {
      char* end = nullptr;
      rows.back().push_back(std::strtod(cell.c_str(), &end));
      if (cell.empty() || *end != 0) throw std::runtime_error(file.string() + ": not a number: " + cell);
    }
  }
  return rows;
}

double interpolate(const std::vector<double>& xs, const std::vector<double>& ys, double x) {
  // Two runs that stop at one value reach it to rounding.
  const double rounding = xs.empty() ? 0 : 1e-12 * (xs.back() - xs.front());
  if (xs.size() < 4 || !(x >= xs.front() - rounding && x <= xs.back() + rounding))
    throw std::out_of_range("outside the table: " + std::to_string(x));
  const std::ptrdiff_t above = std::lower_bound(xs.begin(), xs.end(), x) - xs.begin();
  const std::size_t first =
      std::clamp<std::ptrdiff_t>(above - 2, 0, static_cast<std::ptrdiff_t>(xs.size()) - 4);
  double y = 0;
  for (std::size_t i = first; i < first + 4; ++i) {
    double weight = 1;
    for (std::size_t j = first; j < first + 4; ++j)
      if (j != i) weight *= (x - xs[j]) / (xs[i] - xs[j]);
    y += weight * ys[i];
  }
  return y;
}

}  // namespace atrapos::test
